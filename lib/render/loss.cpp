#include "render/loss.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

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

double relative_square(const Vec3d& square, const Vec3d& value, double error_floor) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) sum += square[c] / (3 * (value[c] * value[c] + error_floor * error_floor));
  return sum;
}

Interval picture_loss(std::span<const PixelLoss> pixels, double error_floor) {
  double sum = 0, weights = 0;
  std::vector<double> squares;
  for (const PixelLoss& pixel : pixels) {
    Vec3d total(0), own(0);
    for (const Vec3d& lost : pixel.lost) {
      total += lost;
      own += lost * lost;
    }
    squares.push_back(
        relative_square((total * total - own) / double(replicates * (replicates - 1)), pixel.value, error_floor));
    sum += pixel.weight * squares.back();
    weights += pixel.weight;
  }
  if (!(weights > 0)) return {};
  const double mean = sum / weights;
  double scatter = 0;
  for (size_t i = 0; i < squares.size(); ++i) {
    const double off = pixels[i].weight * (squares[i] - mean);
    scatter += off * off;
  }
  const double half = normal_95 * std::sqrt(scatter) / weights;
  const auto root = [](double v) { return std::sqrt(std::max(v, 0.0)); };
  // What chance brought below 0 is not known any better for that.
  return {root(mean), root(mean - half), root(std::max(mean, 0.0) + half)};
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
  const auto text = [](double s) {
    return s < 9.995 ? fmt::format("{:.3g}", 100 * s) : fmt::format("{:.0f}", 100 * s);
  };
  return fmt::format("{} % ({} to {})", text(share.value), text(share.low), text(share.high));
}

}  // namespace sateen
