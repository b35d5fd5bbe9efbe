#include "render/references.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "scene/environment_texel.h"

namespace sateen {

namespace {

constexpr int chart_columns = 6, chart_rows = 4;

// The ColorChecker Classic: sRGB codes (D65) as its maker X-Rite publishes them for the first 18 patches.
constexpr std::uint8_t chart_codes[18][3] = {
    {115, 82, 68},  {194, 150, 130}, {98, 122, 157}, {87, 108, 67},  {133, 128, 177}, {103, 189, 170},
    {214, 126, 44}, {80, 91, 166},   {193, 90, 99},  {94, 60, 108},  {157, 188, 64},  {224, 163, 46},
    {56, 61, 150},  {70, 148, 73},   {175, 54, 60},  {231, 199, 31}, {187, 86, 149},  {8, 133, 161}};

// Its grey row by the densities printed on it: 0.05, 0.23, 0.44, 0.70, 1.05, 1.50; reflectance is 10^-density.
constexpr struct {
  const char* name;
  float reflectance;
} grey_row[6] = {{"white", 0.891f},     {"neutral 8", 0.589f},    {"neutral 6.5", 0.363f},
                 {"neutral 5", 0.200f}, {"neutral 3.5", 0.0891f}, {"black", 0.0316f}};
constexpr float frame_reflectance = 0.02f;

/// The map averaged down, as directions that weigh their solid angle.
struct Lamp {
  Vec3 direction;
  Color power;  ///< radiance times solid angle
};
std::vector<Lamp> lamps_of(const Environment& e) {
  // 2.8 degrees: a cosine changes by a thousandth of itself within a texel.
  constexpr int width = 128;
  const Image map = average_environment(e, width);
  std::vector<Lamp> lamps;
  for (int y = 0; y < map.height; ++y) {
    const double colatitude = std::numbers::pi * (y + 0.5) / map.height;
    const double solid_angle = 2 * std::numbers::pi / width * environment_row_weight(y, map.height);
    for (int x = 0; x < width; ++x) {
      const double longitude = 2 * std::numbers::pi * ((x + 0.5) / width - 0.5 + e.rotation_turns);
      const float* c = map.at(x, y);
      lamps.push_back({Vec3(float(std::sin(colatitude) * std::sin(longitude)), float(std::cos(colatitude)),
                            float(-std::sin(colatitude) * std::cos(longitude))),
                       Color(c[0], c[1], c[2]) * float(solid_angle)});
    }
  }
  return lamps;
}

/// Irradiance over pi: what a white matte surface shows.
Color white_matte(const std::vector<Lamp>& lamps, const Vec3& normal) {
  Vec3d sum(0);
  for (const Lamp& lamp : lamps)
    if (const float cosine = dot(lamp.direction, normal); cosine > 0) sum += Vec3d(lamp.power * cosine);
  return Color(Vec3(sum / std::numbers::pi));
}

/// A round place of the picture, in pixels from the top left.
struct Disk {
  float x, y, radius;
};

void put(Image& overlay, int x, int y, const Color& color, float coverage) {
  if (x < 0 || y < 0 || x >= overlay.width || y >= overlay.height || coverage <= 0) return;
  float* to = overlay.at(x, y);
  for (int c = 0; c < 3; ++c) to[c] = color[c] * coverage;
  to[3] = coverage;
}

/// Calls draw(x, y, u, v, coverage) for the pixels of a disk, (u, v) in the unit disk, v up.
template <class Draw>
void each_pixel(const Disk& disk, int threads, const Draw& draw) {
  const int first = int(std::floor(disk.y - disk.radius)), last = int(std::ceil(disk.y + disk.radius));
  parallel_for(last - first + 1, threads, [&](int row) {
    const int y = first + row;
    for (int x = int(std::floor(disk.x - disk.radius)); x <= int(std::ceil(disk.x + disk.radius)); ++x) {
      const float u = (float(x) + 0.5f - disk.x) / disk.radius, v = (disk.y - float(y) - 0.5f) / disk.radius;
      const float coverage = std::clamp((1 - std::hypot(u, v)) * disk.radius + 0.5f, 0.0f, 1.0f);
      if (coverage > 0) draw(x, y, u, v, coverage);
    }
  });
}

Vec3 ball_normal(const Camera& camera, float u, float v) {
  const float off = std::hypot(u, v), scale = off > 0.999f ? 0.999f / off : 1;
  u *= scale;
  v *= scale;
  return camera.right * u + camera.up * v - camera.forward * std::sqrt(1 - u * u - v * v);
}

/// The map seen in a pixel of a perfect mirror ball: 8 x 8 places, texels averaged to what one place covers.
struct Mirror {
  const Environment& environment;
  const Camera& camera;
  Image map;
  float radius;

  static constexpr int side = 8;
  Mirror(const Environment& e, const Camera& c, float r)
      : environment(e),
        camera(c),
        // In the middle a pixel turns the reflection by 2 / radius.
        map(average_environment(e, std::clamp(int(pi * side * r) / 2 * 2, 16, std::max(e.width, 16)))),
        radius(r) {}

  Color operator()(float u, float v) const {
    Color sum(0);
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) {
        const float du = ((float(i) + 0.5f) / side - 0.5f) / radius, dv = ((float(j) + 0.5f) / side - 0.5f) / radius;
        const Vec3 n = ball_normal(camera, u + du, v + dv);
        const MapPlace place = environment_place(environment, camera.forward - n * (2 * dot(camera.forward, n)));
        const int x = std::clamp(int(place.x / environment.width * map.width), 0, map.width - 1);
        const int y = std::clamp(int(place.y / environment.height * map.height), 0, map.height - 1);
        const float* c = map.at(x, y);
        sum += Color(c[0], c[1], c[2]);
      }
    return sum / float(side * side);
  }
};

Color display_code(const Color& light, const ColorManager& colors, const DisplaySettings& display, float ev) {
  Image pixel(1, 1, 3);
  for (size_t c = 0; c < 3; ++c) pixel.pixels[c] = light[int(c)];
  colors.to_display(pixel, display.display, display.view, ev);
  return {pixel.pixels[0], pixel.pixels[1], pixel.pixels[2]};
}

/// Draws the chart with its lower left corner at (left, bottom); `white` is what a white card facing the camera
/// shows.
void draw_chart(Image& overlay, int left, int bottom, int patch, const Color& white, const ColorManager& colors,
                References& references) {
  const int gap = std::max(patch / 6, 1), pitch = patch + gap;
  const int top = bottom - chart_rows * pitch - gap;
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < left + chart_columns * pitch + gap; ++x) put(overlay, x, y, white * frame_reflectance, 1);
  for (int i = 0; i < chart_columns * chart_rows; ++i) {
    Color light;
    if (i < 18) {
      const auto& c = chart_codes[i];
      light = white * colors.to_working(Color(float(c[0]), float(c[1]), float(c[2])) / 255.0f, "srgb_texture");
    } else {
      const auto& grey = grey_row[i - 18];
      light = white * grey.reflectance;
      references.greys[size_t(i - 18)] = {grey.name, grey.reflectance, light, {}};
    }
    const int x0 = left + gap + i % chart_columns * pitch, y0 = top + gap + i / chart_columns * pitch;
    for (int y = y0; y < y0 + patch; ++y)
      for (int x = x0; x < x0 + patch; ++x) put(overlay, x, y, light, 1);
  }
}

}  // namespace

References make_references(const Environment& environment, const Camera& camera, const ColorManager& colors,
                           const DisplaySettings& display, float exposure_ev, int threads) {
  const int side = std::min(camera.width, camera.height);
  if (side < least_reference_side)
    throw InputError(fmt::format("--references in a picture of {} x {}, expected at least {} pixels on both sides",
                                 camera.width, camera.height, least_reference_side));
  References out;
  out.overlay = Image(camera.width, camera.height, 4);
  const std::vector<Lamp> lamps = lamps_of(environment);
  const float radius = 0.068f * float(side), margin = 0.035f * float(side),
              middle = float(camera.height) - margin - radius;
  const Disk grey{margin + radius, middle, radius}, chrome{grey.x + 2 * radius + margin / 2, middle, radius};

  each_pixel(grey, threads, [&](int x, int y, float u, float v, float coverage) {
    put(out.overlay, x, y, white_matte(lamps, ball_normal(camera, u, v)) * grey_ball_reflectance, coverage);
  });
  Vec3d sum(0);
  double weight = 0;
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      const float* p = out.overlay.at(x, y);
      const Color c(p[0], p[1], p[2]);
      sum += Vec3d(c);
      weight += double(p[3]);
      if (p[3] == 1 && mean_component(c) > mean_component(out.ball_brightest)) out.ball_brightest = c;
    }
  out.ball_mean = Color(Vec3(sum / weight));

  const Mirror mirror(environment, camera, radius);
  each_pixel(chrome, threads,
             [&](int x, int y, float u, float v, float coverage) { put(out.overlay, x, y, mirror(u, v), coverage); });
  const Color white = white_matte(lamps, -camera.forward);
  const int patch = std::max(int(2 * radius / 4.9f), 1);
  draw_chart(out.overlay, int(chrome.x + radius + margin / 2), int(middle + radius), patch, white, colors, out);

  out.ball_code = display_code(out.ball_mean, colors, display, exposure_ev);
  for (References::Patch& grey_patch : out.greys)
    grey_patch.code = display_code(grey_patch.light, colors, display, exposure_ev);
  return out;
}

}  // namespace sateen
