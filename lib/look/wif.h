#pragma once
#include <filesystem>
#include <string>

#include "look/draft.h"
#include "look/look.h"

namespace sateen {

/// Ends and picks that a WIF file may have (its smallest repeat must fit most_draft_side), and shafts and treadles.
inline constexpr int most_wif_threads = 8192, most_wif_shafts = 4096;

/// A draft and what is to be told of how it was read, each a sentence with its place.
struct WifDraft {
  Draft draft;
  std::vector<std::string> warnings;
};

/// The draft of a WIF file (Weaving Information File 1.1): THREADING with LIFTPLAN, or with TIEUP and TREADLING.
/// Which of the two: the one that [CONTENTS] names and that lifts something, LIFTPLAN where both do. Sections that
/// [CONTENTS] denies are not used. Warp thread 1 is the rightmost end, weft thread 1 the lowest pick. Ends on no
/// shaft and picks that lift nothing are left out before the first and behind the last that are drawn. Told as
/// warnings: those, treadles that are not tied, counts that do not fit, thread colours, sizes and symbols, which are
/// not used yet. InputError with file:line:column of every line that is not understood, at most 20; unreadable where
/// the file cannot be read or is larger than 64 MiB.
WifDraft read_wif(const std::filesystem::path& path);
WifDraft parse_wif(const std::string& text, const std::string& file);

/// Where the weave's draft names a WIF file, replaces it by the rows of the draft in that file, and its warnings by
/// those of that file. Searched beside the look file `look_file` first, then in the current folder.
void settle_draft(WeaveSettings& weave, const std::string& look_file);

}  // namespace sateen
