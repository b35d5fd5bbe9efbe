#include <gtest/gtest.h>

#include <cmath>

#include "study/study_report.h"

namespace sateen_test {

using namespace sateen;

namespace {

// A study that was never rendered: MSE of a strategy is factor / N^slope, a sample costs `price`.
struct Law {
  Strategy strategy;
  double factor, slope, price;
};

StudyResult made_study(const std::vector<Law>& laws, const std::vector<std::string>& lights) {
  StudyResult result;
  result.settings.samples = 16;
  result.settings.seeds = 3;
  result.ours = Strategy::mis_compensated;
  for (size_t k = 0; k < lights.size(); ++k) {
    StudyScene scene;
    scene.look = "satin";
    scene.light = lights[k];
    scene.all_strategies = scene.ladder = scene.finished = true;
    scene.light_share = 0.5;
    result.scenes.push_back(scene);
    for (const Law& law : laws)
      for (int samples = 4; samples <= 64; samples *= 2)
        for (int seed = 1; seed <= 3; ++seed) {
          const double mse = law.factor / std::pow(samples, law.slope) * (1 + 0.01 * (seed - 2));
          result.runs.push_back({int(k), law.strategy, samples, seed, law.price * samples, {mse, 2 * mse}});
        }
  }
  return result;
}

const std::vector<Law> plain{{Strategy::uniform, 1, 1, 1},
                             {Strategy::talk, 0.2, 1, 2},
                             {Strategy::table, 0.05, 1, 1},
                             {Strategy::mis_compensated, 0.01, 1, 2}};

}  // namespace

TEST(StudyAnalysis, EqualTimeGivesTheCheapStrategyMoreSamples) {
  const StudyResult study = made_study(plain, {"overcast"});
  // Ours: 0.01 / 16 in 32 seconds, in which uniform has 32 samples: 1 / 32.
  const Ratio ratio = equal_time_ratio(study, 0, Strategy::mis_compensated, Strategy::uniform, Measure::relative);
  ASSERT_TRUE(ratio.known);
  EXPECT_NEAR(ratio.interval.value, 0.01 / 16 * 32, 1e-9);
  EXPECT_LE(ratio.interval.low, ratio.interval.value);
  EXPECT_GE(ratio.interval.high, ratio.interval.value);
  EXPECT_FALSE(equal_time_ratio(study, 0, Strategy::mis, Strategy::uniform, Measure::relative).known);
}

TEST(StudyAnalysis, SamplesThatGrowDearerBuyLess) {
  StudyResult study = made_study(plain, {"overcast"});
  // Twice the samples of uniform now take four times as long: 4 samples 1 second, 16 samples 16, 32 samples 64.
  for (StudyRun& run : study.runs)
    if (run.strategy == Strategy::uniform) run.cpu_seconds = double(run.samples * run.samples) / 16;
  EXPECT_NEAR(samples_at_time(study, 0, Strategy::uniform, 32), std::sqrt(512.0), 1e-9);
  const Ratio ratio = equal_time_ratio(study, 0, Strategy::mis_compensated, Strategy::uniform, Measure::relative);
  EXPECT_NEAR(ratio.interval.value, 0.01 / 16 * std::sqrt(512.0), 1e-9);
}

TEST(StudyAnalysis, ToldWhichSamplesAreMissingAStrategyIsKnownAtTheCommonTime) {
  // The common time is 32 seconds; numbers of samples from 4 to 64 cost one strategy 2 seconds at most, the other 640
  // at least.
  for (const double price : {0.03, 160.0}) {
    std::vector<Law> laws = plain;
    laws.push_back({Strategy::mis, 0.02, 1, price});
    StudyResult study = made_study(laws, {"overcast"});
    EXPECT_EQ(missing_samples(study, 0, Strategy::uniform), 0);
    EXPECT_EQ(missing_samples(study, 0, Strategy::resampled), 0) << "it is not measured at all";
    EXPECT_EQ(missing_samples(study, 0, Strategy::mis), price < 1 ? 128 : 2);
    while (const int samples = missing_samples(study, 0, Strategy::mis))
      for (int seed = 1; seed <= 3; ++seed)
        study.runs.push_back({0, Strategy::mis, samples, seed, price * samples, {0.02 / samples, 0.04 / samples}});
    EXPECT_EQ(study.runs.back().samples, price < 1 ? 2048 : 1) << "no fewer than one sample can be taken";
    if (price < 1) {
      EXPECT_NEAR(mse_at_time(study, 0, Strategy::mis, 32, Measure::relative), 0.04 * price / 32, 1e-9);
    }
  }
}

TEST(StudyAnalysis, ASceneWhereOursIsNotKnownAtTheCommonTimePassesNoBar) {
  // Ours costs so much that its measured numbers lie far beyond the common time.
  std::vector<Law> laws = plain;
  laws.push_back({Strategy::automatic, 0.001, 1, 100});
  StudyResult study = made_study(laws, {"overcast"});
  study.ours = Strategy::automatic;
  for (const Bar& bar : study_bars(study)) EXPECT_EQ(bar.what.find("auto"), std::string::npos) << bar.what;
}

TEST(StudyAnalysis, BetweenMeasuredNumbersTheLineInLogarithmsIsUsed) {
  StudyResult study = made_study(plain, {"overcast"});
  const double time = 24;  // uniform: 24 samples, between 16 and 32
  EXPECT_NEAR(mse_at_time(study, 0, Strategy::uniform, time, Measure::absolute), 1.0 / 24, 1e-9);
  EXPECT_EQ(mse_at_time(study, 0, Strategy::uniform, 1e5, Measure::absolute), 0) << "far outside what was measured";
}

TEST(StudyAnalysis, ARareBrightSampleCountsInTheMeanAndWidensTheInterval) {
  StudyResult study = made_study(plain, {"low_sun"});
  const Ratio before = samples_ratio(study, 0, Strategy::table, 16, Strategy::uniform, 16, Measure::relative);
  for (StudyRun& run : study.runs)
    if (run.strategy == Strategy::uniform && run.samples == 16 && run.seed == 2) run.mse.relative *= 1000;
  const Ratio after = samples_ratio(study, 0, Strategy::table, 16, Strategy::uniform, 16, Measure::relative);
  EXPECT_NEAR(before.interval.value / after.interval.value, 334, 1);
  EXPECT_GT(after.interval.high / after.interval.low, 100 * before.interval.high / before.interval.low);
}

TEST(StudyAnalysis, BarsAreGeometricMeansAndFailWhereTheyMust) {
  std::vector<Law> laws = plain;
  laws.push_back({Strategy::resampled, 0.07, 1, 1});
  const StudyResult study = made_study(laws, {"white", "overcast"});
  const std::vector<Bar> bars = study_bars(study);
  ASSERT_EQ(bars.size(), 3u);  // nothing was measured with mis-talk or mis
  EXPECT_EQ(bars[0].what, "mis-compensated over uniform, equal CPU time, geometric mean of 2 scenes");
  EXPECT_NEAR(bars[0].found.value, 0.02, 1e-9);
  EXPECT_FALSE(bars[0].passed);
  EXPECT_EQ(bars[1].what, "resampled over uniform, 16 samples each, satin in constant white light");
  EXPECT_NEAR(bars[1].found.value, 0.07, 1e-9);
  EXPECT_FALSE(bars[1].passed);
  EXPECT_EQ(bars[2].what, "table over uniform, 16 samples each, satin in constant white light");
  EXPECT_NEAR(bars[2].found.value, 0.05, 1e-9);
  EXPECT_TRUE(bars[2].passed);
  const Table table = goal_table(study);
  EXPECT_EQ(table.rows[0].back(), "does not hold");
  EXPECT_EQ(table.rows[1].back(), "does not hold");
  EXPECT_EQ(table.rows[2].back(), "holds");
}

TEST(StudyAnalysis, AVerdictSaysWhereItsIntervalAllowsTheOther) {
  std::vector<Law> laws = plain;
  StudyResult study = made_study(laws, {"white", "overcast"});
  const Bar bar = study_bars(study)[0];
  EXPECT_GT(bar.found.value, bar.limit);
  for (StudyRun& run : study.runs)  // two seeds that disagree by far
    if (run.strategy == Strategy::uniform) run.mse.relative *= run.seed % 2 ? 8 : 0.125;
  const std::string verdict = goal_table(study).rows[0].back();
  EXPECT_NE(verdict.find(", perhaps by chance"), std::string::npos) << verdict;
}

TEST(StudyAnalysis, ScenesThatAreNotFinishedDoNotCount) {
  StudyResult study = made_study(plain, {"white", "overcast"});
  study.scenes[1].finished = false;
  EXPECT_NE(study_bars(study)[0].what.find("of 1 scene"), std::string::npos);
  EXPECT_EQ(ratio_table(study).rows.size(), 2u) << "one scene and the mean";
}

TEST(StudyAnalysis, TheWinnerIsClearWhereItsLeadIsBeyondChance) {
  const Winner clear = scene_winner(made_study(plain, {"white"}), 0, Measure::relative);
  ASSERT_TRUE(clear.known);
  EXPECT_EQ(clear.strategy, Strategy::mis_compensated);
  EXPECT_EQ(clear.second, Strategy::table);
  EXPECT_TRUE(clear.clear);
  StudyResult close = made_study({{Strategy::table, 1, 1, 1}, {Strategy::mis_compensated, 1.001, 1, 1}}, {"white"});
  for (StudyRun& run : close.runs)
    if (run.strategy == Strategy::table) run.mse.relative *= 1 + 0.1 * (run.seed - 2);
  EXPECT_FALSE(scene_winner(close, 0, Measure::relative).clear);
}

TEST(StudyAnalysis, TheTalksClaimsAreCheckedByNumberAndExplainedWhereTheyFail) {
  const std::vector<Claim> claims = study_claims(made_study(plain, {"white"}));
  ASSERT_EQ(claims.size(), 2u);
  EXPECT_EQ(claims[0].samples, 16);
  EXPECT_NEAR(claims[0].equal.value, 0.2, 1e-9);
  EXPECT_NEAR(claims[0].against_four.value, 0.8, 1e-9);
  EXPECT_TRUE(claims[0].quarter && claims[0].beats_four && claims[0].why.empty());
  // Uniform samples that converge faster than 1 / N make the second claim fail.
  std::vector<Law> steep = plain;
  steep[0] = {Strategy::uniform, 4, 1.5, 1};
  const std::vector<Claim> failed = study_claims(made_study(steep, {"white"}));
  EXPECT_FALSE(failed[0].beats_four);
  EXPECT_NE(failed[0].why.find("falls as N^-1.5"), std::string::npos) << failed[0].why;
}

/// In [0, 1).
double random(std::uint64_t& state) {
  state = state * 6364136223846793005ull + 1442695040888963407ull;
  return double(state >> 11) / 9007199254740992.0;
}

TEST(Jackknife, CoversTheMeanAboutAsOftenAsItSays) {
  // 400 means of 8 exponential-like values; a right interval misses 20 on average. The bounds 5 and 60 are passed by
  // chance with less than 1e-4 (skewed values cost some cover, which the upper bound allows for).
  std::uint64_t state = 7;
  int missed = 0;
  for (int trial = 0; trial < 400; ++trial) {
    std::vector<double> values;
    for (int i = 0; i < 8; ++i) values.push_back(1 + random(state) + random(state));
    const Interval found = jackknife_interval(8, [&](int without) {
      double sum = 0;
      for (int i = 0; i < 8; ++i) sum += i + 1 == without ? 0 : values[size_t(i)];
      return std::log(sum / (without > 0 ? 7 : 8));
    });
    missed += found.low > 2 || found.high < 2;
  }
  EXPECT_GE(missed, 5);
  EXPECT_LE(missed, 60);
}

/// Pixels of 0.5 with uniform noise in every replicate, of which `half` is half the width.
Film noisy_film(double half, std::uint64_t state) {
  Film film(128, 128, false);
  for (FilmPixel& pixel : film.pixels) {
    for (Vec3d& sum : pixel.beauty)
      for (int c = 0; c < 3; ++c) sum[c] = 0.5 + half * (2 * random(state) - 1);
    pixel.samples = replicates;
    pixel.coverage = {1, 1, 1, 1};
  }
  return film;
}

// Four replicates of variance h^2/3 make a mean of variance h^2/12. 49,152 values know it to 0.6 %.
TEST(Mse, IsThatOfTheFilmAloneHoweverNoisyTheReference) {
  const double truth = 0.2 * 0.2 / 12;
  for (const double half : {0.0, 0.1, 0.2}) {
    const Reference reference = make_reference(noisy_film(half, 1), replicates, default_error_floor);
    EXPECT_NEAR(mse_against(noisy_film(0.2, 2), reference).absolute / truth, 1, 0.05) << half;
    if (half == 0.2) continue;  // the denominators are noisy too
    EXPECT_NEAR(mse_against(noisy_film(0.2, 2), reference).relative / (truth / 0.26), 1, 0.05) << half;
  }
  const Reference reference = make_reference(noisy_film(0.2, 1), replicates, default_error_floor);
  EXPECT_GT(mse_against(noisy_film(0, 2), reference).absolute, 0) << "has a logarithm";
}

}  // namespace sateen_test
