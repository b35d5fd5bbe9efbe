#include "scene/environment_make.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "image/chromaticities.h"
#include "image/file.h"
#include "scene/environment.h"

namespace sateen {

namespace {
constexpr double pi_d = std::numbers::pi, degree = pi_d / 180;

double smoothstep(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

// A light with its frame and limits worked out once.
struct Placed {
  const MapLight& light;
  Vec3d toward, right, up;
  double tan_width = 0, tan_height = 0, width = 0;
  double cap = pi_d;  // nothing beyond this angle from `toward`

  explicit Placed(const MapLight& l) : light(l) {
    const double azimuth = double(l.azimuth_deg) * degree, elevation = double(l.elevation_deg) * degree;
    toward =
        Vec3d(std::sin(azimuth) * std::cos(elevation), std::sin(elevation), std::cos(azimuth) * std::cos(elevation));
    // Seen from the middle, facing the light: right is where azimuth falls, since azimuth 90 is the camera's right.
    const Vec3d level(-std::cos(azimuth), 0, std::sin(azimuth)), lift = level.cross(toward);
    const double roll = double(l.roll_deg) * degree;
    right = level * std::cos(roll) - lift * std::sin(roll);
    up = level * std::sin(roll) + lift * std::cos(roll);
    width = double(l.width_deg) * degree;
    tan_width = std::tan(width / 2);
    tan_height = std::tan(double(l.height_deg) * degree / 2);
    if (l.kind == MapLight::Kind::softbox) cap = std::atan(std::hypot(tan_width, tan_height));
    if (l.kind == MapLight::Kind::disc) cap = width / 2;
    if (l.kind == MapLight::Kind::glow) cap = std::min(pi_d, 6 * width);  // exp(-36) is below float's notice
  }
};

double angle_between(const Vec3d& a, const Vec3d& b) {
  return std::atan2(a.cross(b).length(), a.dot(b));
}

double softbox_level(const Placed& p, const Vec3d& direction) {
  const double depth = direction.dot(p.toward);
  if (depth <= 1e-6) return 0;
  const double x = std::abs(direction.dot(p.right)) / (depth * p.tan_width);
  const double y = std::abs(direction.dot(p.up)) / (depth * p.tan_height);
  if (x >= 1 || y >= 1) return 0;
  const double edge = double(p.light.edge);
  const double fade = edge > 0 ? smoothstep((1 - x) / edge) * smoothstep((1 - y) / edge) : 1;
  return fade * (1 - double(p.light.hot) * (x * x + y * y) / 2);
}

double disc_level(const Placed& p, double angle) {
  const double r = angle / (p.width / 2), edge = double(p.light.edge);
  return r >= 1 ? 0 : edge > 0 ? smoothstep((1 - r) / edge) : 1;
}

Color gradient_color(const MapLight& light, double elevation_deg) {
  const auto& stops = light.stops;
  if (stops.empty()) return Color(0, 0, 0);
  if (elevation_deg <= double(stops.front().elevation_deg)) return stops.front().color;
  for (size_t i = 1; i < stops.size(); ++i) {
    const double low = double(stops[i - 1].elevation_deg), high = double(stops[i].elevation_deg);
    if (elevation_deg >= high) continue;
    const auto t = float((elevation_deg - low) / (high - low));
    return stops[i - 1].color * (1 - t) + stops[i].color * t;
  }
  return stops.back().color;
}

Color evaluate(const Placed& p, const Vec3d& direction) {
  const MapLight& light = p.light;
  double level = 1;
  switch (light.kind) {
    case MapLight::Kind::uniform:
      break;
    case MapLight::Kind::gradient:
      return gradient_color(light, std::asin(std::clamp(direction.y, -1.0, 1.0)) / degree) * light.intensity;
    case MapLight::Kind::softbox:
      level = softbox_level(p, direction);
      break;
    case MapLight::Kind::disc:
      level = disc_level(p, angle_between(direction, p.toward));
      break;
    case MapLight::Kind::glow: {
      const double r = angle_between(direction, p.toward) / p.width;
      level = std::exp(-r * r);
      break;
    }
  }
  return light.color * (light.intensity * float(level));
}

// Points a side of a texel: many where the light has a border that a texel would show as a stair or miss.
int points_aside(const MapLight& light, double texel_deg) {
  const auto narrow = [&](float smallest_deg) { return double(smallest_deg) < 4 * texel_deg; };
  switch (light.kind) {
    case MapLight::Kind::uniform:
      return 1;
    case MapLight::Kind::gradient:
      return 8;  // one texel a row is worked out
    case MapLight::Kind::softbox:
      return narrow(light.edge * std::min(light.width_deg, light.height_deg) / 2) ? 16 : 4;
    case MapLight::Kind::disc:
      return narrow(light.edge * light.width_deg / 2) ? 16 : 4;
    case MapLight::Kind::glow:
      return narrow(light.width_deg) ? 16 : 2;
  }
  return 1;
}

// Mean over the texel, points spread evenly in longitude and in the cosine of colatitude.
Color texel_mean(const Placed& p, int x, int y, const MapDescription& d) {
  const double height = pi_d / d.height, middle = (y + 0.5) * height;
  const double azimuth = -2 * pi_d * ((x + 0.5) / d.width);
  const auto direction = [](double cosine, double sine, double a) {
    return Vec3d(std::sin(a) * sine, cosine, std::cos(a) * sine);
  };
  const double reach = std::hypot(height, 2 * pi_d / d.width) / 2;
  if (p.cap < pi_d && angle_between(direction(std::cos(middle), std::sin(middle), azimuth), p.toward) > p.cap + reach)
    return Color(0, 0, 0);
  const int side = points_aside(p.light, height / degree);
  const double top = std::cos(y * height), bottom = std::cos((y + 1) * height);
  Color sum(0, 0, 0);
  for (int j = 0; j < side; ++j) {
    const double cosine = top + (bottom - top) * (j + 0.5) / side,
                 sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    for (int i = 0; i < side; ++i)
      sum += evaluate(p, direction(cosine, sine, -2 * pi_d * (x + (i + 0.5) / side) / d.width));
  }
  return sum / float(side * side);
}

void add_light(Image& map, const Placed& p, const MapDescription& d) {
  const bool same_in_row = p.light.kind == MapLight::Kind::uniform || p.light.kind == MapLight::Kind::gradient;
  for (int y = 0; y < d.height; ++y) {
    const Color row = same_in_row ? texel_mean(p, 0, y, d) : Color(0, 0, 0);
    for (int x = 0; x < d.width; ++x) {
      const Color c = same_in_row ? row : texel_mean(p, x, y, d);
      for (int i = 0; i < 3; ++i) map.at(x, y)[i] += c[i];
    }
  }
}

// Integral of a disc's level over its cap [sr], by the midpoint rule in the cosine.
double disc_solid_angle(const Placed& p) {
  constexpr int steps = 4096;
  const double depth = 2 * std::sin(p.width / 4) * std::sin(p.width / 4);  // 1 - cos(width / 2)
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double angle = 2 * std::asin(std::sqrt(depth * (i + 0.5) / steps / 2));
    sum += disc_level(p, angle);
  }
  return 2 * pi_d * depth * sum / steps;
}

// The points of a texel judge a sun of one or two texels badly: its shape is theirs, its energy is set exactly.
void add_disc(Image& map, const Placed& p, const MapDescription& d) {
  Image part(d.width, d.height, 3);
  add_light(part, p, d);
  double found = 0;
  const float most = max_component(p.light.color) * p.light.intensity;
  const int channel = p.light.color.x == max_component(p.light.color)   ? 0
                      : p.light.color.y == max_component(p.light.color) ? 1
                                                                        : 2;
  if (most <= 0) return;
  for (int y = 0; y < d.height; ++y)
    for (int x = 0; x < d.width; ++x)
      found += double(part.at(x, y)[channel]) * environment_row_weight(y, d.height) * 2 * pi_d / d.width;
  const double wanted = double(most) * disc_solid_angle(p);
  if (found > 0.25 * wanted) {
    for (size_t i = 0; i < map.pixels.size(); ++i) map.pixels[i] += part.pixels[i] * float(wanted / found);
    return;
  }
  // Smaller than the points are apart: all of it in the texel of its middle.
  const double turns = -std::atan2(p.toward.x, p.toward.z) / (2 * pi_d);
  const int x = std::min(int((turns - std::floor(turns)) * d.width), d.width - 1);
  const int y = std::min(int(std::acos(std::clamp(p.toward.y, -1.0, 1.0)) / pi_d * d.height), d.height - 1);
  const double level = disc_solid_angle(p) / (environment_row_weight(y, d.height) * 2 * pi_d / d.width);
  for (int i = 0; i < 3; ++i) map.at(x, y)[i] += p.light.color[i] * p.light.intensity * float(level);
}

const ColorManager::Chromaticities& chromaticities_named(const std::string& space) {
  return space == "acescg" ? ap1_chromaticities : rec709_chromaticities;
}
}  // namespace

Image make_environment(const MapDescription& d) {
  Image map(d.width, d.height, 3);
  for (const MapLight& light : d.lights) {
    const Placed placed(light);
    if (light.kind == MapLight::Kind::disc)
      add_disc(map, placed, d);
    else
      add_light(map, placed, d);
  }
  if (!d.metered) return map;
  EnvironmentOptions options;
  const Matrix3 to_xyz = rgb_to_xyz(chromaticities_named(d.color_space));
  options.luminance = Color(float(to_xyz[1][0]), float(to_xyz[1][1]), float(to_xyz[1][2]));
  const float gain = std::exp2(metered_exposure_ev(build_environment(map, options)));
  for (float& value : map.pixels) value *= gain;
  return map;
}

HalfRange write_made_environment(const std::filesystem::path& path, const MapDescription& d) {
  ImageLayer layer;
  layer.channels = {"R", "G", "B"};
  layer.half = true;
  layer.image = make_environment(d);
  return write_exr(path, {layer}, {{"sateen:title", d.title}, {"sateen:description", d.description}},
                   chromaticities_named(d.color_space));
}

Color black_body_rec709(float kelvin) {
  const double t = std::clamp(double(kelvin), 1000.0, 15000.0), t2 = t * t;
  const double u =
      (0.860117757 + 1.54118254e-4 * t + 1.28641212e-7 * t2) / (1 + 8.42420235e-4 * t + 7.08145163e-7 * t2);
  const double v =
      (0.317398726 + 4.22806245e-5 * t + 4.20481691e-8 * t2) / (1 - 2.89741816e-5 * t + 1.61456053e-7 * t2);
  const double x = 3 * u / (2 * u - 8 * v + 4), y = 2 * v / (2 * u - 8 * v + 4);
  const Matrix3 m = inverse(rgb_to_xyz(rec709_chromaticities));
  const double xyz[3] = {x / y, 1, (1 - x - y) / y};
  double rgb[3];
  for (size_t i = 0; i < 3; ++i) rgb[i] = std::max(0.0, m[i][0] * xyz[0] + m[i][1] * xyz[1] + m[i][2] * xyz[2]);
  const double luminance = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
  return Color(float(rgb[0] / luminance), float(rgb[1] / luminance), float(rgb[2] / luminance));
}

}  // namespace sateen
