#pragma once
#include <string>
#include <string_view>

namespace sateen {

/// "is UTF-16 text, expected UTF-8 or plain ASCII text" where a text begins as one; empty elsewhere. Without a byte
/// order mark a zero byte among the first four is taken for a sign of it, "or no text at all".
std::string wide_text_complaint(std::string_view text);
inline constexpr const char* wide_text_help = "save it as UTF-8";

/// The text before the 0x1A by which DOS ends text, where nothing but more of them, zero bytes and blanks follow.
std::string_view without_dos_end(std::string_view text);

}  // namespace sateen
