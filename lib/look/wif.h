#pragma once
#include <filesystem>
#include <string>

#include "look/draft.h"

namespace sateen {

/// Ends and picks that a WIF file may have (its smallest repeat must fit most_draft_side), and shafts and treadles.
inline constexpr int most_wif_threads = 2048, most_wif_shafts = 256;

/// The draft of a WIF file (Weaving Information File 1.1): THREADING with LIFTPLAN, or with TIEUP and TREADLING.
/// Warp thread 1 is the rightmost end, weft thread 1 the lowest pick. Colours, spacings and notes are not used.
/// InputError with file:line:column of every line that is not understood, at most 20; unreadable where the file
/// cannot be read or is larger than 4 MiB.
Draft read_wif(const std::filesystem::path& path);
Draft parse_wif(const std::string& text, const std::string& file);

/// Where `text` names a WIF file, replaces it by the rows of the draft in that file. Searched beside the look file
/// `look_file` first, then in the current folder.
void settle_draft(std::vector<std::string>& text, const std::string& look_file);

}  // namespace sateen
