#include "study/cost_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "render/progress.h"
#include "study/bill_report.h"

namespace sateen {

namespace {
// Below a millionth there is nothing but float's roundings.
double shown_percent(double share) {
  return share < 1e-6 ? 0 : 100 * share;
}
std::string percent_text(double share) {
  return fmt::format("{:.3g} %", shown_percent(share));
}

std::string seconds_text(double seconds) {
  return seconds < 100 ? fmt::format("{:.2g} s", seconds) : clock_text(seconds);
}
}  // namespace

std::vector<std::string> halving_sentences(const CostResult& result) {
  std::vector<std::string> all;
  if (!result.fit.known || result.fit.slope >= 0 || result.points.empty()) return all;
  const int threads = thread_count(result.settings.threads);
  const double first = result.points.front().true_error.value, last = result.points.back().true_error.value;
  for (const double error : {0.32, 0.16, 0.08, 0.04, 0.02, 0.01, 0.005, 0.0025}) {
    if (error > first * 1.5 || error / 2 < last / 2.5) continue;
    const double seconds = (seconds_for_error(result, error / 2) - seconds_for_error(result, error)) / threads;
    all.push_back(fmt::format("{} -> {}: +{}{}", percent_text(error), percent_text(error / 2), seconds_text(seconds),
                              error / 2 < last ? " (beyond what was measured)" : ""));
  }
  return all;
}

Table point_table(const CostResult& result) {
  Table table{{"samples", "CPU-seconds", "true E (95 % interval)", "claimed E", "claimed / true"}, {}};
  for (const CostPoint& p : result.points)
    table.rows.push_back({std::to_string(p.samples), number_text(p.cpu_seconds), interval_text(p.true_error),
                          number_text(p.claimed_error), fmt::format("{:.2f}", p.claimed_error / p.true_error.value)});
  return table;
}

Table price_table(const PriceList& list) {
  const auto& prices = list.prices;
  const bool setup = std::any_of(prices.begin(), prices.end(), [](const Price& p) { return p.setup_seconds > 0; });
  Table table{{list.name, "CPU-seconds"}, {}};
  if (setup) table.head.push_back("to start");
  table.head.push_back("noise E");
  if (list.has_finest)
    table.head.insert(table.head.end(), {"bias as E (95 % interval)", "largest visible difference"});
  if (!list.biased) table.head.push_back("noise^2 x time, least = 1");
  table.head.push_back("");
  double least = 1e300;
  for (const Price& p : prices) least = std::min(least, p.noise * p.noise * p.cpu_seconds);
  for (size_t i = 0; i < prices.size(); ++i) {
    const Price& p = prices[i];
    std::vector<std::string> row{p.setting, number_text(p.cpu_seconds)};
    if (setup) row.push_back(fmt::format("{:.2g}", p.setup_seconds));
    row.push_back(number_text(p.noise));
    if (list.has_finest && i + 1 == prices.size())
      row.insert(row.end(), {"held against this one", "0"});
    else if (list.has_finest)
      row.insert(row.end(), {fmt::format("{} ({:.3g} to {:.3g})", percent_text(p.bias.error.value),
                                         shown_percent(p.bias.error.low), shown_percent(p.bias.error.high)),
                             fmt::format("{:.1f} of 255{}", p.bias.visible,
                                         list.biased && p.bias.error.value > 0 ? "" : ", noise")});
    if (!list.biased) row.push_back(fmt::format("{:.2f}", p.noise * p.noise * p.cpu_seconds / least));
    const char* verdict = !list.biased ? "best" : i + 1 < prices.size() ? "more buys nothing" : "less can be seen";
    row.push_back(int(i) == list.enough ? verdict : "");
    table.rows.push_back(row);
  }
  return table;
}

Table quality_table(const CostResult& result) {
  Table table{{"quality", "E at most", "flags", "noise E", "bias E", "CPU-seconds"}, {}};
  for (const Quality& q : result.qualities)
    table.rows.push_back(q.reached ? std::vector<std::string>{q.name, percent_text(q.target), q.flags,
                                                              percent_text(q.noise), percent_text(q.bias),
                                                              number_text(q.cpu_seconds)}
                                   : std::vector<std::string>{q.name, percent_text(q.target), "not reached"});
  return table;
}

std::vector<NamedPlot> cost_plots(const CostResult& result) {
  std::vector<NamedPlot> plots;
  if (!result.points.empty()) {
    NamedPlot plot{"error_time",
                   "True error against a reference, and what the program claims of itself. The frontier "
                   "joins, for every error, the cheapest combination of settings; bias counts there.",
                   {}};
    plot.sheet.title = "Error against time";
    plot.sheet.subtitle = fmt::format("{}, {} x {}; bars are 95 % intervals", result.settings.scene.look,
                                      result.settings.scene.width, result.settings.scene.height);
    Plot panel;
    panel.x_label = "CPU-seconds of the picture";
    panel.y_label = "E";
    panel.slopes = true;
    PlotSeries truth{"true E", {}, 0}, claimed{"claimed E", {}, 1, true, true}, frontier{"frontier", {}, 2};
    for (const CostPoint& p : result.points) {
      truth.points.push_back({p.cpu_seconds, p.true_error.value, p.true_error.low, p.true_error.high});
      claimed.points.push_back({p.cpu_seconds, p.claimed_error});
    }
    frontier.points = result.frontier;
    panel.series = {truth, claimed};
    if (!frontier.points.empty()) panel.series.push_back(frontier);
    for (const Quality& q : result.qualities)
      if (q.reached)
        panel.series.push_back(
            {q.name, {{q.cpu_seconds, std::hypot(q.noise, q.bias)}}, 3 + int(panel.series.size()) % 5, false});
    plot.sheet.panels.push_back(panel);
    plots.push_back(std::move(plot));
  }
  NamedPlot prices{"prices",
                   "What a cheaper setting gives away. Where the bias is far below the noise of the "
                   "picture that is asked for, more buys nothing.",
                   {}};
  prices.sheet.title = "The price of approximations";
  prices.sheet.subtitle =
      fmt::format("bias as E, noise taken out; noise at {} samples", result.settings.price_samples);
  prices.sheet.columns = 3;
  prices.sheet.panel_height = 240;
  for (const PriceList& list : result.lists) {
    if (!list.biased) continue;
    Plot panel;
    panel.title = list.name;
    panel.x_label = "E";
    panel.log_y = false;
    PlotSeries bias{"bias against the finest setting", {}, 0, false}, noise{"noise", {}, 7, false};
    for (const Price& p : list.prices) {
      const double row = double(panel.rows.size());
      panel.rows.push_back(p.setting);
      bias.points.push_back({p.bias.error.value, row, p.bias.error.low, p.bias.error.high});
      noise.points.push_back({p.noise, row});
    }
    panel.series = {noise, bias};
    prices.sheet.panels.push_back(panel);
  }
  if (!prices.sheet.panels.empty()) plots.push_back(std::move(prices));
  return plots;
}

std::string cost_text(const CostResult& result) {
  const CostSettings& s = result.settings;
  std::string text;
  if (result.interrupted) text += "INTERRUPTED: only what was finished is here.\n\n";
  for (const std::string& warning : result.warnings) text += "warning: " + warning + "\n";
  text += fmt::format(
      "{} on {} under {}, {} x {}, level {}; measured on {} x {} pixels, times scaled to the whole picture.\n"
      "E is the relative error of the picture: sqrt of the mean of (x - r)^2 / (r^2 + 0.01). {:.0f} CPU-seconds.\n\n",
      s.scene.look, s.scene.mesh, s.scene.environment, s.scene.width, s.scene.height, result.level, result.width,
      result.height, result.cpu_seconds);
  if (!result.points.empty()) text += "Error against time\n\n" + table_text(point_table(result)) + "\n";
  if (result.fit.known)
    text += fmt::format("E falls as time^{:.2f}. With {} thread{}:\n", result.fit.slope, thread_count(s.threads),
                        thread_count(s.threads) == 1 ? "" : "s");
  for (const std::string& sentence : halving_sentences(result)) text += "  " + sentence + "\n";
  if (result.reference_samples > 0 && !result.points.empty())
    text += fmt::format("The reference has {} samples; its own E is {}.\n", result.reference_samples,
                        percent_text(std::sqrt(result.reference_error.relative)));
  for (const PriceList& list : result.lists) {
    text += fmt::format("\nPrice of {}{}\n\n{}", list.name, list.note.empty() ? "" : " (" + list.note + ")",
                        table_text(price_table(list)));
  }
  if (!result.bill.items.empty()) text += "\nThe bill of effects\n\n" + table_text(bill_table(result.bill));
  if (!result.qualities.empty())
    text += "\nRecommended: noise and bias together\n\n" + table_text(quality_table(result));
  return text;
}

}  // namespace sateen
