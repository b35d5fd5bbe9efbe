#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/error.h"
#include "study/cost_report.h"

namespace sateen_test {

using namespace sateen;

namespace {

Price price(const std::string& setting, double seconds, double noise, double bias, double visible = 5) {
  Price p;
  p.setting = setting;
  p.flags = {"--" + setting.substr(0, setting.find(' '))};
  p.cpu_seconds = seconds;
  p.noise = noise;
  p.bias = {{bias, bias * 0.9, bias * 1.1}, bias > 0 ? visible : 0};
  return p;
}

// E = 0.4 / sqrt(N), a second a sample.
CostResult made_cost() {
  CostResult result;
  result.settings.threads = 1;
  std::vector<PlotPoint> curve;
  for (int n = 4; n <= 64; n *= 2) {
    const double e = 0.4 / std::sqrt(n);
    result.points.push_back({n, double(n), {e, e * 0.98, e * 1.02}, e});
    curve.push_back({double(n), e});
  }
  result.fit = fit_power(curve);
  result.lists.push_back(
      {"level",
       true,
       true,
       true,
       {price("coarse", 0.5, 0.05, 0.05), price("middle (asked)", 1, 0.05, 0.002), price("fine", 2, 0.05, 0)}});
  result.lists.push_back(
      {"strategy", false, false, true, {price("good", 1, 0.025, 0), price("plain (asked)", 1, 0.05, 0)}});
  settle_advice(result);
  return result;
}

}  // namespace

TEST(CostAdvice, TheFitTellsWhatAHalvingCosts) {
  const CostResult cost = made_cost();
  EXPECT_NEAR(cost.fit.slope, -0.5, 1e-9);
  EXPECT_NEAR(seconds_for_error(cost, 0.1), 16, 1e-6);
  const std::vector<std::string> sentences = halving_sentences(cost);
  ASSERT_FALSE(sentences.empty());
  // 0.16 takes 6.25 s, 0.08 takes 25 s.
  EXPECT_NE(std::find(sentences.begin(), sentences.end(), "16 % -> 8 %: +19 s"), sentences.end()) << sentences[0];
  EXPECT_NE(sentences.back().find("beyond what was measured"), std::string::npos) << sentences.back();
}

TEST(CostAdvice, EnoughIsWhereNobodySeesADifferenceAnyMore) {
  CostResult cost = made_cost();
  EXPECT_EQ(cost.lists[0].enough, 2) << "two thousandths and 5 code values can be seen";
  EXPECT_EQ(cost.lists[1].enough, 0);
  cost.lists[0].prices[1] = price("middle (asked)", 1, 0.05, 0.0008, 0.4);
  settle_advice(cost);
  EXPECT_EQ(cost.lists[0].enough, 1);
}

TEST(CostAdvice, QualitiesAreTheCheapestCombinationBelowTheirError) {
  const CostResult cost = made_cost();
  ASSERT_EQ(cost.qualities.size(), 3u);
  const Quality &draft = cost.qualities[0], &finest = cost.qualities[2];
  EXPECT_EQ(draft.name, "draft");
  EXPECT_EQ(finest.name, "final");
  for (const Quality& q : cost.qualities) {
    ASSERT_TRUE(q.reached) << q.name;
    EXPECT_LE(std::hypot(q.noise, q.bias), q.target * 1.0001);
    EXPECT_EQ(q.chosen[1], 0) << "the strategy of half the noise";
    EXPECT_NE(q.flags.find("--good"), std::string::npos) << q.flags;
    EXPECT_NE(q.flags.find(fmt::format("--spp {}", q.samples)), std::string::npos) << q.flags;
  }
  EXPECT_EQ(draft.chosen[0], 0) << "a draft may be coarse";
  EXPECT_NE(finest.chosen[0], 0) << "a final picture may not: its bias alone is 5 %";
  EXPECT_LT(draft.cpu_seconds, finest.cpu_seconds);
  for (size_t i = 1; i < cost.frontier.size(); ++i) EXPECT_GE(cost.frontier[i].x, cost.frontier[i - 1].x);
}

TEST(Cost, ASceneIsMeasuredFromNoiseToRecommendation) {
  CostSettings settings;
  settings.scene.mesh = "swatch";
  settings.scene.environment = "overcast";
  settings.scene.level = 1;
  settings.scene.width = 48;
  settings.scene.height = 27;
  const ColorManager colors;
  settings.display = settle_display({}, colors);
  settings.most_samples = 16;
  settings.price_samples = 8;
  settings.seeds = 2;
  double fraction = 0;
  const CostResult cost = measure_cost(settings, colors, [&](const StudyState& s) {
    EXPECT_GE(s.fraction, fraction);
    fraction = s.fraction;
  });
  EXPECT_FALSE(cost.interrupted);
  ASSERT_EQ(cost.points.size(), 3u);
  EXPECT_LT(cost.points[2].true_error.value, cost.points[0].true_error.value);
  EXPECT_LT(cost.fit.slope, -0.3);
  ASSERT_EQ(cost.lists.size(), 4 + approximation_list().size());
  for (const PriceList& list : cost.lists) {
    EXPECT_GE(list.prices.size(), 3u) << list.name;
    EXPECT_GE(list.enough, 0) << list.name;
  }
  EXPECT_NE(cost_text(cost).find("Recommended"), std::string::npos);
}

TEST(Cost, AnInterruptLeavesWhatIsFinished) {
  CostSettings settings;
  settings.scene.mesh = "swatch";
  settings.scene.environment = "overcast";
  settings.scene.level = 0;
  settings.scene.width = 32;
  settings.scene.height = 18;
  settings.most_samples = 16;
  std::atomic<bool> interrupt = false;
  const ColorManager colors;
  settings.display = settle_display({}, colors);
  const CostResult cost = measure_cost(
      settings, colors, [&](const StudyState& s) { interrupt = s.doing == "error at 8 samples" || interrupt; },
      &interrupt);
  EXPECT_TRUE(cost.interrupted);
  EXPECT_EQ(cost.points.size(), 1u);
  EXPECT_TRUE(cost.lists.empty());
  EXPECT_EQ(cost_text(cost).rfind("INTERRUPTED", 0), 0u);
}

TEST(Cost, TooFewSamplesAreRefused) {
  CostSettings settings;
  settings.most_samples = 4;
  try {
    measure_cost(settings, ColorManager());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              fmt::format("error: a price list wants 2 seeds and {} samples or more, has 3 and 4", 2 * replicates));
  }
}

}  // namespace sateen_test
