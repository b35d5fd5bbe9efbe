#pragma once
#include <cstdint>
#include <vector>

#include "look/draft.h"

namespace sateen {

/// Shafts or treadles, growing, each once.
using WifNumbers = std::vector<std::uint16_t>;

/// The smallest repeat of a threading and its lifts, before it is drawn: ends and picks that cross alike share a
/// kind, so that a repeat is found without drawing the whole cloth.
struct WifRepeat {
  int ends = 0, picks = 0;
  std::vector<int> end_kinds, pick_kinds;  ///< of the repeat, by thread from the first
  int kinds_of_ends = 0;
  std::vector<std::uint8_t> meets;  ///< [pick kind * kinds_of_ends + end kind]: the pick lifts a shaft of the end
};

/// `ends`: shafts of each end; `picks`: shafts that each pick lifts. Neither may be empty.
WifRepeat wif_repeat(const std::vector<WifNumbers>& ends, const std::vector<WifNumbers>& picks);

/// The repeat as a draft: the first end on the right, the first pick at the bottom. `rising`: a lifted shaft brings
/// its ends on top, else below.
Draft wif_drawdown(const WifRepeat& repeat, bool rising);

}  // namespace sateen
