#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace sateen {

/// A measured point with the ends of its interval; low >= high: no interval is drawn.
struct PlotPoint {
  double x = 0, y = 0;
  double low = 0, high = 0;  ///< of y, or of x where the plot has rows
};

struct PlotSeries {
  std::string name;
  std::vector<PlotPoint> points;
  int color = 0;     ///< place in the palette; series of one name keep one colour over all panels
  bool line = true;  ///< joins the points
  bool dashed = false;
};

/// One panel. Logarithmic axes want positive values; points without are left out.
struct Plot {
  std::string title = "", x_label = "", y_label = "";
  bool log_x = true, log_y = true;
  std::vector<PlotSeries> series{};
  std::vector<std::string> rows{};  ///< where given, y is the place of a row, 0 at the top, and points lie on rows
  std::vector<double> x_ticks{};    ///< where given, the values that are labelled along x
  double guide_x = 0;               ///< where positive: a line across at this x
  bool slopes = false;              ///< the legend tells each series' fitted slope (panels of their own legend only)
};

/// Panels in rows under one title, with one legend. One panel: the legend stands beside it.
struct PlotSheet {
  std::string title = "", subtitle = "";
  std::vector<Plot> panels{};
  int columns = 1;
  int width = 900;         ///< pixels, or points of an SVG
  int panel_height = 430;  ///< labels of the axes included
};

/// The same drawing as SVG text (letters as outlines: no font is needed to show it) and as the bytes of a PNG at
/// `scale` pixels a point.
std::string plot_svg(const PlotSheet& sheet);
std::string plot_png(const PlotSheet& sheet, double scale = 2);

/// NAME.svg and NAME.png, whole or not at all.
void write_plot(const std::filesystem::path& without_extension, const PlotSheet& sheet);

/// y = factor * x^slope by least squares in logarithms; points that are not positive do not count. `known` is false
/// for fewer than two different x.
struct PowerFit {
  bool known = false;
  double factor = 0, slope = 0, slope_error = 0;  ///< standard error of the slope, 0 for two points
};
PowerFit fit_power(const std::vector<PlotPoint>& points);

}  // namespace sateen
