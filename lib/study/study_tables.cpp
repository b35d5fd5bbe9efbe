#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/study_report.h"

namespace sateen {

namespace {
bool is_compared(const StudyScene& scene) {
  return scene.all_strategies && scene.finished;
}
}  // namespace

std::string interval_text(const Interval& i, int digits) {
  constexpr double hopeless = 1e4;
  if (i.high > hopeless * i.low) return number_text(i.value) + " (rests on rare samples)";
  return fmt::format("{} ({} to {})", number_text(i.value, digits), number_text(i.low), number_text(i.high));
}

Table run_table(const StudyResult& result) {
  Table table{{"look", "light", "bounces", "strategy", "samples", "seed", "cpu_seconds", "mse", "relative_mse"}, {}};
  for (const StudyRun& run : result.runs) {
    const StudyScene& s = result.scenes[size_t(run.scene)];
    table.rows.push_back({s.look, light_label(s.light), std::to_string(s.bounces), strategy_name(run.strategy),
                          std::to_string(run.samples), std::to_string(run.seed), number_text(run.cpu_seconds, 4),
                          number_text(run.mse.absolute, 6), number_text(run.mse.relative, 6)});
  }
  return table;
}

Table goal_table(const StudyResult& result) {
  Table table{{"squared error of the first over that of the second", "should be at most", "is (95 % interval)", ""},
              {}};
  for (const Bar& bar : study_bars(result)) {
    const bool open = bar.found.low < bar.limit && bar.limit < bar.found.high;
    table.rows.push_back(
        {bar.what, number_text(bar.limit), interval_text(bar.found),
         fmt::format("{}{}", bar.passed ? "holds" : "does not hold", open ? ", perhaps by chance" : "")});
  }
  return table;
}

Table ratio_table(const StudyResult& result) {
  Table table{{"scene"}, {}};
  std::vector<Strategy> others;
  for (const std::string& name : strategy_names())
    if (const Strategy strategy = strategy_from_name(name); strategy != result.ours) {
      others.push_back(strategy);
      table.head.push_back(name);
    }
  std::vector<double> logs(others.size(), 0.0);
  std::vector<int> known(others.size(), 0);
  for (int i = 0; i < int(result.scenes.size()); ++i) {
    if (!is_compared(result.scenes[size_t(i)])) continue;
    std::vector<std::string> row{result.scenes[size_t(i)].label()};
    for (size_t k = 0; k < others.size(); ++k) {
      const Ratio ratio = equal_time_ratio(result, i, result.ours, others[k], Measure::relative);
      row.push_back(ratio.known ? number_text(ratio.interval.value) : "-");
      if (ratio.known) logs[k] += std::log(ratio.interval.value), ++known[k];
    }
    table.rows.push_back(row);
  }
  std::vector<std::string> mean{"geometric mean"};
  for (size_t k = 0; k < others.size(); ++k)
    mean.push_back(known[k] > 0 ? number_text(std::exp(logs[k] / known[k])) : "-");
  if (!table.rows.empty()) table.rows.push_back(mean);
  return table;
}

Table winner_table(const StudyResult& result) {
  Table table{{"scene", "least MSE", "second", "beyond chance", "candidates of auto", "auto / least"}, {}};
  for (int i = 0; i < int(result.scenes.size()); ++i) {
    if (!is_compared(result.scenes[size_t(i)])) continue;
    const Winner winner = scene_winner(result, i, Measure::relative);
    if (!winner.known) continue;
    const Ratio ratio = equal_time_ratio(result, i, result.ours, winner.strategy, Measure::relative);
    table.rows.push_back({result.scenes[size_t(i)].label(), strategy_name(winner.strategy),
                          strategy_name(winner.second), winner.clear ? "yes" : "no",
                          candidates_text(result.scenes[size_t(i)].candidates),
                          ratio.known ? fmt::format("{:.2f}", ratio.interval.value) : "-"});
  }
  return table;
}

Table reference_table(const StudyResult& result) {
  Table table{{"scene", "samples", "relative MSE", "of the least measured", "half of the light from"}, {}};
  for (int i = 0; i < int(result.scenes.size()); ++i) {
    const StudyScene& s = result.scenes[size_t(i)];
    if (!s.finished) continue;
    double least = 1e300;
    for (const StudyRun& run : result.runs)
      if (run.scene == i) least = std::min(least, run.mse.relative);
    table.rows.push_back({s.label(), std::to_string(s.reference_samples), number_text(s.reference_error.relative),
                          fmt::format("{:.1f} %", 100 * s.reference_error.relative / least),
                          fmt::format("{:.2g} % of the sphere", 100 * s.light_share)});
  }
  return table;
}

std::string study_text(const StudyResult& result) {
  std::string text;
  if (result.interrupted) text += "INTERRUPTED: only the scenes that were finished are here.\n\n";
  for (const std::string& each : result.skipped) text += "note: " + each + "\n";
  text += fmt::format(
      "MSE is relative: mean of (x - r)^2 / (r^2 + floor^2), floor 0.1 as the picture is exposed. {} seeds, {} x {} "
      "pixels, "
      "equal time is\nthe CPU time of mis-compensated at {} samples. auto is what the program does unless told "
      "otherwise: {} with\nas many candidates as its pilot chooses, samples dealt out by error. {:.0f} "
      "CPU-seconds.\n\n",
      result.settings.seeds, result.settings.scene.width, result.settings.scene.height, result.settings.samples,
      strategy_name(LightSettings().strategy), result.cpu_seconds);
  const auto part = [&](const char* title, const Table& table) {
    if (!table.rows.empty()) text += fmt::format("{}\n\n{}\n", title, table_text(table));
  };
  part("What the program is held to", goal_table(result));
  part("Best strategy of every scene at equal CPU time", winner_table(result));
  part(fmt::format("MSE of {} over that of every strategy, at equal CPU time", strategy_name(result.ours)).c_str(),
       ratio_table(result));
  for (const std::string& each : talk_findings(result)) text += each + "\n";
  text += "\n";
  part("One thread: variance of the talk's sampler over uniform's, by quadrature, views in degrees",
       thread_table(result));
  part("The talk's figures on the skirt: squared error of its sampler over uniform's", figure_table(result));
  part("The talk's claims in this program's pictures, for its sampler and for the direction table",
       claim_table(result));
  std::string reasons;
  for (const std::string& each : claim_reasons(result)) reasons += each + "\n";
  if (!reasons.empty()) text += "Why they do not hold there\n\n" + reasons + "\n";
  part("References", reference_table(result));
  return text;
}

}  // namespace sateen
