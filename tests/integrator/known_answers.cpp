#include "integrator/known_answers.h"

#include <gtest/gtest.h>

#include <memory>
#include <numbers>

namespace sateen_test {

using namespace sateen;

namespace {
constexpr double pi_d = std::numbers::pi;
constexpr int batches = 16;
}  // namespace

Color scattered(const Fabric& fabric, const Vec3& wi, const Vec3& wo) {
  static const auto view = std::make_unique<FabricView>();
  prepare_view(fabric, wo, FabricSampler::uniform, *view);
  return evaluate(*view, wi);
}

Color reflectance(const Fabric& fabric, const Vec3& wo) {
  constexpr int thetas = 1024, phis = 512;
  const auto view = std::make_unique<FabricView>();
  prepare_view(fabric, wo, FabricSampler::uniform, *view);
  Vec3d sum(0);
  for (int i = 0; i < thetas; ++i)
    for (int j = 0; j < phis; ++j) {
      const double theta = ((i + 0.5) / thetas - 0.5) * pi_d, phi = ((j + 0.5) / phis - 0.5) * pi_d;
      const double c = std::cos(theta);
      const Color f =
          evaluate(*view, Vec3(float(std::sin(theta)), float(c * std::sin(phi)), float(c * std::cos(phi))));
      sum += Vec3d(f) * c;
    }
  return Color(Vec3(sum * (pi_d / thetas * pi_d / phis)));
}

Environment Sun::map(float rotation) const {
  return map_of(
      width, height, [this](int i, int j) { return i == x && j == y ? Color(radiance) : Color(0); }, rotation);
}

double Sun::solid_angle() const {
  return 2 * pi_d / width * (std::cos(pi_d * y / height) - std::cos(pi_d * (y + 1) / height));
}

Vec3 Sun::direction(double across, double down) const {
  const double top = std::cos(pi_d * y / height), bottom = std::cos(pi_d * (y + 1) / height);
  const double cosine = top + (bottom - top) * down, sine = std::sqrt(1 - cosine * cosine);
  // u = atan2(d.x, -d.z) / (2 pi) + 1/2
  const double longitude = ((x + across) / width - 0.5) * 2 * pi_d;
  return Vec3(float(sine * std::sin(longitude)), float(cosine), float(-sine * std::cos(longitude)));
}

Color Sun::integral(const std::function<Color(const Vec3&)>& value, int n) const {
  Vec3d sum(0);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) sum += Vec3d(value(direction((i + 0.5) / n, (j + 0.5) / n)));
  return Color(Vec3(sum * (double(radiance) * solid_angle() / (n * n))));
}

Estimate estimate(const Scene& scene, const LightSettings& light, int samples) {
  const auto scratch = std::make_unique<PathScratch>();
  Estimate out;
  for (int b = 0; b < batches; ++b) {
    Vec3d sum(0);
    for (int k = 0; k < samples; ++k) {
      const CameraSample s =
          trace_sample(scene, light, 77 + std::uint32_t(b), {0, 0, k % 4, std::uint32_t(k / 4)}, *scratch);
      sum += Vec3d(s.total());
      out.alpha += double(s.alpha) / (samples * batches);
      out.backdrop += Vec3d(s.backdrop) / double(samples * batches);
      out.indirect += Vec3d(s.indirect.total()) / double(samples * batches);
    }
    for (int c = 0; c < 3; ++c) out.channel[c].add(sum[c] / samples);
  }
  EXPECT_EQ(scratch->counts.non_finite, 0);
  return out;
}

void expect_value(const Estimate& got, const Color& expected, double deviate, double slack, const std::string& what) {
  for (int c = 0; c < 3; ++c) {
    const auto value = double(expected[c]);
    if (std::abs(got.channel[c].mean - value) <= slack * value) continue;
    EXPECT_LT(std::abs(difference_deviate(got.channel[c], value)), deviate)
        << what << ", channel " << c << ": " << got.channel[c].mean << " +- "
        << std::sqrt(got.channel[c].variance_of_mean()) << ", expected " << value;
  }
}

}  // namespace sateen_test
