#include <fmt/format.h>

#include <algorithm>

#include "report/page.h"
#include "study/study_report.h"

namespace sateen {

namespace {

// Sliders of one pictured scene: equal samples, then equal time; the reference stands in both.
void add_sliders(Page& page, const StudyResult& result, int scene, const std::filesystem::path& folder) {
  for (const bool equal_time : {false, true}) {
    std::vector<SliderPicture> shown;
    for (size_t i = 0; i < result.pictures.size(); ++i) {
      const StudyPicture& picture = result.pictures[i];
      if (picture.scene != scene || (!picture.reference && picture.equal_time != equal_time)) continue;
      shown.push_back({picture.label, picture_uri(folder / fmt::format("{:02}.jpg", i))});
    }
    if (shown.size() < 2) continue;
    page.slider(
        fmt::format("{}: {}. Drag the divider; choose what is compared below it.",
                    result.scenes[size_t(scene)].label(), equal_time ? "equal CPU time" : "equal number of samples"),
        shown, 760);
  }
}

std::string summary(const StudyResult& result) {
  const std::vector<Bar> bars = study_bars(result);
  const auto passed = std::count_if(bars.begin(), bars.end(), [](const Bar& b) { return b.passed; });
  int scenes = 0, won = 0;
  for (int i = 0; i < int(result.scenes.size()); ++i) {
    const Winner winner = scene_winner(result, i, Measure::relative);
    if (!result.scenes[size_t(i)].all_strategies || !winner.known) continue;
    const Ratio ratio = equal_time_ratio(result, i, result.ours, winner.strategy, Measure::relative);
    if (!ratio.known) continue;
    ++scenes;
    won += ratio.interval.value < 1;
  }
  return fmt::format(
      "{} of {} bars are passed. The program's own choice, {}, has less error at equal time than any fixed "
      "strategy in {} of {} scenes.",
      passed, bars.size(), strategy_name(result.ours), won, scenes);
}

}  // namespace

std::string study_page(const StudyResult& result, const std::filesystem::path& picture_folder) {
  Page page("Sampling strategies of cloth, measured", summary(result));
  if (result.interrupted)
    page.paragraph("INTERRUPTED: the study was stopped; only the scenes that were finished are here.");
  for (const std::string& each : result.skipped) page.note(each);
  page.paragraph(fmt::format(
      "Every strategy converges to the same picture; they differ in how much of their time is noise. Error is the "
      "relative mean squared error against a reference: the mean over pixels and channels of (x - r)^2 / (r^2 + "
      "0.01) "
      "in the working space, the square of the E that the program prints. Its square root is what is seen: a ratio "
      "of "
      "0.25 is half the noise."));

  page.section("Side by side");
  std::vector<int> pictured;
  for (const StudyPicture& picture : result.pictures)
    if (std::find(pictured.begin(), pictured.end(), picture.scene) == pictured.end())
      pictured.push_back(picture.scene);
  for (const int scene : pictured) add_sliders(page, result, scene, picture_folder);
  if (pictured.empty()) page.note("No pictures were taken.");

  page.section("Bars");
  page.table(bar_table(result));
  page.note("Ratios of relative MSE; below 1 the first is better. Intervals come from the seeds.");

  const std::vector<NamedPlot> plots = study_plots(result);
  page.section("All strategies at equal CPU time");
  for (const NamedPlot& plot : plots)
    if (plot.name == "equal_time") page.plot(plot.sheet, plot.caption);
  page.table(winner_table(result));
  page.paragraph(
      fmt::format("MSE of {} over that of every other strategy, at equal CPU time:", strategy_name(result.ours)));
  page.table(ratio_table(result));

  page.section("The talk's figures");
  page.paragraph(
      "The talk claims, for directions drawn from the cloth against uniform ones: at most a quarter of the MSE at "
      "equal "
      "samples, and less MSE than uniform with four times the samples.");
  for (const NamedPlot& plot : plots)
    if (plot.name != "equal_time") page.plot(plot.sheet, plot.caption);
  page.table(claim_table(result));
  for (const std::string& each : claim_reasons(result)) page.note(each + ".");

  page.section("How it was measured");
  page.paragraph(fmt::format(
      "{} on {}, {} x {} pixels, {} seeds. Sample numbers are powers of two times the film's replicates. Equal time "
      "is "
      "the CPU time of {} at {} samples: each strategy was measured at the two numbers of samples about that time "
      "and "
      "its error taken from the line between them in logarithms. Renders of all strategies alternate. CPU time is "
      "that "
      "of rendering: the direction table (about 0.3 s a look) and the ray tracer are built before, and the pilot "
      "of auto, less than a tenth of a CPU-second a picture of any size, is not counted either.",
      fmt::format("{} scenes", result.scenes.size()), result.settings.scene.mesh, result.settings.scene.width,
      result.settings.scene.height, result.settings.seeds, "mis-compensated", result.settings.samples));
  page.paragraph(fmt::format(
      "References are by {} with an independent seed. Their own error is estimated from the scatter of "
      "their replicates and taken off every MSE here: the third column says how large a part it is of the "
      "least one.",
      strategy_name(LightSettings().strategy)));
  page.table(reference_table(result));
  return page.html();
}

}  // namespace sateen
