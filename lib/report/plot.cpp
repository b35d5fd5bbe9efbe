#include "report/plot.h"

#include <cairo/cairo-svg.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/error.h"
#include "base/files.h"
#include "report/axis.h"
#include "report/canvas.h"

namespace sateen {

namespace {

constexpr double margin = 18, letters = 12.5, small_letters = 11.5, title_letters = 17;

struct Box {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

struct LegendEntry {
  std::string text;
  int color = 0;
  bool line = true, dashed = false;
};

// Every name once, in the order of its first use.
std::vector<LegendEntry> legend_of(const PlotSheet& sheet) {
  std::vector<LegendEntry> all;
  for (const Plot& plot : sheet.panels)
    for (const PlotSeries& series : plot.series) {
      if (series.name.empty()) continue;
      std::string text = series.name;
      if (const PowerFit fit = fit_power(series.points); plot.slopes && sheet.panels.size() == 1 && fit.known)
        text += fmt::format("   slope {:.2f}", fit.slope);
      if (std::none_of(all.begin(), all.end(), [&](const LegendEntry& e) { return e.text == text; }))
        all.push_back({text, series.color, series.line, series.dashed});
    }
  return all;
}

constexpr double legend_line = 20, legend_sign = 30, legend_gap = 22;

// Entries side by side, broken into lines of `width`; returns the height. Nothing is drawn without `draw`.
double place_legend(cairo_t* to, const std::vector<LegendEntry>& entries, double x0, double y0, double width,
                    bool draw) {
  double x = x0, y = y0;
  for (const LegendEntry& entry : entries) {
    const double wide = legend_sign + 6 + text_width(to, entry.text, letters);
    if (x > x0 && x + wide > x0 + width) x = x0, y += legend_line;
    if (draw) {
      if (entry.line) {
        const double dashes[] = {5, 3};
        cairo_set_dash(to, dashes, entry.dashed ? 2 : 0, 0);
        draw_segment(to, x, y - 4, x + legend_sign, y - 4, 2, series_ink(entry.color));
        cairo_set_dash(to, nullptr, 0, 0);
      }
      draw_marker(to, x + legend_sign / 2, y - 4, entry.color, 4.2);
      draw_text(to, x + legend_sign + 6, y, entry.text, letters, Anchor::left, text_ink);
    }
    x += wide + legend_gap;
  }
  return y - y0 + legend_line;
}

struct Axes {
  Axis x, y;
};

Axes axes_of(const Plot& plot) {
  std::vector<double> xs, ys;
  for (const PlotSeries& series : plot.series)
    for (const PlotPoint& p : series.points) {
      xs.push_back(p.x);
      ys.push_back(p.y);
      if (!(p.low < p.high)) continue;
      // The ends of an interval that is hardly one shall not press all points into a line: they run out of the frame.
      const bool rows = !plot.rows.empty(), logarithmic = rows ? plot.log_x : plot.log_y;
      const double middle = rows ? p.x : p.y;
      for (const double end : {p.low, p.high})
        (rows ? xs : ys).push_back(logarithmic ? std::clamp(end, middle / 4, middle * 4) : end);
    }
  if (plot.guide_x > 0) xs.push_back(plot.guide_x);
  Axes axes{axis_for(xs, plot.log_x), axis_for(ys, plot.log_y)};
  if (!plot.rows.empty()) axes.y = {-0.5, double(plot.rows.size()) - 0.5, false};
  return axes;
}

void draw_grid(cairo_t* to, const Plot& plot, const Axes& axes, const Box& b) {
  double last = -1e9;
  std::vector<Tick> along;
  for (const double value : plot.x_ticks) along.push_back({value, fmt::format("{:.4g}", value)});
  if (along.empty()) along = axis_ticks(axes.x, std::max(3, int((b.x1 - b.x0) / 60)));
  for (const Tick& tick : along) {
    const double x = b.x0 + axes.x.at(tick.value) * (b.x1 - b.x0);
    if (tick.label.empty()) {
      draw_segment(to, x, b.y1, x, b.y1 + 3, 1, frame_ink);
      continue;
    }
    draw_segment(to, x, b.y0, x, b.y1, 1, grid_ink);
    draw_segment(to, x, b.y1, x, b.y1 + 5, 1, frame_ink);
    const double half = text_width(to, tick.label, small_letters) / 2;
    if (x - half < last + 4) continue;
    draw_text(to, x, b.y1 + 19, tick.label, small_letters, Anchor::middle, text_ink);
    last = x + half;
  }
  if (plot.rows.empty()) {
    for (const Tick& tick : axis_ticks(axes.y, std::max(2, int((b.y1 - b.y0) / 45)))) {
      const double y = b.y1 - axes.y.at(tick.value) * (b.y1 - b.y0);
      draw_segment(to, b.x0 - (tick.label.empty() ? 3 : 5), y, b.x0, y, 1, frame_ink);
      if (tick.label.empty()) continue;
      draw_segment(to, b.x0, y, b.x1, y, 1, grid_ink);
      draw_text(to, b.x0 - 8, y + 4, tick.label, small_letters, Anchor::right, text_ink);
    }
  } else {
    for (size_t i = 0; i < plot.rows.size(); ++i) {
      const double y = b.y0 + axes.y.at(double(i)) * (b.y1 - b.y0);
      draw_segment(to, b.x0, y, b.x1, y, 1, grid_ink);
      draw_text(to, b.x0 - 8, y + 4, plot.rows[i], small_letters, Anchor::right, text_ink);
    }
  }
  if (plot.guide_x > 0) {
    const double x = b.x0 + axes.x.at(plot.guide_x) * (b.x1 - b.x0);
    draw_segment(to, x, b.y0, x, b.y1, 1.5, frame_ink);
  }
  set_ink(to, frame_ink);
  cairo_set_line_width(to, 1);
  cairo_rectangle(to, b.x0, b.y0, b.x1 - b.x0, b.y1 - b.y0);
  cairo_stroke(to);
}

bool is_shown(const Axis& axis, double value) {
  return std::isfinite(value) && (!axis.logarithmic || value > 0);
}

void draw_series(cairo_t* to, const Plot& plot, const PlotSeries& series, const Axes& axes, const Box& b) {
  const bool rows = !plot.rows.empty();
  const auto x_of = [&](double v) { return b.x0 + axes.x.at(v) * (b.x1 - b.x0); };
  const auto y_of = [&](double v) {
    return rows ? b.y0 + axes.y.at(v) * (b.y1 - b.y0) : b.y1 - axes.y.at(v) * (b.y1 - b.y0);
  };
  std::vector<PlotPoint> shown;
  for (const PlotPoint& p : series.points)
    if (is_shown(axes.x, p.x) && is_shown(axes.y, p.y)) shown.push_back(p);
  const Ink ink = series_ink(series.color);
  if (series.line && shown.size() > 1) {
    const double dashes[] = {5, 3};
    cairo_set_dash(to, dashes, series.dashed ? 2 : 0, 0);
    set_ink(to, ink);
    cairo_set_line_width(to, 2);
    cairo_set_line_join(to, CAIRO_LINE_JOIN_ROUND);
    for (const PlotPoint& p : shown) cairo_line_to(to, x_of(p.x), y_of(p.y));
    cairo_stroke(to);
    cairo_set_dash(to, nullptr, 0, 0);
  }
  for (const PlotPoint& p : shown) {
    const Axis& along = rows ? axes.x : axes.y;
    if (p.low < p.high && is_shown(along, p.high)) {
      const double low = is_shown(along, p.low) ? p.low : along.low;
      if (rows) {
        draw_segment(to, x_of(low), y_of(p.y), x_of(p.high), y_of(p.y), 1.5, ink);
      } else {
        const double x = x_of(p.x);
        draw_segment(to, x, y_of(low), x, y_of(p.high), 1.5, ink);
        for (const double end : {low, p.high}) draw_segment(to, x - 3.5, y_of(end), x + 3.5, y_of(end), 1.5, ink);
      }
    }
    draw_marker(to, x_of(p.x), y_of(p.y), series.color, 4.2);
  }
}

void draw_panel(cairo_t* to, const Plot& plot, const Box& outer) {
  double left = 58;
  for (const std::string& row : plot.rows) left = std::max(left, text_width(to, row, small_letters) + 14);
  if (!plot.y_label.empty()) left += 18;
  const Box b{outer.x0 + left, outer.y0 + (plot.title.empty() ? 8 : 28), outer.x1 - 10,
              outer.y1 - (plot.x_label.empty() ? 28 : 48)};
  if (!plot.title.empty()) draw_text(to, b.x0, outer.y0 + 17, plot.title, 13.5, Anchor::left, text_ink, true);
  const Axes axes = axes_of(plot);
  draw_grid(to, plot, axes, b);
  cairo_save(to);
  cairo_rectangle(to, b.x0 - 6, b.y0 - 6, b.x1 - b.x0 + 12, b.y1 - b.y0 + 12);
  cairo_clip(to);
  for (const PlotSeries& series : plot.series) draw_series(to, plot, series, axes, b);
  cairo_restore(to);
  draw_text(to, (b.x0 + b.x1) / 2, b.y1 + 40, plot.x_label, letters, Anchor::middle, quiet_ink);
  if (!plot.y_label.empty())
    draw_upright_text(to, outer.x0 + 12, (b.y0 + b.y1) / 2, plot.y_label, letters, quiet_ink);
}

// Draws all and returns the height that it takes; without `draw` it only measures.
double draw_sheet(cairo_t* to, const PlotSheet& sheet, bool draw) {
  const double width = sheet.width;
  const int columns = std::max(sheet.columns, 1), lines = (int(sheet.panels.size()) + columns - 1) / columns;
  double y = margin;
  if (!sheet.title.empty()) {
    if (draw) draw_text(to, margin, y + 15, sheet.title, title_letters, Anchor::left, text_ink, true);
    y += 27;
  }
  if (!sheet.subtitle.empty()) {
    if (draw) draw_text(to, margin, y + 12, sheet.subtitle, letters, Anchor::left, quiet_ink);
    y += 24;
  }
  y += place_legend(to, legend_of(sheet), margin, y + 14, width - 2 * margin, draw) + 6;
  const double across = (width - 2 * margin) / columns;
  if (draw)
    for (size_t i = 0; i < sheet.panels.size(); ++i) {
      const double x = margin + across * double(int(i) % columns),
                   top = y + sheet.panel_height * double(int(i) / columns);
      draw_panel(to, sheet.panels[i], {x, top, x + across, top + sheet.panel_height});
    }
  return y + double(lines) * sheet.panel_height + margin / 2;
}

using Surface = std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)>;
using Context = std::unique_ptr<cairo_t, void (*)(cairo_t*)>;

double sheet_height(const PlotSheet& sheet) {
  const Surface none(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1), cairo_surface_destroy);
  const Context to(cairo_create(none.get()), cairo_destroy);
  return std::ceil(draw_sheet(to.get(), sheet, false));
}

cairo_status_t append(void* text, const unsigned char* bytes, unsigned count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw OperationError(fmt::format("a plot cannot be drawn: {}", cairo_status_to_string(status)));
}

void draw_on(cairo_surface_t* surface, const PlotSheet& sheet) {
  const Context to(cairo_create(surface), cairo_destroy);
  cairo_set_source_rgb(to.get(), 1, 1, 1);
  cairo_paint(to.get());
  draw_sheet(to.get(), sheet, true);
  check(cairo_status(to.get()));
}

}  // namespace

std::string plot_svg(const PlotSheet& sheet) {
  std::string text;
  const Surface surface(cairo_svg_surface_create_for_stream(append, &text, sheet.width, sheet_height(sheet)),
                        cairo_surface_destroy);
  draw_on(surface.get(), sheet);
  cairo_surface_finish(surface.get());
  check(cairo_surface_status(surface.get()));
  // Cairo counts the surfaces of the process in an id: the same plot shall have the same bytes.
  if (const size_t at = text.find(" id=\"surface"); at != std::string::npos)
    text.erase(at, text.find('"', at + 5) + 1 - at);
  return text;
}

std::string plot_png(const PlotSheet& sheet, double scale) {
  const Surface surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, int(sheet.width * scale), int(sheet_height(sheet) * scale)),
      cairo_surface_destroy);
  cairo_surface_set_device_scale(surface.get(), scale, scale);
  draw_on(surface.get(), sheet);
  std::string bytes;
  check(cairo_surface_write_to_png_stream(surface.get(), append, &bytes));
  return bytes;
}

void write_plot(const std::filesystem::path& without_extension, const PlotSheet& sheet) {
  write_text_whole(without_extension.string() + ".svg", plot_svg(sheet));
  write_text_whole(without_extension.string() + ".png", plot_png(sheet));
}

}  // namespace sateen
