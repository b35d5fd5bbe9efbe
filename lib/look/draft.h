#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace sateen {

/// One repeat of a weave as it is drawn: the cloth's face, the warp upright; columns are warp ends from left to
/// right, rows are weft picks from the top down.
struct Draft {
  int ends = 0, picks = 0;
  std::vector<std::uint8_t> warp_up;  ///< [pick * ends + end]: 1 where the warp lies on top

  bool up(int end, int pick) const { return warp_up[std::size_t(pick) * std::size_t(ends) + std::size_t(end)] != 0; }
};

/// Ends and picks of a repeat at most: a wide jacquard.
inline constexpr int most_draft_side = 4096;

/// The draft of one of
///   "plain"
///   "twill n/m [z|s]"       over n picks, under m; diagonals rise to the right (z) or to the left
///   "satin n/c", "satin n counter c"    the warp passes under one pick in n, the next end's c picks further
///   "sateen n/c"            the same seen from the other side: weft on top
/// or of the rows of a matrix: x or 1 where the warp is on top, . or 0 where the weft is; large ones may be packed:
///   "packed ENDS", then each row in hexadecimal digits of four ends, the leftmost first and highest, 1 for warp.
/// InputError with what was found, expected, and a remedy.
Draft parse_draft(const std::vector<std::string>& text);

/// Rows of x and . that parse_draft reads back; packed above largest_plain_draft crossings, which keeps the file of a
/// jacquard's look and the header of its pictures at a quarter of a byte for a crossing.
std::vector<std::string> draft_rows(const Draft& draft);
inline constexpr std::size_t largest_plain_draft = 1024 * 1024;

/// The smallest draft that repeats to the same cloth.
Draft smallest_repeat(const Draft& draft);

/// Whether the text names a draft file rather than a draft.
bool is_draft_file(const std::vector<std::string>& text);

}  // namespace sateen
