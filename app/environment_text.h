#pragma once
#include <string>

#include "look/json_writer.h"
#include "scene/environment_inspect.h"

namespace sateen::app {

/// A map's report for people, several lines.
std::string environment_text(const std::string& path, const std::string& space, const EnvironmentReport& report);

/// The same as a JSON object.
void write_environment(JsonWriter& w, const std::string& path, const std::string& space,
                       const EnvironmentReport& report);

}  // namespace sateen::app
