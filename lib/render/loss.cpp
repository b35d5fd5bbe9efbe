#include "render/loss.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sateen {

namespace {
constexpr double normal_95 = 1.96;

Vec3d mean_of(const std::array<Vec3d, replicates>& each) {
  Vec3d sum(0);
  for (const Vec3d& v : each) sum += v;
  return sum / double(replicates);
}

double mean_channel(const Vec3d& v) {
  return (v.x + v.y + v.z) / 3;
}
}  // namespace

Interval picture_loss(std::span<const PixelLoss> pixels) {
  if (pixels.empty()) return {};
  double sum = 0, squares = 0;
  for (const PixelLoss& pixel : pixels) {
    double q = 0;
    for (int c = 0; c < 3; ++c) {
      double total = 0, own = 0;
      for (const Vec3d& lost : pixel.lost) {
        total += lost[c];
        own += lost[c] * lost[c];
      }
      q += (total * total - own) / (replicates * (replicates - 1)) / (3 * (pixel.value[c] * pixel.value[c] + 0.01));
    }
    sum += q;
    squares += q * q;
  }
  const auto n = double(pixels.size());
  const double mean = sum / n, half = normal_95 * std::sqrt(std::max(squares / n - mean * mean, 0.0) / n);
  const auto root = [](double v) { return std::sqrt(std::max(v, 0.0)); };
  return {root(mean), root(mean - half), root(mean + half)};
}

Interval light_share(std::span<const PixelLoss> pixels) {
  double lost = 0, total = 0;
  for (const PixelLoss& pixel : pixels) {
    lost += mean_channel(mean_of(pixel.lost));
    total += mean_channel(pixel.value);
  }
  if (!(total > 0)) return {};
  const double share = lost / total;
  double squares = 0;
  for (const PixelLoss& pixel : pixels) {
    const double off = mean_channel(mean_of(pixel.lost)) - share * mean_channel(pixel.value);
    squares += off * off;
  }
  const double half = normal_95 * std::sqrt(squares) / total;
  return {share, std::max(share - half, 0.0), share + half};
}

std::string percent_text(const Interval& share) {
  return fmt::format("{:.3g} % ({:.3g} to {:.3g})", 100 * share.value, 100 * share.low, 100 * share.high);
}

}  // namespace sateen
