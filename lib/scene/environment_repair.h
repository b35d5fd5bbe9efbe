#pragma once
#include <vector>

#include "scene/environment.h"

namespace sateen {

/// Mends a map of three channels band by band, from the top down, around its conversion to the working space: before
/// it, where a number that is none would spread over all channels; after it, for a negative number in the file may be
/// a colour that the working space holds. Counts what it meets.
class RadianceMender {
 public:
  explicit RadianceMender(int height) : height_(height) {}

  /// The largest finite value of a band, where the whole map is at hand before it is mended.
  void look(const Image& band);
  /// Starts again with what was found out; true where a first run met something infinite before it knew what to make
  /// of it, and is not to be used.
  bool again();

  /// NaN and -Inf become 0, +Inf the map's largest finite value. `y` is the band's first row in the map.
  void mend_in_file_space(Image& band, int y);
  /// Negative becomes 0. The same band, converted.
  void mend_in_working_space(Image& band, int y);

  /// With spikes counted by the mean of all bands.
  EnvironmentRepairs repairs() const;

 private:
  struct Spike {
    float value;
    int x, y;
  };
  void gather_spikes(const Image& band, int y);

  int height_;
  float largest_ = 0;      ///< finite value met so far
  float infinite_is_ = 0;  ///< 0: not known yet
  double mean_ = 0;        ///< over the sphere and the channels, of the rows so far
  std::vector<Spike> spikes_;
  size_t many_spikes_ = 1 << 16;
  std::vector<char> negative_;  ///< pixels of the band that were negative in the file
  EnvironmentRepairs repairs_;
};

}  // namespace sateen
