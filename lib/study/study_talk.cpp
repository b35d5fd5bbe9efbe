#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/study_report.h"

namespace sateen {

namespace {
constexpr double quarter = 0.25;

const char* yes_or_no(bool holds) {
  return holds ? "yes" : "no";
}

// Both ends of the interval on one side, else it is open.
const char* holds(const Interval& ratio, double limit) {
  return ratio.high <= limit ? "yes" : ratio.low > limit ? "no" : "within chance";
}

std::string lobes_text(const ThreadRow& row) {
  return fmt::format("{}, {} ({:.3g} and {:.3g} degrees)", row.look, row.warp ? "warp" : "weft", row.gamma_s_deg,
                     row.gamma_v_deg);
}
}  // namespace

Table claim_table(const StudyResult& result) {
  Table table{{"scene", "sampler", "samples", "squared error over uniform's", "at most a quarter?",
               "over uniform's with 4 times the samples", "less?"},
              {}};
  for (const Claim& claim : study_claims(result))
    table.rows.push_back({result.scenes[size_t(claim.scene)].label(), strategy_name(claim.sampler),
                          std::to_string(claim.samples), interval_text(claim.equal), yes_or_no(claim.quarter),
                          interval_text(claim.against_four), yes_or_no(claim.beats_four)});
  return table;
}

Table thread_table(const StudyResult& result) {
  Table table{{"thread (highlight and glow)", "azimuth of the glow", "lobe chosen"}, {}};
  for (const double view : thread_views_deg()) table.head.push_back(fmt::format("{:.0f} degrees", view));
  table.head.push_back("at most a quarter?");
  for (const ThreadRow& row : result.thread_rows) {
    std::vector<std::string> cells{lobes_text(row), row.azimuth == VolumeAzimuth::flat ? "flat" : "by cosine",
                                   row.choice == LobeChoice::half ? "by halves" : "by weight"};
    std::string where;
    for (size_t i = 0; i < row.ratios.size(); ++i) {
      cells.push_back(number_text(row.ratios[i]));
      if (row.ratios[i] <= quarter)
        where += fmt::format("{}{:.0f}", where.empty() ? "at " : ", ", thread_views_deg()[i]);
    }
    const auto held = std::count_if(row.ratios.begin(), row.ratios.end(), [](double r) { return r <= quarter; });
    cells.push_back(held == std::ssize(row.ratios) ? "yes" : held == 0 ? "no" : where + " degrees");
    table.rows.push_back(cells);
  }
  return table;
}

Table figure_table(const StudyResult& result) {
  Table table{
      {"picture", "bare threads", "a quarter?", "beats 4 times?", "whole cloth", "a quarter?", "beats 4 times?"}, {}};
  for (const TalkFigure& f : result.talk_figures)
    table.rows.push_back({fmt::format("{}, {}, {}", f.look, light_label(f.light),
                                      f.bounces == 0 ? "direct light" : "light from fold to fold"),
                          interval_text(f.threads.equal, 3), holds(f.threads.equal, quarter),
                          holds(f.threads.against_four, 1), interval_text(f.cloth.equal, 3),
                          holds(f.cloth.equal, quarter), holds(f.cloth.against_four, 1)});
  return table;
}

std::vector<std::string> talk_findings(const StudyResult& result) {
  std::vector<std::string> all;
  if (!result.thread_rows.empty()) {
    std::string held, partly, failed;
    for (const ThreadRow& row : result.thread_rows) {
      if (row.azimuth != VolumeAzimuth::flat || row.choice != LobeChoice::half) continue;
      const auto count = std::count_if(row.ratios.begin(), row.ratios.end(), [](double r) { return r <= quarter; });
      std::string& list = count == std::ssize(row.ratios) ? held : row.ratios[0] <= 1 ? partly : failed;
      list += (list.empty() ? "" : "; ") + lobes_text(row);
    }
    std::string text =
        "One thread, its glow spread evenly around it: the talk's sampler leaves at most a quarter of uniform's "
        "noise power ";
    text += held.empty() ? "at every view for none of these threads." : "at every view for " + held + ".";
    if (!partly.empty())
      text += " Always less than uniform's, but a quarter from some angle on only: " + partly + ".";
    if (!failed.empty()) text += " Worse than uniform where the thread is seen squarely: " + failed + ".";
    text += " Narrow highlights are what it is made for; a wide one is nearly uniform by itself.";
    all.push_back(text);
  }
  if (!result.talk_figures.empty()) {
    const double count = double(result.talk_figures.size());
    int quarter_threads = 0, quarter_cloth = 0, less_threads = 0, less_cloth = 0;
    double log_threads = 0, log_cloth = 0;
    for (const TalkFigure& f : result.talk_figures) {
      quarter_threads += f.threads.equal.value <= quarter, quarter_cloth += f.cloth.equal.value <= quarter;
      less_threads += f.threads.against_four.value < 1, less_cloth += f.cloth.against_four.value < 1;
      log_threads += std::log(f.threads.equal.value) / count, log_cloth += std::log(f.cloth.equal.value) / count;
    }
    all.push_back(fmt::format(
        "Its figures, on a skirt of bare threads: {:.2f} of uniform's squared error at equal samples in the mean of "
        "{} "
        "pictures, at most a quarter in {} of them, and less than uniform with four times the samples in {}. The "
        "same skirt "
        "of whole cloth: {:.2f} in the mean, a quarter in {}, less than uniform with four times the samples in {}. "
        "So the claims are those of the thread; cloth needs a sampler that knows what the folds of its threads hide.",
        std::exp(log_threads), result.talk_figures.size(), quarter_threads, less_threads, std::exp(log_cloth),
        quarter_cloth, less_cloth));
  }
  return all;
}

}  // namespace sateen
