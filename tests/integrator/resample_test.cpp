#include "integrator/resample.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"

namespace sateen_test {
namespace {

using namespace sateen;

std::vector<LightRay> rays_worth(const std::vector<float>& worths) {
  std::vector<LightRay> rays;
  for (const float worth : worths) {
    const Vec3 name(float(rays.size()), 0, 0);  // tells who it was
    const Color light(2 * worth, worth, 1);     // of whose blue `worth` knows nothing
    const float odds = rays.size() % 3 == 0 ? 0.25f : 1.0f;
    rays.push_back({name, name, light, worth, odds});
  }
  return rays;
}

// The mean over all numbers is an integral of steps, the narrowest of them a thousandth wide.
TEST(ThinOut, HasTheLightOfAllAsItsExpectation) {
  for (const int most : {1, 3, 16}) {
    const std::vector<float> worths{0.3f, 5, 0.2f, 1, 1, 0.7f, 20, 0.2f, 0.9f, 1.5f, 0.05f, 3};
    Vec3d all(0), mean(0);
    for (const LightRay& ray : rays_worth(worths)) all += Vec3d(ray.light);
    constexpr int numbers = 65536;
    for (int n = 0; n < numbers; ++n) {
      std::vector<LightRay> rays = rays_worth(worths);
      const size_t kept = thin_out(rays, most, (n + 0.5) / numbers);
      ASSERT_LE(kept, size_t(most));
      for (size_t i = 0; i < kept; ++i) {
        mean += Vec3d(rays[i].light) / double(numbers);
        if (i == 0) continue;
        EXPECT_LT(rays[i - 1].wi.x, rays[i].wi.x) << "in their order, none twice";
      }
    }
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c] / all[c], 1, 2e-3) << most << " " << c;
  }
}

TEST(ThinOut, LeavesWhatStandsOutAsItIs) {
  const std::vector<float> worths{1, 1, 400, 1, 1, 300, 1, 1};
  for (const double u : {0.0, 0.3, 0.999999}) {
    std::vector<LightRay> rays = rays_worth(worths);
    for (LightRay& ray : rays) ray.odds = 1;
    const size_t kept = thin_out(rays, 3, u);
    ASSERT_GE(kept, 2u);
    int found = 0;
    for (size_t i = 0; i < kept; ++i)
      if (rays[i].wi.x == 2 || rays[i].wi.x == 5) {
        ++found;
        EXPECT_EQ(rays[i].worth, worths[size_t(rays[i].wi.x)]);
        EXPECT_EQ(rays[i].light.y, worths[size_t(rays[i].wi.x)]);
      }
    EXPECT_EQ(found, 2);
  }
}

TEST(ThinOut, OfNothingIsNothing) {
  std::vector<LightRay> none;
  EXPECT_EQ(thin_out(none, 3, 0.5), 0u);
  std::vector<LightRay> worthless = rays_worth({0, 0, 0, 0});
  EXPECT_EQ(thin_out(worthless, 3, 0.5), 0u);
  std::vector<LightRay> tiny = rays_worth({1e-30f, 1e-30f, 1e-30f, 1e-30f, 1e-30f, 1e-30f});
  const size_t kept = thin_out(tiny, 3, 0.5);
  ASSERT_GE(kept, 2u);
  for (size_t i = 0; i < kept; ++i) EXPECT_TRUE(std::isfinite(tiny[i].light.x + tiny[i].light.z));
}

TEST(Candidates, AreReadAsTheyAreWritten) {
  for (const CandidateCounts& counts : {CandidateCounts(8), CandidateCounts(4, 16), CandidateCounts(64, 0)})
    EXPECT_EQ(candidates_from_text(candidates_text(counts)), counts);
  EXPECT_EQ(candidates_text(8), "8");
  EXPECT_EQ(candidates_text({4, 16}), "4+16");
  for (const char* text : {"", "0", "65", "+", "8+", "+8", "8+65", "8+-1", "-8", "8 + 4", "8+4+2", "8.5", "many"})
    EXPECT_THROW(candidates_from_text(text), InputError) << text;
}

}  // namespace
}  // namespace sateen_test
