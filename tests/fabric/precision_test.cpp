#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "cloth.h"
#include "fabric/thread_kernel.h"
#include "fabric/wide_threads.h"

// Two errors of the kernel that renders, kept apart: that of the quadrature of the tangent curve, and that of float.

namespace sateen::test {
namespace {

struct Sums {
  double v[4];  ///< surface of warp and weft, volume of warp and weft
  double total(const Look& look) const {
    const auto mean = [](const ThreadFamily& f) { return double(mean_component(f.A.value)); };
    return v[0] + v[1] + mean(look.warp) * v[2] + mean(look.weft) * v[3];
  }
};
template <class Real>
Sums sums(const ThreadSums<Real>& s) {
  return {{double(s.surface[0]), double(s.surface[1]), double(s.volume[0]), double(s.volume[1])}};
}

// A light direction that is worth looking at from this view: half of them near a mirror image in some tangent.
Vec3 light_direction(Random& random, const Vec3& wo) {
  if (random.uniform() < 0.5) return torture_direction(random);
  for (int attempt = 0; attempt < 50; ++attempt) {
    const double tilt = random.between(-90, 90) * M_PI / 180, spread = 0.3 * random.uniform();
    const bool warp = random.uniform() < 0.5;
    const Vec3 t = warp ? Vec3(float(std::cos(tilt)), 0, float(std::sin(tilt)))
                        : Vec3(0, float(std::cos(tilt)), float(std::sin(tilt)));
    // Around the tangent by any angle: the cone of mirror directions.
    const Vec3 u = normalize(cross(t, std::abs(t.z) < 0.9f ? Vec3(0, 0, 1) : Vec3(1, 0, 0))), v = cross(t, u);
    const double along = -double(dot(wo, t)) + spread * (random.uniform() - 0.5);
    if (std::abs(along) > 1) continue;
    const double across = std::sqrt(1 - along * along), a = random.between(0, 2 * M_PI);
    const Vec3 w = t * float(along) + u * float(across * std::cos(a)) + v * float(across * std::sin(a));
    if (w.z > 0) return normalize(w);
  }
  return random_direction(random);
}

// thread_kernel.h promises that the registers' width does not show. Without AVX-512 there is one width only.
TEST(Kernel, GivesTheSameBitsInWideAndInNarrowRegisters) {
  if (!wide_threads_run()) GTEST_SKIP() << "this processor has no AVX-512";
  for (const char* name : {"polyester_satin_charmeuse", "velvet", "linen_plain", "silk_crepe_de_chine"}) {
    const Fabric& fabric = fabric_of(look_named(name));
    const auto wide = std::make_unique<ThreadView<float>>(), narrow = std::make_unique<ThreadView<float>>();
    Random random{31};
    for (int view = 0; view < 300; ++view) {
      const Vec3 wo = torture_direction(random);
      prepare_wide_view(fabric.threads, wo.x, wo.y, wo.z, *wide);
      prepare_view_in<PairLanes>(fabric.threads, wo.x, wo.y, wo.z, *narrow);
      for (int i = 0; i < 20; ++i) {
        const Vec3 wi = light_direction(random, wo);
        const Sums a = sums(scatter_wide(fabric.threads, *wide, wi.x, wi.y, wi.z));
        const Sums b = sums(scatter_in<PairLanes>(fabric.threads, *narrow, wi.x, wi.y, wi.z));
        for (int k = 0; k < 4; ++k) ASSERT_EQ(a.v[k], b.v[k]) << name << " wo " << wo << " wi " << wi;
      }
    }
  }
}

// The curve many times as fine. 12 or 16 nodes know nothing of the renderer's correction for kinks and show what it
// is worth; curves too long for that take more panels of 8.
std::optional<Threads<double>> reference(const Look& look) {
  for (const auto& [degrees, nodes] : {std::pair{1.2, 16}, {2.0, 12}, {4.0, 8}}) {
    try {
      const Curves curves = fine_curves_of(look, degrees, nodes);
      return compile_threads<double>(look, curves.warp, curves.weft);
    } catch (const InputError&) {
    }
  }
  return std::nullopt;
}

// Largest error of the renderer's F over the peak of F at that view: of pairs above 0.6 degrees of the horizon, and
// below.
struct QuadratureError {
  double above = 0, below = 0;
};
template <class View, class Light>
std::optional<QuadratureError> quadrature_error(const Look& look, int views, int lights, const View& next_view,
                                                const Light& next_light) {
  const Curves curves = curves_of(look);
  const std::optional<Threads<double>> fine = reference(look);
  if (!fine) return std::nullopt;
  const Threads<float> threads = compile_threads<float>(look, curves.warp, curves.weft);
  auto view = std::make_unique<ThreadView<float>>();
  auto fine_view = std::make_unique<ThreadView<double>>();
  QuadratureError worst;
  for (int i = 0; i < views; ++i) {
    const Vec3 wo = next_view(i);
    const Vec3d o = exact(wo);
    prepare_view<float>(threads, wo.x, wo.y, wo.z, *view);
    prepare_view<double>(*fine, o.x, o.y, o.z, *fine_view);
    double peak = 1e-30;  // of views that show nothing at all there is no peak
    QuadratureError error;
    for (int k = 0; k < lights; ++k) {
      const Vec3 wi = next_light(wo);
      const Vec3d w = exact(wi);
      const double rendered = sums(scatter<float>(threads, *view, wi.x, wi.y, wi.z)).total(look);
      const double truth = sums(scatter<double>(*fine, *fine_view, w.x, w.y, w.z)).total(look);
      peak = std::max(peak, truth);
      double& mine = std::min(wi.z, wo.z) > 0.01f ? error.above : error.below;
      mine = std::max(mine, std::abs(rendered - truth));
    }
    worst.above = std::max(worst.above, error.above / peak);
    worst.below = std::max(worst.below, error.below / peak);
  }
  return worst;
}

/// Of views and lights from everywhere, and often from where F turns fastest.
std::optional<QuadratureError> quadrature_error(const Look& look, Random& random, int views, int lights) {
  return quadrature_error(
      look, views, lights, [&](int i) { return i % 2 ? torture_direction(random) : random_direction(random); },
      [&](const Vec3& wo) { return light_direction(random, wo); });
}

TEST(Quadrature, ErrorStaysBelowAThousandthOfTheViewsPeakForEveryLook) {
  Random random{11};
  for (const Look& look : all_looks()) {
    const Curves curves = curves_of(look);
    const QuadratureError error = *quadrature_error(look, random, long_tests() ? 1000 : 24, long_tests() ? 400 : 150);
    printf("quadrature of %-32s %3zu tangents, error %.2e of the peak, %.2e at the horizon\n", look.name.c_str(),
           curves.warp.size() + curves.weft.size(), error.above, error.below);
    EXPECT_LT(error.above, 1e-3) << look.name;
    EXPECT_LT(error.below, 1e-2) << look.name;
  }
}

// Where the light is nearly the mirror image of a view along the warp that grazes it, all masking turns within a few
// degrees: grazing panels of 8.5 degrees have 5e-4 here, and 7e-3 at the horizon.
TEST(Quadrature, HoldsWhereViewAndLightGrazeOppositeEndsOfTheWarp) {
  Random random{13};
  const auto low = [&](float side, float lowest) {
    const float z = lowest + (0.1f - lowest) * float(random.uniform()), y = 0.1f * float(random.uniform() - 0.5);
    return Vec3(side * std::sqrt(1 - y * y - z * z), y, z);
  };
  for (const char* name : {"ivory_duchess_satin", "silk_damask", "shot_taffeta"}) {
    const QuadratureError error = *quadrature_error(
        look_named(name), 200, 200, [&](int) { return low(random.uniform() < 0.5 ? -1.0f : 1.0f, 0.011f); },
        [&](const Vec3& wo) { return low(wo.x < 0 ? 1.0f : -1.0f, random.uniform() < 0.5 ? 1e-5f : 0.011f); });
    printf("opposite ends, %-24s error %.2e of the peak, %.2e at the horizon\n", name, error.above, error.below);
    EXPECT_LT(error.above, 2e-4) << name;
    EXPECT_LT(error.below, 2e-3) << name;
  }
}

// Tilts of up to a right angle, masking as narrow as 5 degrees and lobes of any width, often at the ends of what is
// legal: here the bar is 1e-3 for 97 of 100 looks and 2e-2 for all.
TEST(Quadrature, ErrorStaysSmallOverTheWholeLegalRange) {
  Random random{12};
  double worst = 0;
  int looks = 0, above = 0;
  for (int i = 0; i < (long_tests() ? 3000 : 100); ++i) {
    const Look look = random_look(random, i % 4 == 0);
    const std::optional<QuadratureError> both = quadrature_error(look, random, 6, 60);
    if (!both) continue;
    const double error = std::max(both->above, both->below);
    ++looks;
    above += error > 1e-3;
    worst = std::max(worst, error);
    EXPECT_LT(error, 2e-2) << "random look " << i;
  }
  EXPECT_GT(looks, long_tests() ? 2000 : 60);
  EXPECT_LE(above, 0.03 * looks);
  printf("quadrature of %d random looks: error %.2e of the peak, %d above 1e-3\n", looks, worst, above);
}

struct FloatErrors {
  double worst = 0;
  long off_horizon = 0, above_1e5 = 0;  ///< both from 0.6 degrees over the horizon up
};

// Relative error below 1e-3 of every pair. What no float can state, below 1e-36, does not count.
void compare_float(const Look& look, Random& random, int views, int lights, FloatErrors& errors) {
  const Curves curves = curves_of(look);
  const Threads<float> threads = compile_threads<float>(look, curves.warp, curves.weft);
  const Threads<double> oracle = compile_threads<double>(look, curves.warp, curves.weft);
  auto view = std::make_unique<ThreadView<float>>();
  auto oracle_view = std::make_unique<ThreadView<double>>();
  for (int i = 0; i < views; ++i) {
    const Vec3 wo = torture_direction(random);
    const Vec3d o = exact(wo);
    prepare_view<float>(threads, wo.x, wo.y, wo.z, *view);
    prepare_view<double>(oracle, o.x, o.y, o.z, *oracle_view);
    struct Value {
      double found, truth;
      bool off_horizon;
      Vec3d wi;
    };
    std::vector<Value> values;
    double peak = 0;
    for (int k = 0; k < lights; ++k) {
      const Vec3 wi = light_direction(random, wo);
      const Vec3d w = exact(wi);
      values.push_back({sums(scatter<float>(threads, *view, wi.x, wi.y, wi.z)).total(look),
                        sums(scatter<double>(oracle, *oracle_view, w.x, w.y, w.z)).total(look),
                        std::min(wi.z, wo.z) > 0.01f, w});
      peak = std::max(peak, values.back().truth);
    }
    for (const auto& [found, truth, off_horizon, w] : values) {
      if (!(truth > 1e-6 * peak) || truth < 1e-36) continue;
      const double error = std::abs(found - truth) / truth;
      errors.worst = std::max(errors.worst, error);
      errors.off_horizon += off_horizon;
      errors.above_1e5 += off_horizon && error > 1e-5;
      EXPECT_LT(std::abs(found - truth), 1e-3 * truth)
          << look.name << ", view " << wo << ", light (" << w.x << " " << w.y << " " << w.z << "): " << found
          << " for " << truth << ", peak " << peak;
    }
  }
}

// Every pair, those at the horizon too, agrees to 1e-3 of its own value, and 99.99 of 100 to 1e-5.
TEST(FloatKernel, AgreesWithTheSameKernelInDouble) {
  Random random{13};
  FloatErrors all;
  for (const Look& look : all_looks()) {
    FloatErrors errors;
    compare_float(look, random, long_tests() ? 2000 : 60, 200, errors);
    printf("float against double, %-32s worst %.2e, above 1e-5: %.4f %%\n", look.name.c_str(), errors.worst,
           100.0 * double(errors.above_1e5) / double(errors.off_horizon));
    all.off_horizon += errors.off_horizon;
    all.above_1e5 += errors.above_1e5;
  }
  EXPECT_LT(double(all.above_1e5), 1e-4 * double(all.off_horizon));
  printf("float against double: %.4f %% of %ld pairs above 1e-5\n",
         100.0 * double(all.above_1e5) / double(all.off_horizon), all.off_horizon);
}

// Lobes of half a degree ask for angles to a few millionths of themselves: here the second bar is 99.9 of 100.
TEST(FloatKernel, AgreesWithTheSameKernelInDoubleForRandomLooks) {
  Random random{14};
  FloatErrors errors;
  for (int i = 0; i < (long_tests() ? 2000 : 100); ++i) {
    const Look look = random_look(random, i % 4 == 0);
    try {
      compare_float(look, random, 10, 60, errors);
    } catch (const InputError&) {  // more tangents than possible: said so by the compiler of the look
    }
  }
  EXPECT_LT(double(errors.above_1e5), 1e-3 * double(errors.off_horizon));
  printf("float against double, random looks: worst %.2e, above 1e-5: %.4f %%\n", errors.worst,
         100.0 * double(errors.above_1e5) / double(errors.off_horizon));
}

}  // namespace
}  // namespace sateen::test
