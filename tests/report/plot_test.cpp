#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "base/files.h"
#include "image/scratch_folder.h"
#include "report/axis.h"
#include "report/plot.h"

namespace sateen_test {

using namespace sateen;

namespace {
PlotSheet sheet_of_two() {
  Plot plot;
  plot.title = "Satin, studio";
  plot.x_label = "samples a pixel";
  plot.y_label = "MSE";
  plot.series.push_back({"uniform", {{4, 0.5, 0.4, 0.6}, {8, 0.2, 0.15, 0.25}, {16, 0.09, 0.08, 0.1}}, 0});
  plot.series.push_back({"table", {{4, 0.05}, {8, 0.02}, {16, 0.006}}, 1});
  plot.slopes = true;
  PlotSheet sheet;
  sheet.title = "MSE against samples";
  sheet.subtitle = "two strategies";
  sheet.panels = {plot};
  return sheet;
}

int count_of(const std::string& text, const std::string& word) {
  int count = 0;
  for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}
}  // namespace

TEST(Axis, LogarithmicTicksAreLabelledAtPowersOfTenAndRise) {
  const Axis axis = axis_for({0.0003, 2.0}, true);
  EXPECT_LT(axis.low, 0.0003);
  EXPECT_GT(axis.high, 2.0);
  double last = 0;
  int labelled = 0;
  for (const Tick& tick : axis_ticks(axis, 5)) {
    EXPECT_GT(tick.value, last);
    last = tick.value;
    labelled += !tick.label.empty();
  }
  EXPECT_GE(labelled, 3);
  EXPECT_LE(labelled, 8);
  EXPECT_NEAR(axis.at(axis.low), 0, 1e-12);
  EXPECT_NEAR(axis.at(axis.high), 1, 1e-12);
}

TEST(Axis, AnAxisOfOneDecadeOrLessStillHasThreeLabels) {
  for (const double high : {1.3, 2.0, 7.0}) {
    int labelled = 0;
    for (const Tick& tick : axis_ticks(axis_for({1.0, high}, true), 5)) labelled += !tick.label.empty();
    EXPECT_GE(labelled, 2) << high;
  }
  int linear = 0;
  for (const Tick& tick : axis_ticks(axis_for({0.0, 6.0}, false), 6)) linear += !tick.label.empty();
  EXPECT_GE(linear, 4);
}

TEST(Axis, ValuesThatALogarithmCannotShowDoNotCount) {
  const Axis axis = axis_for({-1, 0, NAN, 3}, true);
  EXPECT_GT(axis.low, 0);
  EXPECT_LT(axis.low, 3);
  EXPECT_EQ(axis_for({}, false).high, 1);
}

TEST(PowerFit, FindsTheExponentAndSkipsWhatHasNoLogarithm) {
  std::vector<PlotPoint> points;
  for (const double x : {4.0, 8.0, 16.0, 32.0}) points.push_back({x, 3 * std::pow(x, -1.4)});
  points.push_back({64, 0});
  const PowerFit fit = fit_power(points);
  ASSERT_TRUE(fit.known);
  EXPECT_NEAR(fit.slope, -1.4, 1e-9);
  EXPECT_NEAR(fit.factor, 3, 1e-9);
  EXPECT_NEAR(fit.slope_error, 0, 1e-9);
  EXPECT_FALSE(fit_power({{4, 1}, {4, 2}}).known);
}

TEST(Plot, AnSvgIsWholeAndFetchesNothing) {
  const std::string svg = plot_svg(sheet_of_two());
  EXPECT_EQ(svg.rfind("<?xml", 0), 0u);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  EXPECT_EQ(count_of(svg, "http"), count_of(svg, "http://www.w3.org/"));
  EXPECT_EQ(count_of(svg, "<text"), 0) << "letters are outlines, no font is needed";
  EXPECT_TRUE(plot_svg(sheet_of_two()) == svg) << "the same plot has the same bytes";
}

TEST(Plot, APngHasTheSizeOfTheSheetTimesItsScale) {
  const std::string png = plot_png(sheet_of_two(), 1);
  ASSERT_EQ(png.rfind("\x89PNG", 0), 0u);
  const auto number = [&](size_t at) {
    unsigned value = 0;
    for (size_t i = at; i < at + 4; ++i) value = value << 8 | static_cast<unsigned char>(png[i]);
    return value;
  };
  EXPECT_EQ(number(16), 900u);
  EXPECT_GT(number(20), 430u);
  EXPECT_LT(number(20), 560u);
}

TEST(Plot, PointsThatCannotBeShownAreLeftOutAndAllElseIsDrawn) {
  PlotSheet sheet = sheet_of_two();
  const std::string before = plot_svg(sheet);
  for (PlotSeries& series : sheet.panels[0].series) series.points.push_back({16, -1});
  EXPECT_TRUE(plot_svg(sheet) == before);
  sheet.panels[0].series[1].points.push_back({32, 0.002});
  EXPECT_FALSE(plot_svg(sheet) == before);
}

TEST(Plot, WritesBothKindsUnderOneName) {
  const ScratchFolder folder;
  write_plot(folder.path / "error", sheet_of_two());
  EXPECT_TRUE(read_text_file(folder.path / "error.svg", 1 << 24) == plot_svg(sheet_of_two()));
  EXPECT_GT(std::filesystem::file_size(folder.path / "error.png"), 5000u);
}

}  // namespace sateen_test
