#pragma once
#include <string_view>

namespace sateen {

/// Text of lib/mesh/shapes/NAME.obj (drape, skirt), linked into the program; empty for other names.
std::string_view embedded_shape(std::string_view name);

}  // namespace sateen
