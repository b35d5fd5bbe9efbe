#pragma once
#include "look/field_values.h"

namespace sateen {

/// Reads a texture that is given in place of a field's value; its path is taken from the folder of `look_file` and
/// must be there. False when there was something to report.
bool read_texture(TextureValue& to, const Field& field, const JsonValue& value, std::string_view name,
                  const std::string& look_file, const Report& report);

}  // namespace sateen
