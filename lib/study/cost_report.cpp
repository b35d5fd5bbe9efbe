#include "study/cost_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "render/loss.h"
#include "render/prediction.h"
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
  const double first = result.points.front().noise.value, last = result.points.back().noise.value;
  for (const double error : {0.32, 0.16, 0.08, 0.04, 0.02, 0.01, 0.005, 0.0025}) {
    if (error > first * 1.5 || error / 2 < last / 2.5) continue;
    const double seconds = (seconds_for_noise(result, error / 2) - seconds_for_noise(result, error)) / threads;
    all.push_back(fmt::format("{} -> {}: +{}{}", percent_text(error), percent_text(error / 2), seconds_text(seconds),
                              error / 2 < last ? " (beyond what was measured)" : ""));
  }
  return all;
}

Table start_table(const CostResult& result) {
  const StartPrice& s = result.start;
  Table table{{"part", "CPU-seconds (95 % interval)"}, {}};
  const auto row = [&](const char* name, const Interval& seconds) {
    if (seconds.value > 0) table.rows.push_back({name, interval_text(seconds, 3)});
  };
  row("start of the program", s.program);
  row("mesh, cloth and map made ready", s.assembly);
  row("pilots that choose effects and sampling", s.pilots);
  row("table for the albedo layer", s.albedo_table);
  row("PNG and EXR written", s.writing);
  table.rows.push_back({"together", number_text(s.seconds(), 3)});
  return table;
}

Table point_table(const CostResult& result) {
  Table table{{"samples", "CPU-seconds (95 % interval)", "E", "of it noise (95 % interval)", "noise as claimed",
               "claimed / true"},
              {}};
  for (const CostPoint& p : result.points)
    table.rows.push_back({std::to_string(p.samples), interval_text(p.cpu_seconds, 3), percent_text(p.error),
                          interval_text(p.noise, 3), number_text(p.claimed_error),
                          fmt::format("{:.2f}", p.claimed_error / p.noise.value)});
  return table;
}

Table price_table(const PriceList& list) {
  const auto& prices = list.prices;
  const bool start = std::any_of(prices.begin(), prices.end(), [&](const Price& p) {
    return std::abs(p.start_seconds - prices[0].start_seconds) > 0.01;
  });
  Table table{{list.name, "CPU-seconds (95 % interval)"}, {}};
  if (start) table.head.push_back("of it start and files");
  table.head.insert(table.head.end(), {"a sample's time, asked = 1", "noise E"});
  if (list.has_finest)
    table.head.insert(table.head.end(), {"bias as E (95 % interval)", "largest visible difference"});
  if (!list.biased) table.head.push_back("noise^2 x time, asked = 1");
  table.head.push_back("");
  for (size_t i = 0; i < prices.size(); ++i) {
    const Price& p = prices[i];
    std::vector<std::string> row{p.setting + (p.asked ? " (asked)" : ""), interval_text(p.cpu_seconds, 3)};
    if (start) row.push_back(fmt::format("{:.2g}", p.start_seconds));
    row.push_back(p.asked ? "1" : interval_text(p.time_factor, 3));
    row.push_back(percent_text(p.noise));
    if (list.has_finest && i + 1 == prices.size())
      row.insert(row.end(), {"held against this one", "0"});
    else if (list.has_finest)
      row.insert(row.end(), {fmt::format("{} ({:.3g} to {:.3g})", percent_text(p.bias.error.value),
                                         shown_percent(p.bias.error.low), shown_percent(p.bias.error.high)),
                             fmt::format("{:.1f} of 255{}", p.bias.visible,
                                         list.biased && p.bias.error.value > 0 ? "" : ", noise")});
    if (!list.biased)
      row.push_back(fmt::format("{:.2f}", p.noise_factor.value * p.noise_factor.value * p.time_factor.value));
    const char* verdict = !list.biased            ? p.asked ? "none is better beyond chance" : "best"
                          : i + 1 < prices.size() ? "more buys nothing"
                                                  : "less can be seen";
    row.push_back(int(i) == list.enough ? verdict : "");
    table.rows.push_back(row);
  }
  return table;
}

Table quality_table(const CostResult& result) {
  Table table{{"quality", "E at most", "add to your flags", "E, forecast", "E, measured (95 % interval)",
               "CPU-seconds, forecast", "CPU-seconds, measured"},
              {}};
  for (const Quality& q : result.qualities) {
    if (!q.reached) {
      table.rows.push_back({q.name, percent_text(q.target), "not reached by any setting"});
      continue;
    }
    const std::string dear = "not rendered: too dear";
    const Interval& e = q.measured_error;
    std::string measured = percent_text(e);
    // A forecast that was a little too bright.
    if (e.low > q.target)
      measured += fmt::format(": above, {:.0f} % more samples are wanted",
                              100 * (std::pow(e.value / q.target, -1 / usual_slope) - 1));
    table.rows.push_back({q.name, percent_text(q.target), q.flags, percent_text(q.error()),
                          q.measured ? measured : dear, number_text(q.cpu_seconds, 3),
                          q.measured ? interval_text(q.measured_seconds, 3) : dear});
  }
  return table;
}

std::vector<NamedPlot> cost_plots(const CostResult& result) {
  std::vector<NamedPlot> plots;
  if (!result.points.empty()) {
    NamedPlot plot{
        "error_time",
        "E, noise and bias together, against the CPU-seconds of a whole render. The least joins, for every "
        "E, the cheapest settings; squares are recommended, with what they were measured as.",
        {}};
    plot.sheet.title = "Error against time";
    plot.sheet.subtitle =
        fmt::format("{}, {} x {}; whole renders from the start of the program to the files",
                    result.settings.scene.look, result.settings.scene.width, result.settings.scene.height);
    Plot panel;
    panel.x_label = "CPU-seconds of the picture";
    panel.y_label = "E";
    panel.slopes = true;
    PlotSeries asked{"settings as asked", {}, 0}, least{"the least", {}, 2}, forecast{"recommended", {}, 3, false},
        measured{"recommended, measured", {}, 5, false};
    for (const CostPoint& p : result.points) asked.points.push_back({p.cpu_seconds.value, p.error});
    for (const Quality& q : result.frontier) least.points.push_back({q.cpu_seconds, q.error()});
    for (const Quality& q : result.qualities) {
      if (q.reached) forecast.points.push_back({q.cpu_seconds, q.error()});
      if (q.measured)
        measured.points.push_back(
            {q.measured_seconds.value, q.measured_error.value, q.measured_error.low, q.measured_error.high});
    }
    for (const PlotSeries* each : {&asked, &least, &forecast, &measured})
      if (!each->points.empty()) panel.series.push_back(*each);
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
      panel.rows.push_back(p.setting + (p.asked ? " (asked)" : ""));
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
      "{} on {} under {}, {} x {}, level {}; measured on {} x {} pixels, samples' times scaled to the whole "
      "picture.\n"
      "CPU-seconds are those of a whole render, from the start of the program to the files.\n"
      "E is noise and bias together: sqrt of the mean of (x - r)^2 / (r^2 + floor^2), floor {:.3g} (0.1 as the "
      "picture "
      "is exposed). {:.0f} CPU-seconds.\n\n",
      s.scene.look, s.scene.mesh, s.scene.environment, s.scene.width, s.scene.height, result.level, result.width,
      result.height, result.error_floor, result.cpu_seconds);
  if (!result.qualities.empty()) text += "Recommended\n\n" + table_text(quality_table(result)) + "\n";
  if (!result.points.empty()) {
    text += "Error against time, with the settings as asked\n\n" + table_text(point_table(result)) + "\n";
    text += "Before the first sample and after the last\n\n" + table_text(start_table(result)) + "\n";
  }
  if (result.fit.known)
    text += fmt::format("Noise falls as the samples' time^{:.2f}. With {} thread{}:\n", result.fit.slope,
                        thread_count(s.threads), thread_count(s.threads) == 1 ? "" : "s");
  for (const std::string& sentence : halving_sentences(result)) text += "  " + sentence + "\n";
  if (result.reference_samples > 0 && !result.points.empty())
    text += fmt::format("The reference has {} samples; its own E is {}.\n", result.reference_samples,
                        percent_text(std::sqrt(result.reference_error.relative)));
  for (const PriceList& list : result.lists) {
    text += fmt::format("\nPrice of {} at {} samples{}\n\n{}", list.name, s.price_samples,
                        list.note.empty() ? "" : " (" + list.note + ")", table_text(price_table(list)));
  }
  if (!result.bill.items.empty()) text += "\nThe bill of effects\n\n" + table_text(bill_table(result.bill));
  return text;
}

}  // namespace sateen
