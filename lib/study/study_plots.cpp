#include <fmt/format.h>

#include <cmath>

#include "study/study_report.h"

namespace sateen {

namespace {

NamedPlot ladder_plot(const StudyResult& result, const std::string& look, int bounces) {
  NamedPlot plot;
  plot.name = fmt::format("samples_{}_{}", look, bounces > 0 ? "bounces" : "direct");
  plot.sheet.title = "MSE against samples: " + look;
  plot.sheet.subtitle =
      fmt::format("{}; relative MSE, bars are 95 % intervals over {} seeds",
                  bounces > 0 ? fmt::format("with {} bounces", bounces) : "direct light", result.settings.seeds);
  plot.sheet.columns = 3;
  plot.sheet.panel_height = 290;
  plot.caption =
      "Mean squared error against samples a pixel, by light. Lower is better; a steeper line gains more from "
      "every doubling.";
  for (int i = 0; i < int(result.scenes.size()); ++i) {
    const StudyScene& scene = result.scenes[size_t(i)];
    if (scene.look != look || scene.bounces != bounces || !scene.ladder || !scene.finished) continue;
    Plot panel;
    panel.title = light_label(scene.light);
    for (const Strategy strategy : ladder_strategies()) {
      PlotSeries series;
      series.name = strategy_name(strategy);
      series.color = int(strategy);
      for (const CurvePoint& p : study_curve(result, i, strategy, Measure::relative)) {
        series.points.push_back({double(p.samples), p.mse.value, p.mse.low, p.mse.high});
        if (panel.x_ticks.empty() || p.samples > panel.x_ticks.back()) panel.x_ticks.push_back(p.samples);
      }
      panel.series.push_back(series);
    }
    plot.sheet.panels.push_back(panel);
  }
  const int count = int(plot.sheet.panels.size());
  for (int i = 0; i < count; ++i) {
    if (i % plot.sheet.columns == 0) plot.sheet.panels[size_t(i)].y_label = "relative MSE";
    if (i + plot.sheet.columns >= count) plot.sheet.panels[size_t(i)].x_label = "samples a pixel";
  }
  return plot;
}

NamedPlot equal_time_plot(const StudyResult& result) {
  NamedPlot plot;
  plot.name = "equal_time";
  const std::string ours = strategy_name(result.ours);
  plot.sheet.title = "All strategies at equal CPU time";
  plot.sheet.subtitle = fmt::format("relative MSE over that of {}; left is better, 1 is as good", ours);
  plot.caption = fmt::format(
      "Each row is a scene, each sign a strategy with as many samples as fit into the CPU time "
      "of mis-compensated at {} samples. Bars are 95 % intervals over the seeds.",
      result.settings.samples);
  Plot panel;
  panel.x_label = "MSE over that of " + ours;
  panel.log_y = false;
  panel.guide_x = 1;
  for (const std::string& name : strategy_names()) {
    const Strategy strategy = strategy_from_name(name);
    PlotSeries series;
    series.name = name;
    series.color = int(strategy);
    series.line = false;
    int row = 0;
    for (int i = 0; i < int(result.scenes.size()); ++i) {
      if (!result.scenes[size_t(i)].all_strategies || !result.scenes[size_t(i)].finished) continue;
      if (panel.rows.size() == size_t(row)) panel.rows.push_back(result.scenes[size_t(i)].label());
      const Ratio ratio = equal_time_ratio(result, i, strategy, result.ours, Measure::relative);
      if (ratio.known)
        series.points.push_back({ratio.interval.value, double(row), ratio.interval.low, ratio.interval.high});
      ++row;
    }
    panel.series.push_back(series);
  }
  plot.sheet.panel_height = int(60 + 25 * panel.rows.size());
  plot.sheet.panels.push_back(panel);
  return plot;
}

}  // namespace

std::vector<NamedPlot> study_plots(const StudyResult& result) {
  std::vector<NamedPlot> plots;
  for (const std::string& look : result.settings.looks)
    for (const int bounces : {0, study_bounces})
      if (NamedPlot plot = ladder_plot(result, look, bounces); !plot.sheet.panels.empty())
        plots.push_back(std::move(plot));
  if (NamedPlot plot = equal_time_plot(result); !plot.sheet.panels[0].rows.empty()) plots.push_back(std::move(plot));
  return plots;
}

}  // namespace sateen
