#include "scene/environment_rows.h"

#include <algorithm>

#include "scene/environment_build.h"

namespace sateen {

void EnvironmentRows::begin(int y) {
  if (y == 0) next_ = 0;
  if (y == first(next_, height_, to_.height)) sums_.assign(4 * size_t(to_.width), 0);
}

void EnvironmentRows::finish(int y) {
  if (y + 1 < first(next_ + 1, height_, to_.height)) return;
  std::vector<Color> row(static_cast<size_t>(to_.width));
  for (int x = 0; x < to_.width; ++x) {
    const double* sum = &sums_[4 * size_t(x)];
    const float mean[3] = {float(sum[0] / sum[3]), float(sum[1] / sum[3]), float(sum[2] / sum[3])};
    EnvironmentRepairs::Kind none;
    row[size_t(x)] = scaled_radiance(mean, 1, x, next_, none);
  }
  set_row(to_, next_, row);
  ++next_;
}

void EnvironmentRows::add(int y, const std::vector<Color>& row) {
  if (is_as_it_is()) return set_row(to_, y, row);
  begin(y);
  const double weight = environment_row_weight(y, height_);
  for (int x = 0; x < to_.width; ++x) {
    double* sum = &sums_[4 * size_t(x)];
    for (int u = first(x, width_, to_.width); u < first(x + 1, width_, to_.width); ++u) {
      for (int i = 0; i < 3; ++i) sum[i] += weight * double(row[size_t(u)][i]);
      sum[3] += weight;
    }
  }
  finish(y);
}

void EnvironmentRows::add_black(int y) {
  if (is_as_it_is()) return set_row(to_, y, std::vector<Color>(size_t(width_), Color(0)));
  begin(y);
  const double weight = environment_row_weight(y, height_);
  for (int x = 0; x < to_.width; ++x)
    sums_[4 * size_t(x) + 3] += weight * (first(x + 1, width_, to_.width) - first(x, width_, to_.width));
  finish(y);
}

}  // namespace sateen
