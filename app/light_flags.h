#pragma once
#include <string>

#include "command.h"

namespace sateen::app {

/// --env-layer of the commands that read a light.
void add_layer_flag(Command& command, std::string& layer);

/// --image-limit, of textures and maps alike (image/limits.h).
void add_image_limit(Command& command);

}  // namespace sateen::app
