#include "render/lobe_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace sateen {

namespace {
const Color ink(0.13f, 0.13f, 0.15f), faint(0.80f, 0.80f, 0.82f), soft(0.45f, 0.45f, 0.48f);
// Four colours that people with any kind of colour vision tell apart, and that differ in lightness too.
const Color curve_colors[4] = {
    {0.0f, 0.30f, 0.58f}, {0.85f, 0.42f, 0.0f}, {0.10f, 0.62f, 0.50f}, {0.72f, 0.28f, 0.60f}};
constexpr float curve_views[4] = {0, 30, 60, 80};
constexpr int decades = 4;

std::unique_ptr<FabricView> viewed(const Fabric& fabric, const Vec3& wo) {
  auto view = std::make_unique<FabricView>();
  prepare_view(fabric, wo, FabricSampler::uniform, *view);
  return view;
}

// Brightness ramp for logarithms, dark to light: violet, red, orange, pale yellow.
Color ramp(float t) {
  static const Color stops[] = {{0.03f, 0.03f, 0.08f}, {0.22f, 0.08f, 0.40f}, {0.58f, 0.15f, 0.42f},
                                {0.88f, 0.35f, 0.25f}, {0.98f, 0.68f, 0.22f}, {1.0f, 0.97f, 0.78f}};
  const float at = std::clamp(t, 0.0f, 1.0f) * 5;
  const int i = std::min(int(at), 4);
  return stops[i] + (stops[i + 1] - stops[i]) * (at - float(i));
}

void add_text(Figure& f, float x, float y, std::string text, const Color& color, int dots = 1,
              FigureText::Anchor anchor = FigureText::Anchor::left) {
  f.shapes.push_back(FigureText{Vec2(x, y), std::move(text), color, dots, anchor});
}

// 1, 2 or 5 times a power of ten, not above `value`.
float round_down(float value) {
  const float power = std::pow(10.0f, std::floor(std::log10(value)));
  const float lead = value / power;
  return power * (lead >= 5 ? 5.0f : lead >= 2 ? 2.0f : 1.0f);
}

void add_polar(Figure& f, const Fabric& fabric, bool weft, const Vec2& center, float radius, float scale) {
  const auto place = [&](float angle_deg, float r) {
    return Vec2(center.x + std::sin(radians(angle_deg)) * r, center.y - std::cos(radians(angle_deg)) * r);
  };
  const auto radius_of = [&](float value) { return radius * std::sqrt(std::max(value, 0.0f) / scale); };
  float ring = round_down(scale);
  for (int i = 0; i < 3; ++i, ring = round_down(ring / 3)) {
    FigureLine arc{{}, faint, 1, false};
    for (int a = -90; a <= 90; a += 3) arc.points.push_back(place(float(a), radius_of(ring)));
    f.shapes.push_back(arc);
    add_text(f, center.x + radius_of(ring), center.y + 6, fmt::format("{:.3g}", ring), soft, 1,
             FigureText::Anchor::middle);
  }
  for (int a = -90; a <= 90; a += 30) {
    f.shapes.push_back(FigureLine{{center, place(float(a), radius)}, faint, 1, false});
    const Vec2 at = place(float(a), radius + 14);
    if (std::abs(a) < 90) add_text(f, at.x, at.y - 4, std::to_string(a), soft, 1, FigureText::Anchor::middle);
  }
  for (int i = 0; i < 4; ++i) {
    const auto view = viewed(fabric, PlaneDirection{curve_views[i], weft}.direction());
    FigureLine curve{{}, curve_colors[i], 1.8f, false};
    for (float a = -90; a <= 90; a += 0.25f)
      curve.points.push_back(
          place(a, radius_of(mean_component(evaluate(*view, PlaneDirection{a, weft}.direction())))));
    f.shapes.push_back(curve);
    const Vec2 mark = place(curve_views[i], radius + 3);
    f.shapes.push_back(FigureBox{mark - Vec2(3, 3), mark + Vec2(3, 3), curve_colors[i]});
  }
  add_text(f, center.x, center.y + 24, weft ? "plane of the weft" : "plane of the warp", ink, 2,
           FigureText::Anchor::middle);
}

float largest_in_plane(const Fabric& fabric, bool weft) {
  float largest = 0;
  for (const float angle : curve_views) {
    const auto view = viewed(fabric, PlaneDirection{angle, weft}.direction());
    for (float a = -90; a <= 90; a += 0.25f)
      largest = std::max(largest, mean_component(evaluate(*view, PlaneDirection{a, weft}.direction())));
  }
  return largest > 0 ? largest : 1;
}

// The hemisphere from above: warp to the right, weft up, the horizon as rim.
void add_hemisphere(Figure& f, const Fabric& fabric, const PlaneDirection& from, const Vec2& at, int side) {
  const auto view = viewed(fabric, from.direction());
  Image map(side, side, 4);
  std::vector<float> values(size_t(side) * size_t(side), -1);
  float largest = 0;
  const auto direction = [&](int x, int y, Vec3& wi) {
    const float u = (float(x) + 0.5f) / float(side) * 2 - 1, v = 1 - (float(y) + 0.5f) / float(side) * 2;
    const float z2 = 1 - u * u - v * v;
    wi = Vec3(u, v, std::sqrt(std::max(z2, 0.0f)));
    return z2 > 0;
  };
  Vec3 wi;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      if (direction(x, y, wi)) {
        float& value = values[size_t(y) * size_t(side) + size_t(x)];
        value = mean_component(evaluate(*view, wi));
        largest = std::max(largest, value);
      }
  for (size_t i = 0; i < values.size(); ++i) {
    const float t = values[i] > 0 && largest > 0 ? 1 + std::log10(values[i] / largest) / decades : 0;
    // A tenth of a decade a step: contours can be followed by eye, and an SVG stays small.
    const Color c = ramp(std::round(t * 10 * decades) / (10 * decades));
    for (int k = 0; k < 3; ++k) map.pixels[4 * i + size_t(k)] = c[k];
    map.pixels[4 * i + 3] = values[i] >= 0 ? 1.0f : 0.0f;
  }
  f.shapes.push_back(FigurePicture{at, std::move(map), 1});
  const Vec2 middle = at + Vec2(float(side) / 2, float(side) / 2);
  FigureLine rim{{}, ink, 1.2f, true};
  for (int a = 0; a < 360; a += 4)
    rim.points.push_back(middle + Vec2(std::cos(radians(float(a))), std::sin(radians(float(a)))) * (float(side) / 2));
  f.shapes.push_back(rim);
  const Vec3 d = from.direction();
  const Vec2 eye = middle + Vec2(d.x, -d.y) * (float(side) / 2);
  for (const Vec2& arm : {Vec2(5, 0), Vec2(0, 5)}) {
    f.shapes.push_back(FigureLine{{eye - arm, eye + arm}, Color(1, 1, 1), 3, false});
    f.shapes.push_back(FigureLine{{eye - arm, eye + arm}, curve_colors[0], 1.4f, false});
  }
  add_text(f, middle.x, at.y + float(side) + 8, "view " + from.text(), ink, 2, FigureText::Anchor::middle);
  add_text(f, middle.x, at.y + float(side) + 28, fmt::format("peak {:.3g} /sr", largest), soft, 1,
           FigureText::Anchor::middle);
}

void add_legend(Figure& f, float x, float y) {
  for (int i = 0; i < 4; ++i) {
    f.shapes.push_back(FigureLine{{Vec2(x, y + 4), Vec2(x + 26, y + 4)}, curve_colors[i], 2.5f, false});
    add_text(f, x + 34, y, fmt::format("view {:.0f} deg", curve_views[i]), ink);
    x += 140;
  }
  add_text(f, x, y, "radius: square root of F = f cos [1/sr]; squares mark the views", soft);
}

void add_scale(Figure& f, float x, float y, float width) {
  for (int i = 0; i < int(width); ++i)
    f.shapes.push_back(
        FigureBox{Vec2(x + float(i), y), Vec2(x + float(i) + 1, y + 10), ramp((float(i) + 0.5f) / width)});
  for (int d = 0; d <= decades; ++d)
    add_text(f, x + width * float(d) / decades, y + 14, d == decades ? "peak" : fmt::format("1e-{}", decades - d),
             soft, 1, FigureText::Anchor::middle);
  add_text(f, x + width + 34, y + 2,
           "F over the hemisphere seen from above: warp to the right, weft up; the cross is the view", soft);
}
}  // namespace

Vec3 PlaneDirection::direction() const {
  const float s = std::sin(radians(angle_deg)), c = std::max(std::cos(radians(angle_deg)), 1e-6f);
  return along_weft ? Vec3(0, s, c) : Vec3(s, 0, c);
}

std::string PlaneDirection::text() const {
  return angle_deg == 0 ? "0" : fmt::format("{:.0f} {}", angle_deg, along_weft ? "weft" : "warp");
}

const std::vector<PlaneDirection>& table_views() {
  static const std::vector<PlaneDirection> views{{0, false},  {30, false}, {45, false}, {60, false},
                                                 {75, false}, {85, false}, {30, true},  {45, true},
                                                 {60, true},  {75, true},  {85, true}};
  return views;
}

LobeSummary summarise_lobe(const Fabric& fabric, const PlaneDirection& from) {
  LobeSummary summary;
  summary.view = from;
  summary.albedo = albedo_color(fabric, from.direction());
  const auto view = viewed(fabric, from.direction());
  // A grid over the warp's coordinates, along which the lobes run, then ever finer steps around the best.
  float theta = 0, phi = 0, step = radians(2);
  const auto wi_at = [](float t, float p) {
    return Vec3(std::sin(t), std::cos(t) * std::sin(p), std::cos(t) * std::cos(p));
  };
  const auto try_at = [&](float t, float p) {
    // Nearer to the horizon than 0.06 degrees no picture can show it.
    if (std::abs(t) >= pi / 2 || std::abs(p) >= pi / 2 || wi_at(t, p).z < 1e-3f) return;
    const float value = mean_component(evaluate(*view, wi_at(t, p)));
    if (value > summary.peak) summary.peak = value, theta = t, phi = p;
  };
  for (int i = -44; i <= 44; ++i)
    for (int j = -44; j <= 44; ++j) try_at(float(i) * step, float(j) * step);
  for (int round = 0; round < 12; ++round) {
    step /= 2;
    const float t = theta, p = phi;
    for (int i = -2; i <= 2; ++i)
      for (int j = -2; j <= 2; ++j) try_at(t + float(i) * step, p + float(j) * step);
  }
  summary.peak_direction = wi_at(theta, phi);
  return summary;
}

Figure lobe_figure(const Fabric& fabric, const std::string& title) {
  Figure f;
  f.width = 1180;
  f.height = 860;
  f.background = Color(0.985f, 0.985f, 0.98f);
  add_text(f, 30, 22, title, ink, 3);
  const float scale = std::max(largest_in_plane(fabric, false), largest_in_plane(fabric, true));
  add_polar(f, fabric, false, Vec2(300, 370), 250, scale);
  add_polar(f, fabric, true, Vec2(880, 370), 250, scale);
  add_legend(f, 40, 440);
  constexpr int side = 240;
  const PlaneDirection views[4] = {{0, false}, {45, false}, {75, false}, {45, true}};
  for (int i = 0; i < 4; ++i) add_hemisphere(f, fabric, views[i], Vec2(40 + 286 * float(i), 490), side);
  add_scale(f, 40, 812, 300);
  return f;
}

}  // namespace sateen
