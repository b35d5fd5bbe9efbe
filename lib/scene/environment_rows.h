#pragma once
#include <cstdint>
#include <vector>

#include "scene/environment.h"

namespace sateen {

/// Rows of a map, as they are or made smaller on the way in: every new texel is the mean over its solid angle of
/// those it covers, so the light's energy stays. Only the small map and one row of sums are held.
class EnvironmentRows {
 public:
  /// The file's size and the map's, which is at most as large.
  EnvironmentRows(int from_width, int from_height, Environment& to)
      : width_(from_width), height_(from_height), to_(to) {}

  /// Rows 0, 1, 2 ... of the file, each of its width, scaled (scaled_radiance).
  void add(int y, const std::vector<Color>& row);
  void add_black(int y);  ///< the same of a black row, at the cost of the map's width

 private:
  bool is_as_it_is() const { return to_.width == width_ && to_.height == height_; }
  int first(int i, int from, int to) const { return int(std::int64_t(i) * from / to); }
  void begin(int y);
  void finish(int y);

  int width_, height_;
  Environment& to_;
  int next_ = 0;              ///< row of the map that is being summed
  std::vector<double> sums_;  ///< red, green, blue and weight of each of its texels
};

}  // namespace sateen
