#include "render/approximations.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "base/error.h"
#include "base/nearest_name.h"
#include "look/json.h"
#include "look/read.h"
#include "render/assemble.h"

namespace sateen {

namespace {

constexpr int least_map = 8, largest_map = 65536;
const char* const whole_map = "file";

template <class Number>
Number read_between(const char* flag, const std::string& text, Number low, Number high, const std::string& or_else) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [next, code] = std::from_chars(text.data(), end, value);
  if (code != std::errc() || next != end || !(value >= low && value <= high))
    throw InputError(
        fmt::format("{} is {}, expected a number from {} to {}{}", flag, shown_name(text), low, high, or_else));
  return value;
}

std::vector<std::string> ladder_of(std::vector<float> steps, float asked) {
  if (std::find(steps.begin(), steps.end(), asked) == steps.end()) steps.push_back(asked);
  std::sort(steps.begin(), steps.end());
  std::vector<std::string> texts;
  for (const float step : steps) texts.push_back(fmt::format("{}", step));
  return texts;
}

void rebuild_looks(const SceneSettings& settings, const ColorManager& colors, Scene& scene) {
  compile_looks(read_look(settings.look, settings.look_overrides), settings, colors, scene.metres_per_uv, scene);
}

Approximation quadrature() {
  return {
      "--quadrature",
      "X",
      "nodes of the tangent curves' quadrature, times the usual, 0.125 to 8 (default: 1, errors below a thousandth "
      "of the highlight)",
      "quadrature",
      true,
      true,
      "nodes of the tangent curves' quadrature, times the usual: short curves have one panel at every setting",
      [](const std::string& text, Approximations& to) {
        to.quadrature = read_between<float>("--quadrature", text, 0.125f, 8, "");
      },
      [](const Approximations& of) { return fmt::format("{}", of.quadrature); },
      [](const Approximations& asked, const Scene&) {
        return ladder_of({0.25f, 0.5f, 1, 2, 4}, asked.quadrature);
      },
      rebuild_looks};
}

Approximation table_size() {
  return {"--table-size",
          "X",
          "views of the direction table in either axis, times the usual, 0.125 to 4: noise and start-up time alone "
          "(default: 1)",
          "table size",
          false,
          false,
          "views of the direction table in either axis, times the usual",
          [](const std::string& text, Approximations& to) {
            to.table_size = read_between<float>("--table-size", text, 0.125f, 4, "");
          },
          [](const Approximations& of) { return fmt::format("{}", of.table_size); },
          [](const Approximations& asked, const Scene&) {
            return ladder_of({0.25f, 0.5f, 1, 2}, asked.table_size);
          },
          rebuild_looks};
}

Approximation map_size() {
  return {"--map-size",
          "N|file",
          "shrinks a light that is wider to N texels across, 8 to 65536, each the mean of what it covers (default: "
          "file, as it is)",
          "map size",
          true,
          true,
          "texels across, each the mean of those that it covers in the file",
          [](const std::string& text, Approximations& to) {
            to.map_size = text == whole_map ? 0
                                            : read_between<int>("--map-size", text, least_map, largest_map,
                                                                fmt::format(", or {}", whole_map));
          },
          [](const Approximations& of) { return of.map_size == 0 ? whole_map : fmt::format("{}", of.map_size); },
          [](const Approximations& asked, const Scene& scene) {
            const int whole = scene.environment.width;
            std::vector<int> widths;
            for (const int part : {16, 8, 4, 2})
              if (whole / part >= least_map) widths.push_back(whole / part);
            if (asked.map_size > 0 && std::find(widths.begin(), widths.end(), asked.map_size) == widths.end())
              widths.push_back(asked.map_size);
            std::sort(widths.begin(), widths.end());
            std::vector<std::string> texts;
            for (const int width : widths) texts.push_back(fmt::format("{}", width));
            texts.push_back(whole_map);
            return texts;
          },
          [](const SceneSettings& settings, const ColorManager& colors, Scene& scene) {
            scene.environment = read_light(settings, colors);
            // The stage was compiled in the light of the old map: the ground's open sky, the blurred backdrop.
            scene.blurred.reset();
            set_stage(scene, settings.stage, settings.threads);
          }};
}

Approximation filter() {
  return {
      "--filter",
      "NAME[:RADIUS]",
      fmt::format("of pixels: {}; the radius in pixels, 0.05 to 8 (default: {})", fmt::join(filter_names(), ", "),
                  filter_text({})),
      "filter",
      true,
      false,
      "which is right is a matter of taste between sharp and smooth: all are held against the one that is asked for",
      [](const std::string& text, Approximations& to) { to.filter = read_filter("--filter", text); },
      [](const Approximations& of) { return filter_text(of.filter); },
      [](const Approximations& asked, const Scene&) {
        std::vector<std::string> texts;
        for (const char* each : {"box:0.5", "triangle:1", "gaussian:1.5", "blackman-harris:1.5"})
          if (each != filter_text(asked.filter)) texts.push_back(each);
        texts.push_back(filter_text(asked.filter));
        return texts;
      },
      [](const SceneSettings& settings, const ColorManager&, Scene& scene) {
        scene.filter = compile_filter(settings.approximations.filter);
      }};
}

}  // namespace

const std::vector<Approximation>& approximation_list() {
  static const std::vector<Approximation> all{quadrature(), table_size(), map_size(), filter()};
  return all;
}

}  // namespace sateen
