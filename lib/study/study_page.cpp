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
  int scenes = 0, won = 0;
  double worst = 1;
  for (int i = 0; i < int(result.scenes.size()); ++i) {
    const Winner winner = scene_winner(result, i, Measure::relative);
    if (!result.scenes[size_t(i)].all_strategies || !winner.known) continue;
    const Ratio ratio = equal_time_ratio(result, i, result.ours, winner.strategy, Measure::relative);
    if (!ratio.known) continue;
    ++scenes;
    won += ratio.interval.value < 1;
    worst = std::max(worst, ratio.interval.value);
  }
  std::string text = fmt::format(
      "Leave --strategy at {}: in the same time it had less noise than every fixed strategy in {} of {} scenes, and "
      "at "
      "worst {:.2f} times the squared error of the best of them, which is another one from scene to scene.",
      strategy_name(result.ours), won, scenes, worst);
  for (const Bar& bar : study_bars(result))
    if (bar.what.find("over uniform, equal CPU time") != std::string::npos && bar.found.value > 0)
      text += fmt::format(" Plain uniform directions need about {:.0f} times its time for the same picture.",
                          1 / bar.found.value);
  return text;
}

}  // namespace

std::string study_page(const StudyResult& result, const std::filesystem::path& picture_folder) {
  Page page("Sampling strategies of cloth, measured", summary(result));
  if (result.interrupted)
    page.paragraph("INTERRUPTED: the study was stopped; only the scenes that were finished are here.");
  for (const std::string& each : result.skipped) page.note(each);
  page.paragraph(fmt::format(
      "Every strategy ends at the same picture; they differ in how grainy it is until then. Squared error below is "
      "the "
      "mean over pixels and channels of (x - r)^2 / (r^2 + floor^2) against a picture of many samples, the floor "
      "being "
      "0.1 as the picture is exposed: the square of the E that the program prints. A quarter of it is half the "
      "grain."));

  page.section("Side by side");
  std::vector<int> pictured;
  for (const StudyPicture& picture : result.pictures)
    if (std::find(pictured.begin(), pictured.end(), picture.scene) == pictured.end())
      pictured.push_back(picture.scene);
  for (const int scene : pictured) add_sliders(page, result, scene, picture_folder);
  if (pictured.empty()) page.note("No pictures were taken.");

  page.section("What the program is held to");
  page.table(goal_table(result));
  page.note("Below 1 the first has less error. Intervals come from repetitions with other seeds.");

  const std::vector<NamedPlot> plots = study_plots(result);
  page.section("All strategies at equal CPU time");
  for (const NamedPlot& plot : plots)
    if (plot.name == "equal_time") page.plot(plot.sheet, plot.caption);
  page.table(winner_table(result));
  page.paragraph(fmt::format("Squared error of {} over that of every other strategy, at equal CPU time:",
                             strategy_name(result.ours)));
  page.table(ratio_table(result));

  page.section("The talk of 2014");
  page.paragraph(
      "Wang, Xie and Krishnamachari (SIGGRAPH 2014 Talks) draw directions from a thread's own highlight and claim at "
      "most a "
      "quarter of the squared error of uniform directions at equal samples, and less than uniform with four times "
      "the "
      "samples. They speak of the thread; a cloth also hides its threads from one another and from light below it, "
      "which their sampler knows nothing of. Here are both readings.");
  for (const std::string& each : talk_findings(result)) page.paragraph(each);
  if (!result.thread_rows.empty()) {
    page.section("The talk's sampler on one thread");
    page.paragraph(
        "Noise power of one sample over that of a direction drawn uniformly over the sphere, under light from "
        "everywhere, "
        "computed and not sampled. The talk leaves open how the glow from inside is spread around the thread, and "
        "how "
        "highlight or glow is chosen: all four ways are here. Columns are angles of the view to the thread.");
    page.table(thread_table(result));
  }
  if (!result.talk_figures.empty()) {
    page.section("The talk's figures, of bare threads and of whole cloth");
    page.paragraph(
        "The skirt in satin and silk, direct light and light from fold to fold, its sampler over uniform directions. "
        "Bare threads: one thread a point, nothing hides it, uniform over the sphere. Whole cloth: as this program "
        "renders it, uniform over the hemisphere and evenly spread, which is harder to beat. Beats 4 times: less "
        "squared error "
        "than uniform directions with four times the samples.");
    page.table(figure_table(result));
    std::vector<SliderPicture> shown;
    for (const auto& [label, image] : result.thread_pictures) shown.push_back({label, picture_uri(image)});
    if (shown.size() > 1) page.slider("The skirt of bare threads at equal samples, white light.", shown, 480);
  }
  page.section("The talk's sampler in this program's pictures");
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
