#pragma once
#include <string_view>

namespace sateen {

/// `--ocio built-in` asks for the project's own config even where $OCIO is set.
inline constexpr std::string_view built_in_config_name = "built-in";

/// The project's own OpenColorIO 2.1 config as YAML. Every transform is one that the library itself carries, so that
/// the config needs no file beside the program. Reference space: ACES2065-1; display reference: CIE XYZ, D65.
extern const std::string_view built_in_config_text;

}  // namespace sateen
