#include "fabric/weave.h"

#include <gtest/gtest.h>

#include <numbers>

#include "fabric/cloth.h"
#include "fabric/tangent_terms.h"

namespace sateen::test {
namespace {

/// All looks, each with a draft of its own or of this list.
const std::vector<std::string>& drafts() {
  static const std::vector<std::string> all{"plain",     "twill 3/1",  "satin 5/2",
                                            "satin 8/3", "sateen 5/2", "twill 1/2 s"};
  return all;
}

Look woven(Look look, const std::string& draft) {
  look.weave.draft = {draft};
  look.weave.warp_per_cm = 10;
  look.weave.weft_per_cm = 7;
  look.weave.irregularity = look.weave.slubs = 0;
  return look;
}

TEST(YarnWidths, CoverTheSharesOfBothFamiliesWhateverTheDraft) {
  Random random{5};
  for (int i = 0; i < 20000; ++i) {
    double a = random.uniform(), b = random.uniform();
    if (a + b > 1) a = 1 - a, b = 1 - b;
    if (i % 3 == 0) b = 1 - a;
    const double up = i % 7 == 0 ? double(i % 2) : random.uniform();
    const YarnWidths w = yarn_widths(a, b, up);
    ASSERT_TRUE(w.warp >= 0 && w.warp <= 1 && w.weft >= 0 && w.weft <= 1) << a << " " << b << " " << up;
    EXPECT_NEAR(w.warp * (1 - (1 - up) * w.weft), a, 1e-5);
    EXPECT_NEAR(w.weft * (1 - up * w.warp), b, 1e-5);
  }
}

TEST(Yarns, CoverTheirSharesOfTheClothThickOrThin) {
  for (const Look& look : all_looks())
    for (const std::string& draft : drafts())
      for (const float uneven : {0.0f, 0.3f}) {
        Look l = woven(look, draft);
        l.weave.irregularity = uneven;
        l.weave.slubs = 2 * uneven;
        const Weave weave = compile_weave(l);
        // Places of a sequence that fills a square evenly and keeps step with no weave (R2, from the plastic number).
        const int n = 40000;
        const double repeats = uneven > 0 ? 60 : 1;
        double share[3] = {0, 0, 0};
        for (int i = 0; i < n; ++i) {
          const double x = std::fmod(0.5 + i * 0.7548776662466927, 1.0) * weave.picks * weave.weft_spacing * repeats;
          const double y = std::fmod(0.5 + i * 0.5698402909980532, 1.0) * weave.ends * weave.warp_spacing * repeats;
          share[1 + yarn_at(weave, x, y).family] += 1.0 / n;
        }
        // Uneven yarns, 120 and more of them, may stray from their mean by their own unevenness.
        const double tolerance = uneven > 0 ? 0.02 : 0.004;
        EXPECT_NEAR(share[1], double(l.warp.coverage), tolerance) << look.name << " " << draft << " " << uneven;
        EXPECT_NEAR(share[2], double(l.weft.coverage), tolerance) << look.name << " " << draft << " " << uneven;
      }
}

/// Shares of gaps, warp and weft over a repeat; `at` finds the yarn of a place.
template <class At>
std::array<double, 3> shares_of(const Weave& weave, const At& at) {
  std::array<double, 3> share{0, 0, 0};
  const int n = 40000;
  for (int i = 0; i < n; ++i)
    share[size_t(1 + at(std::fmod(0.5 + i * 0.7548776662466927, 1.0) * weave.picks * weave.weft_spacing,
                        std::fmod(0.5 + i * 0.5698402909980532, 1.0) * weave.ends * weave.warp_spacing)
                         .family)] += 1.0 / n;
  return share;
}

TEST(Yarns, AreAsWideAsTheCoverageOfTheirPlaceAsks) {
  for (const std::string& draft : drafts()) {
    Look look = woven(all_looks().front(), draft);
    look.warp.coverage = 0.35f;
    look.weft.coverage = 0.25f;
    const Weave weave = compile_weave(look);
    for (const auto& covered : {std::pair(0.35, 0.25), {0.1, 0.2}, {0.6, 0.4}, {0.0, 0.5}, {0.9, 0.6}, {0.0, 0.0}}) {
      const double warp = covered.first, weft = covered.second;
      const auto share = shares_of(weave, [&](double x, double y) {
        const YarnPlace place = yarn_at(weave, {warp, weft}, x, y);
        EXPECT_EQ(place.light, 1);
        return place;
      });
      const double whole = std::max(1.0, warp + weft);
      EXPECT_NEAR(share[1], warp / whole, 0.004) << draft << " " << warp << " " << weft;
      EXPECT_NEAR(share[2], weft / whole, 0.004) << draft << " " << warp << " " << weft;
    }
  }
}

TEST(Yarns, OfClosedGapsCoverEverythingInTheirSharesAndGiveTheLightOfBefore) {
  for (const std::string& draft : drafts()) {
    Look look = woven(all_looks().front(), draft);
    look.warp.coverage = 0.35f;
    look.weft.coverage = 0.25f;
    Weave weave = compile_weave(look);
    close_gaps(weave);
    const auto share = shares_of(weave, [&](double x, double y) {
      const YarnPlace place = yarn_at(weave, x, y);
      EXPECT_NEAR(double(place.light), 0.6, 1e-6);
      return place;
    });
    // Where rounding leaves two strips apart nothing shows for a ten-thousandth of the cloth at most.
    EXPECT_LT(share[0], 1e-4) << draft;
    EXPECT_NEAR(share[1], 0.35 / 0.6, 0.004) << draft;
    // Textures that thin the threads out close their gaps too.
    const auto thin = shares_of(weave, [&](double x, double y) { return yarn_at(weave, {0.1, 0.2}, x, y); });
    EXPECT_LT(thin[0], 1e-4) << draft;
    EXPECT_NEAR(double(yarn_at(weave, {0.1, 0.2}, 0.0001, 0.0001).light), 0.3, 1e-6);
  }
}

TEST(Profile, HasTheMeanOneForEveryHalfVectorAndIsBrightestBesideIt) {
  for (const double width : {0.3, 0.45, 1.0, 2.0})
    for (int m = -20; m <= 20; ++m) {
      const double middle = m / 20.0;
      constexpr int n = 20000;
      double sum = 0;
      for (int i = 0; i < n; ++i) {
        const double w = profile(-1 + 2 * (i + 0.5) / n, middle, width, 0.5 + 0.5 * (m & 1));
        ASSERT_TRUE(w >= 0 && w < 12) << middle << " " << width;
        sum += w / n;
      }
      EXPECT_NEAR(sum, 1, 2e-6) << middle << " " << width;
    }
  EXPECT_GT(profile(0, 0, 0.3, 0.5), 3 * profile(0.9, 0, 0.3, 0.5));
  EXPECT_GT(profile(0.5, 0.6, 0.3, 0.5), profile(-0.5, 0.6, 0.3, 0.5));
}

TEST(TangentTerms, AreTheKernelsOfAClothOfOneTangent) {
  Random random{77};
  double worst = 0;
  int lit = 0;
  for (int i = 0; i < 4000; ++i) {
    Look look = random_look(random, i % 2 == 0);
    const float offset = float(random.between(-85, 85));
    const bool warp = random.below(2) == 0;
    for (ThreadFamily* f : {&look.warp, &look.weft}) f->offsets_deg = {offset, offset}, f->lengths = {1};
    (warp ? look.warp : look.weft).coverage = 1;
    (warp ? look.weft : look.warp).coverage = 0;
    const Curves curves = curves_of(look);
    const Threads<double> exactly = compile_threads<double>(look, curves.warp, curves.weft);
    const Threads<float> threads = compile_threads<float>(look, curves.warp, curves.weft);
    const Vec3 wo = random_direction(random), wi = random_direction(random);
    const auto view = std::make_unique<ThreadView<double>>();
    prepare_view<double>(exactly, double(wo.x), double(wo.y), double(wo.z), *view);
    const ThreadSums<double> sums = scatter<double>(exactly, *view, double(wi.x), double(wi.y), double(wi.z));
    const int family = warp ? 0 : 1;
    const TangentTerms terms = tangent_terms(threads, threads.first[family], double(offset) * M_PI / 180, wo, wi);
    for (const auto& [is, is_to_be] : {std::pair(terms.surface, sums.surface[size_t(family)] * sums.reweight),
                                       std::pair(terms.volume, sums.volume[size_t(family)] * sums.reweight)}) {
      ASSERT_TRUE(std::isfinite(is) && is >= 0);
      // Constants of the threads are floats here: a Gaussian's tail far out shows their rounding.
      if (is_to_be > 1e-6) worst = std::max(worst, std::abs(is / is_to_be - 1)), ++lit;
    }
  }
  EXPECT_GT(lit, 2000);
  EXPECT_LT(worst, 2e-5);
}

/// Mean of the near model over one repeat, at 100,000 places that fill it evenly; the far model's own value in `far`.
ThreadSums<double> near_mean(const Fabric& fabric, const FabricView& view, const Vec3& wo, const Vec3& wi,
                             ThreadSums<float>& far) {
  const Weave& weave = fabric.weave;
  far = evaluate_parts(view, wi);
  ThreadSums<double> mean;
  constexpr int n = 100000;
  for (int i = 0; i < n; ++i) {
    // R2, as above.
    const double u = std::fmod(0.5 + i * 0.7548776662466927, 1.0), v = std::fmod(0.5 + i * 0.5698402909980532, 1.0);
    YarnPlace place = yarn_at(weave, u * weave.picks * weave.weft_spacing, v * weave.ends * weave.warp_spacing);
    place.near = 1;
    place.strands = 0.4f;
    ThreadSums<float> parts = far;
    add_yarn(weave, fabric.threads, place, wo, wi, parts);
    for (size_t f = 0; f < 2; ++f) {
      mean.surface[f] += double(parts.surface[f]) / n;
      mean.volume[f] += double(parts.volume[f]) / n;
    }
  }
  return mean;
}

TEST(NearModel, HasTheFarModelAsItsMeanForEveryPairOfDirections) {
  Random random{2013};
  double worst = 0;
  std::string worst_at;
  int pairs = 0;
  for (const Look& look : all_looks())
    for (const std::string& draft : drafts()) {
      if (!long_tests() && (pairs % 3 != 0)) {
        ++pairs;
        continue;
      }
      ++pairs;
      const Look l = woven(look, draft);
      FabricParts parts;
      parts.table = false;
      const Fabric fabric = compile_fabric(l, same_space, parts);
      const auto view = std::make_unique<FabricView>();
      for (int k = 0; k < 4; ++k) {
        // Grazing pairs are held to a bar of their own by precision_test.
        const Vec3 wo = direction(random.between(0, 70), random.between(0, 360));
        const Vec3 wi = direction(random.between(0, 70), random.between(0, 360));
        prepare_threads(fabric, wo, *view);
        ThreadSums<float> far;
        const ThreadSums<double> near = near_mean(fabric, *view, wo, wi, far);
        const double a = brightness(fabric, far);
        double b = near.surface[0] + near.surface[1];
        for (int f = 0; f < 2; ++f) b += double(mean_component(fabric.A[size_t(f)])) * near.volume[size_t(f)];
        if (a < 1e-3) continue;  // below a thousandth of white: the quadratures' own error
        if (std::abs(b / a - 1) > worst) {
          worst = std::abs(b / a - 1);
          worst_at = l.name + " " + draft;
        }
      }
    }
  if (std::getenv("SATEEN_TEST_NUMBERS")) fprintf(stderr, "worst %.2e at %s\n", worst, worst_at.c_str());
  EXPECT_LT(worst, 0.01) << worst_at;
}

TEST(NearModel, StaysFiniteOverTheWholeRangeOfParameters) {
  Random random{99};
  int lit = 0;
  for (int i = 0; i < 3000; ++i) {
    Look look = woven(random_look(random, i % 2 == 0), drafts()[size_t(i) % drafts().size()]);
    if (i % 5 == 0) look.warp.eta = look.weft.eta = 1;
    if (i % 5 == 1) look.warp.k_d = 0, look.weft.k_d = 1;
    if (i % 5 == 2) look.warp.offsets_deg = {-90, 90}, look.warp.lengths = {1};
    look.weave.irregularity = i % 4 == 0 ? 0.4f : 0;
    look.weave.slubs = i % 4 == 0 ? 1 : 0;
    const Weave weave = compile_weave(look);
    const Curves curves = curves_of(look);
    if (curves.warp.size() + curves.weft.size() > most_tangents - 16) continue;  // refused elsewhere
    const Threads<float> threads = compile_threads<float>(look, curves.warp, curves.weft);
    const auto view = std::make_unique<ThreadView<float>>();
    const Vec3 wo = torture_direction(random);
    prepare_view<float>(threads, wo.x, wo.y, wo.z, *view);
    for (int k = 0; k < 20; ++k) {
      const Vec3 wi = torture_direction(random);
      YarnPlace place = yarn_at(weave, random.between(-3, 3), random.between(-3, 3));
      ASSERT_TRUE(std::isfinite(place.offset) && std::abs(place.offset) < 1.5709f);
      ASSERT_TRUE(std::abs(place.across) <= 1);
      place.near = k % 2 ? 1.0f : float(random.uniform());
      ThreadSums<float> parts = scatter<float>(threads, *view, wi.x, wi.y, wi.z);
      add_yarn(weave, threads, place, wo, wi, parts);
      for (const float v : {parts.surface[0], parts.surface[1], parts.volume[0], parts.volume[1]}) {
        ASSERT_TRUE(std::isfinite(v) && v >= 0) << i << " " << v;
        lit += v > 0;
      }
    }
  }
  EXPECT_GT(lit, 1000);
}

TEST(NearModel, OffLeavesTheBitsOfTheFarModel) {
  Look look = woven(look_named("ivory_duchess_satin"), "satin 8/3");
  FabricParts parts;
  parts.table = false;
  const Fabric fabric = compile_fabric(look, same_space, parts);
  look.weave.draft.clear();
  const Fabric plain = compile_fabric(look, same_space, parts);
  EXPECT_TRUE(plain.weave.empty());
  const auto a = std::make_unique<FabricView>(), b = std::make_unique<FabricView>();
  Random random{3};
  for (int i = 0; i < 1000; ++i) {
    const Vec3 wo = random_direction(random), wi = random_direction(random);
    prepare_threads(fabric, wo, *a);
    prepare_threads(plain, wo, *b);
    EXPECT_EQ(evaluate(*a, wi), evaluate(*b, wi));
  }
}

TEST(Gaps, PassEverythingOrNothingFromNearAndTheirShareFromFar) {
  EXPECT_EQ(passing(0.2f, {}), 0.2f);
  EXPECT_EQ(passing(0.2f, {1, -1, 0, 0, 0, 0, 0}), 1.0f);
  EXPECT_EQ(passing(0.2f, {1, 0, 0, 0, 0, 0, 0}), 0.0f);
  EXPECT_NEAR(passing(0.2f, {0.5f, -1, 0, 0, 0, 0, 0}), 0.6f, 1e-6);
}

TEST(Yarns, OfLongFloatsKnowTheirPlaceBetweenTheFloatsEnds) {
  // Warp end 0 is never covered, end 1 by the picks 5 and 1500 alone.
  const int picks = 2000;
  Look look = woven(all_looks().front(), "plain");
  look.weave.draft.clear();
  for (int row = 0; row < picks; ++row) {
    const int pick = picks - 1 - row;
    look.weave.draft.push_back(std::string(pick % 2 ? "x." : ".x") + (pick == 5 || pick == 1500 ? "." : "x") + "x");
  }
  look.warp.coverage = 0.6f;
  look.weft.coverage = 0.3f;
  look.warp.offsets_deg = {-30, 30};
  look.warp.lengths = {1};
  const Weave weave = compile_weave(look);
  const auto offset_deg = [&](double along, int end) {
    const YarnPlace place = yarn_at(weave, along * weave.weft_spacing, (end + 0.5) * weave.warp_spacing);
    EXPECT_EQ(place.family, 0);
    return double(place.offset) * 180 / std::numbers::pi;
  };
  const auto expected = [](double share) { return -30 + 60 * (1 - share); };
  const double margin = (1 - weave.widths.weft) / 2, from = 6 - margin, to = 1500 + margin;
  for (const double share : {0.02, 0.3, 0.5, 0.97}) {
    EXPECT_NEAR(offset_deg(from + share * (to - from), 1), expected(share), 1e-3);
    EXPECT_NEAR(offset_deg(picks + from + share * (to - from), 1), expected(share), 1e-3);
    EXPECT_NEAR(offset_deg(share * picks, 0), expected(share), 1e-3);
    EXPECT_NEAR(offset_deg(share * picks - picks, 0), expected(share), 1e-3);
  }
}

}  // namespace
}  // namespace sateen::test
