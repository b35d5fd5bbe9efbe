#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/render.h"
#include "study/bias.h"
#include "study/study_scene.h"

namespace sateen_test {

using namespace sateen;

TEST(HalfLightShare, IsHalfForAConstantMapAndSmallForASun) {
  Image constant(32, 16, 3);
  std::fill(constant.pixels.begin(), constant.pixels.end(), 2.0f);
  EXPECT_NEAR(half_light_share(build_environment(constant)), 0.5, 0.02);
  constant.at(10, 5)[0] = constant.at(10, 5)[1] = constant.at(10, 5)[2] = 1e5f;
  EXPECT_LT(half_light_share(build_environment(constant)), 0.005);
}

TEST(StudyScenes, WhiteLightIsAConstantMapOfRadianceOne) {
  SceneSettings settings;
  settings.mesh = "swatch";
  settings.level = 0;
  settings.width = 16;
  settings.height = 9;
  settings.environment = white_light;
  SceneReport report;
  const Scene scene = assemble_study_scene(settings, ColorManager(), report);
  EXPECT_NEAR(report.metered_ev, 0, 1e-3);
  for (const Vec3& d : {Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, -1, 0)})
    EXPECT_EQ(environment_radiance(scene.environment, d), Color(1, 1, 1));
}

TEST(StudyScenes, ALabelIsTheNameOfTheFile) {
  EXPECT_EQ(light_label("/maps/old.town.exr"), "old.town");
  EXPECT_EQ(light_label("overcast"), "overcast");
}

// Two films around a truth of 1: noise of 0.1 of its own for each seed, and `bias` on top.
Film noisy_film(std::uint64_t seed, float bias) {
  Film film(64, 64, false);
  std::uint64_t state = seed * 977 + 13;
  for (FilmPixel& pixel : film.pixels) {
    pixel.samples = replicates;
    pixel.coverage = {1, 1, 1, 1};
    for (Vec3d& c : pixel.beauty) {
      state = state * 6364136223846793005ull + 1442695040888963407ull;
      c = Vec3d(1 + bias + 0.4f * (float(state >> 40) / float(1 << 24) - 0.5f));
    }
  }
  return film;
}

TEST(Bias, NoiseThatSeedsDoNotShareIsTakenOut) {
  const ColorManager colors;
  const DisplaySettings display = settle_display({}, colors);
  const Film fine_a = noisy_film(1, 0), fine_b = noisy_film(2, 0), same_a = noisy_film(3, 0),
             same_b = noisy_film(4, 0);
  const Film off_a = noisy_film(5, 0.05f), off_b = noisy_film(6, 0.05f);
  const Bias none = measure_bias({same_a, same_b}, {fine_a, fine_b}, colors, display, 0);
  EXPECT_LT(none.error.value, 0.012) << "noise alone is 0.08";
  EXPECT_EQ(none.error.low, 0);
  const Bias some = measure_bias({off_a, off_b}, {fine_a, fine_b}, colors, display, 0);
  EXPECT_NEAR(some.error.value, 0.05, 0.005);
  EXPECT_GT(some.error.low, 0.03);
  EXPECT_GT(some.visible, none.visible);
}

}  // namespace sateen_test
