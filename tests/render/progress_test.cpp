#include "render/progress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace sateen {

namespace {
std::vector<double> percents(ProgressStyle style, const std::vector<double>& fractions, int parts = 1,
                             bool finished = true) {
  std::string text;
  Progress progress(
      style, [&](std::string_view piece) { text += piece; }, parts);
  for (int part = 0; part < parts; ++part) {
    for (const double f : fractions) {
      RenderState state;
      state.fraction = f;
      progress.update(state);
    }
    progress.finish_part();
  }
  if (finished) progress.done();
  progress.update({});
  std::vector<double> values;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    values.push_back(std::stod(line.substr(line.find_first_of("0123456789"))));
  return values;
}
}  // namespace

TEST(ProgressText, NeverGoesBackAndReachesAHundredInDoneAlone) {
  for (const ProgressStyle style :
       {ProgressStyle::lines, ProgressStyle::alf, ProgressStyle::openjd, ProgressStyle::json}) {
    const auto values = percents(style, {0.1, 0.5, 0.2, 0.7, 1.0, 0.9});
    EXPECT_TRUE(std::is_sorted(values.begin(), values.end()));
    EXPECT_EQ(values.back(), 100);
    EXPECT_EQ(std::count(values.begin(), values.end(), 100), 1);
    const auto stopped = percents(style, {0.1, 1.0}, 1, false);
    EXPECT_LT(stopped.back(), 100);
  }
}

TEST(ProgressText, PartsShareTheWholeEvenly) {
  const auto values = percents(ProgressStyle::alf, {0.5}, 4);
  EXPECT_EQ(values, (std::vector<double>{12, 25, 37, 50, 62, 75, 87, 99, 100}));
}

TEST(ProgressText, ALinePerPercentAndNoMore) {
  std::vector<double> fractions;
  for (int i = 0; i <= 5000; ++i) fractions.push_back(i / 5000.0);
  EXPECT_EQ(percents(ProgressStyle::lines, fractions).size(), 101u);
}

TEST(ProgressText, FarmsReadTheirOwnWords) {
  std::string text;
  Progress alf(ProgressStyle::alf, [&](std::string_view piece) { text += piece; });
  RenderState state;
  state.fraction = 0.45;
  alf.update(state);
  EXPECT_EQ(text, "ALF_PROGRESS 45%\n");
  text.clear();
  Progress openjd(ProgressStyle::openjd, [&](std::string_view piece) { text += piece; });
  openjd.update(state);
  EXPECT_EQ(text, "openjd_progress: 45.0\n");
}

TEST(ProgressText, ClockReadsLikeAClock) {
  EXPECT_EQ(clock_text(7), "0:07");
  EXPECT_EQ(clock_text(725), "12:05");
  EXPECT_EQ(clock_text(10931), "3:02:11");
  EXPECT_EQ(clock_text(-5), "0:00");
}

}  // namespace sateen
