#pragma once
#include "scene/environment.h"

namespace sateen {

/// The map at `width` x `height`, each at most its own: every new texel is the mean over its solid angle, so the
/// light's energy stays. Rotation, name, luminance weights and the list of repairs stay too.
Environment shrink_environment(const Environment& map, int width, int height);

}  // namespace sateen
