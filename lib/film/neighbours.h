#pragma once
#include <algorithm>
#include <vector>

namespace sateen {

/// Mean of the values within `radius` rows and columns of each pixel, without the pixel's own: what is known of a
/// place and does not depend on the noise of the pixel there. `width` x `height` values, row by row; those that
/// `present` says 0 of do not count. Zero where none is left; `counts` gets how many there were.
template <class T>
std::vector<T> mean_of_neighbours(const std::vector<T>& values, const std::vector<double>& present, int width,
                                  int height, int radius, std::vector<double>* counts = nullptr) {
  struct Sum {
    T value = T(0);
    double count = 0;
    void add(const T& v, double c) { value += v * c, count += c; }
  };
  std::vector<Sum> rows(values.size());
  for (int y = 0; y < height; ++y) {
    const size_t row = size_t(y) * size_t(width);
    for (int x = 0; x < width; ++x)
      for (int k = std::max(x - radius, 0); k <= std::min(x + radius, width - 1); ++k)
        rows[row + size_t(x)].add(values[row + size_t(k)], present[row + size_t(k)]);
  }
  std::vector<T> out(values.size(), T(0));
  if (counts) counts->assign(values.size(), 0);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      Sum sum;
      for (int k = std::max(y - radius, 0); k <= std::min(y + radius, height - 1); ++k) {
        const Sum& row = rows[size_t(k) * size_t(width) + size_t(x)];
        // The own row is added up without the pixel: a difference would keep a rounding of its value.
        if (k != y) sum.value += row.value, sum.count += row.count;
      }
      const size_t row = size_t(y) * size_t(width);
      for (int k = std::max(x - radius, 0); k <= std::min(x + radius, width - 1); ++k)
        if (k != x) sum.add(values[row + size_t(k)], present[row + size_t(k)]);
      if (counts) (*counts)[row + size_t(x)] = sum.count;
      if (sum.count > 0) out[row + size_t(x)] = sum.value / sum.count;
    }
  }
  return out;
}

}  // namespace sateen
