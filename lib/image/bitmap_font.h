#pragma once
#include <string_view>

namespace sateen {

/// A font of our own for labels, so that no font file is needed: printable ASCII in cells of 5 x 8 dots (row 7 is for
/// descenders), one dot of space between. UTF-8 characters beyond ASCII show as '?', one each.
inline constexpr int font_width = 5, font_height = 8, font_advance = 6;

/// Whether the glyph of `c` has ink at the dot, 0 <= x < 5, 0 <= y < 8 from the top.
bool font_ink(char c, int x, int y);

/// Characters that `text` shows as.
int shown_length(std::string_view text);

}  // namespace sateen
