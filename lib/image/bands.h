#pragma once
#include <algorithm>
#include <cstdint>

namespace sateen {

/// Rows that OpenEXR packs together.
inline constexpr std::int64_t rows_packed_together = 16;

/// Rows of a picture of `bytes_per_row` that are made, written or compared at a time, so that a large one never lies
/// in memory whole: a multiple of 16, of at most `most_bytes` where 16 rows allow it.
inline int band_rows(std::int64_t bytes_per_row, std::int64_t most_bytes = 8 << 20) {
  constexpr std::int64_t most_rows = 512;
  const std::int64_t fit = std::min(most_bytes / std::max<std::int64_t>(bytes_per_row, 1), most_rows);
  return int(std::max(fit / rows_packed_together, std::int64_t(1)) * rows_packed_together);
}

/// The same for an EXR, whose rows are packed by several threads at once: enough for each of them, up to 256 MiB.
inline int exr_band_rows(std::int64_t bytes_per_row, int threads) {
  constexpr std::int64_t least = 32 << 20, most = 256 << 20;
  return band_rows(bytes_per_row, std::clamp(bytes_per_row * rows_packed_together * threads, least, most));
}

}  // namespace sateen
