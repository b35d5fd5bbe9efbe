#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace sateen {

/// Bytes of the UTF-8 character at `at`, or 0 where there is none (RFC 3629: no overlong forms, no surrogates).
std::size_t character_length(std::string_view text, std::size_t at);

/// The number of a character that a terminal would obey or that turns the order of what follows: C0 and C1 control
/// characters, DEL, bidirectional marks, embeddings, overrides and isolates (Unicode UAX #9), line and paragraph
/// separators. 0 for any other. `length` is that of character_length, not 0.
unsigned obeyed_character(std::string_view text, std::size_t at, std::size_t length);

/// The text as a terminal may show it, whatever file it came from: what a terminal would obey becomes \n, \r, \x1b or
/// \u202e, bytes that are no UTF-8 become \xNN; letters of any script stay, and so do line breaks where `keep_lines`
/// and tabs where `keep_tabs`.
std::string printable(std::string_view text, bool keep_lines = false, bool keep_tabs = false);

}  // namespace sateen
