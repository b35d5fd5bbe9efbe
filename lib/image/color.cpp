#include "image/color.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <mutex>
#include <utility>

#include "base/error.h"
#include "base/nearest_name.h"
#include "image/built_in_config.h"
#include "image/chromaticities.h"
#include "image/color_config.h"
#include "image/color_messages.h"

namespace sateen {

namespace ocio = OCIO_NAMESPACE;

namespace {
// A colour space and the config it lives in.
struct Space {
  bool own = true;
  std::string name;
  bool operator<(const Space& o) const { return own != o.own ? own < o.own : name < o.name; }
};

using Steps = std::vector<ocio::ConstCPUProcessorRcPtr>;

void refuse_ring(const std::string& what, const std::string& ring) {
  if (!ring.empty())
    throw InputError(fmt::format("{}: names in the config lead back to themselves without end: {}", what, ring),
                     "take another space or view, or mend the config");
}
}  // namespace

struct ColorManager::State {
  ocio::ConstConfigRcPtr own, config;  // the same object where no foreign config is in force
  Bridge bridge;
  Space working;
  std::string text;
  std::vector<std::string> warnings;
  mutable std::mutex lock;
  mutable std::map<std::pair<Space, Space>, Steps> known;

  bool foreign() const { return config != own; }

  Space find(const std::string& name) const {
    if (config->getColorSpace(name.c_str())) return {!foreign(), name};
    if (foreign() && own->getColorSpace(name.c_str())) return {true, name};
    std::vector<std::string> names;
    for (int i = 0; i < config->getNumColorSpaces(); ++i) names.emplace_back(config->getColorSpaceNameByIndex(i));
    if (foreign())
      for (int i = 0; i < own->getNumColorSpaces(); ++i) names.emplace_back(own->getColorSpaceNameByIndex(i));
    throw InputError(fmt::format("\"{}\" is not a colour space of {}", name, text), suggestion(name, names));
  }

  const ocio::ConstConfigRcPtr& config_of(const Space& space) const { return space.own ? own : config; }

  Steps convert(const Space& from, const Space& to) const {
    const std::lock_guard guard(lock);
    auto& steps = known[{from, to}];
    if (!steps.empty()) return steps;
    const std::string what = fmt::format("cannot convert from {} to {} under {}", from.name, to.name, text);
    if (!from.own || !to.own) {
      const auto near = [&](const Space& s) { return s.own ? bridge.foreign : s.name; };
      refuse_ring(what, ring_between(*config, near(from), near(to)));
    }
    steps.push_back(guarded(what, [&] {
      if (from.own == to.own)
        return config_of(from)->getProcessor(from.name.c_str(), to.name.c_str())->getDefaultCPUProcessor();
      const auto name = [&](const Space& s) { return (s.own ? bridge.own : bridge.foreign).c_str(); };
      return ocio::Config::GetProcessorFromConfigs(config_of(from), from.name.c_str(), name(from), config_of(to),
                                                   to.name.c_str(), name(to))
          ->getDefaultCPUProcessor();
    }));
    return steps;
  }
};

namespace {
void run(const Steps& steps, Image& image) {
  if (image.channels < 3 || image.pixels.empty()) return;
  const auto pixel = std::ptrdiff_t(sizeof(float)) * image.channels;
  for (const auto& step : steps) {
    if (step->isNoOp()) continue;
    // Only the first three channels are shown to OpenColorIO, so that alpha and data channels stay as they are.
    ocio::PackedImageDesc view(image.pixels.data(), image.width, image.height, 3, ocio::BIT_DEPTH_F32, sizeof(float),
                               pixel, pixel * image.width);
    step->apply(view);
  }
}

Color run(const Steps& steps, Color value) {
  for (const auto& step : steps) step->applyRGB(&value.x);
  return value;
}
}  // namespace

ColorManager::ColorManager(const std::string& path, const std::string& working) : state_(std::make_unique<State>()) {
  State& s = *state_;
  const ocio::ConfigRcPtr own = guarded("the built-in colour config is refused", built_in_color_config);
  s.own = own;
  const char* environment = std::getenv("OCIO");
  const bool from_environment = path.empty() && environment && *environment;
  if (from_environment || !(path.empty() || path == built_in_config_name)) {
    const std::string origin = from_environment ? "$OCIO" : "--ocio";
    const std::string file = from_environment ? environment : path;
    s.config = read_color_config(file, origin, s.warnings);
    s.bridge = find_bridge(*s.config, file, *own, s.warnings);
    s.text = fmt::format("{} (from {}, joined to the project's spaces by {})", file, origin, s.bridge.how);
  } else {
    s.config = s.own;
    s.text = "the built-in config";
  }
  s.working = s.find(working.empty() ? "scene_linear" : working);
  const Steps to_aces = s.convert(s.working, {true, "aces2065-1"});
  const Color one = run(to_aces, Color(0.1f, 0.1f, 0.1f)), ten = run(to_aces, Color(1, 1, 1));
  if (!(std::abs(ten.y - 10 * one.y) < 1e-3f * std::abs(ten.y)))
    throw InputError(fmt::format("the working space {} is not scene-linear", s.working.name),
                     "expected a linear space such as acescg or lin_rec709");
}

ColorManager::~ColorManager() = default;
ColorManager::ColorManager(ColorManager&&) noexcept = default;

std::string ColorManager::description() const {
  return state_->text;
}

const std::vector<std::string>& ColorManager::warnings() const {
  return state_->warnings;
}

std::string ColorManager::working_space() const {
  return state_->config_of(state_->working)->getColorSpace(state_->working.name.c_str())->getName();
}

bool ColorManager::has_space(const std::string& name) const {
  return state_->config->getColorSpace(name.c_str()) || state_->own->getColorSpace(name.c_str());
}

std::vector<std::string> ColorManager::spaces() const {
  std::vector<std::string> names;
  for (int i = 0; i < state_->config->getNumColorSpaces(); ++i)
    names.emplace_back(state_->config->getColorSpaceNameByIndex(i));
  return names;
}

std::vector<std::string> ColorManager::displays() const {
  std::vector<std::string> names;
  for (int i = 0; i < state_->config->getNumDisplays(); ++i) names.emplace_back(state_->config->getDisplay(i));
  return names;
}

std::vector<std::string> ColorManager::views(const std::string& display) const {
  std::vector<std::string> names;
  for (int i = 0; i < state_->config->getNumViews(display.c_str()); ++i)
    names.emplace_back(state_->config->getView(display.c_str(), i));
  return names;
}

std::string ColorManager::default_display() const {
  return state_->config->getDefaultDisplay();
}

std::string ColorManager::default_view(const std::string& display) const {
  return state_->config->getDefaultView(display.c_str());
}

Color ColorManager::to_working(const Color& value, const std::string& space) const {
  return run(state_->convert(state_->find(space), state_->working), value);
}

Color ColorManager::from_working(const Color& value, const std::string& space) const {
  return run(state_->convert(state_->working, state_->find(space)), value);
}

void ColorManager::to_working(Image& image, const std::string& space) const {
  run(state_->convert(state_->find(space), state_->working), image);
}

std::optional<std::string> ColorManager::space_of_file(const std::string& path) const {
  const ocio::Config& config = *state_->config;
  if (config.getMajorVersion() < 2 || config.filepathOnlyMatchesDefaultRule(path.c_str())) return std::nullopt;
  return std::string(config.getColorSpaceFromFilepath(path.c_str()));
}

void ColorManager::to_display(Image& image, const std::string& display, const std::string& view,
                              float exposure_ev) const {
  const State& s = *state_;
  const auto known_displays = displays();
  if (std::find(known_displays.begin(), known_displays.end(), display) == known_displays.end())
    throw InputError(fmt::format("\"{}\" is not a display of {}", display, s.text),
                     suggestion(display, known_displays));
  const auto known_views = views(display);
  if (std::find(known_views.begin(), known_views.end(), view) == known_views.end())
    throw InputError(fmt::format("\"{}\" is not a view of the display {}", view, display),
                     suggestion(view, known_views));

  const int colours = std::min(image.channels, 3);
  const float gain = std::exp2(exposure_ev);
  const size_t count = size_t(image.width) * size_t(image.height);
  for (size_t i = 0; i < count; ++i)
    for (int c = 0; c < colours; ++c) image.pixels[i * size_t(image.channels) + size_t(c)] *= gain;

  // The display transform starts in the config that owns the display.
  Space source = s.working;
  if (source.own && s.foreign()) {
    source = {false, "scene_linear"};
    run(s.convert(s.working, source), image);
  }
  const std::string what =
      fmt::format("the view {} of the display {} cannot be used under {}", view, display, s.text);
  refuse_ring(what, ring_of_view(*s.config, source.name, display, view));
  const ocio::ConstCPUProcessorRcPtr processor = guarded(what, [&] {
    return s.config->getProcessor(source.name.c_str(), display.c_str(), view.c_str(), ocio::TRANSFORM_DIR_FORWARD)
        ->getDefaultCPUProcessor();
  });
  run({processor}, image);
  for (size_t i = 0; i < count; ++i)
    for (int c = 0; c < colours; ++c) {
      float& value = image.pixels[i * size_t(image.channels) + size_t(c)];
      value = value > 0 ? std::min(value, 1.0f) : 0.0f;
    }
}

std::optional<ColorManager::Chromaticities> ColorManager::working_chromaticities() const {
  if (!state_->bridge.known && !state_->working.own) return std::nullopt;
  const Steps steps = state_->convert(state_->working, {true, "aces2065-1"});
  Matrix3 to_aces;
  for (int column = 0; column < 3; ++column) {
    Color unit(0, 0, 0);
    unit[column] = 1;
    const Color aces = run(steps, unit);
    for (int row = 0; row < 3; ++row) to_aces[row][column] = double(aces[row]);
  }
  return chromaticities_of(to_aces);
}

Color ColorManager::luminance_weights() const {
  const Steps steps = state_->convert(state_->working, {true, "cie_xyz_d65"});
  Color weights;
  for (int channel = 0; channel < 3; ++channel) {
    Color unit(0, 0, 0);
    unit[channel] = 1;
    weights[channel] = run(steps, unit).y;
  }
  return weights;
}

void ColorManager::chromaticities_to_working(Image& image, const Chromaticities& from) const {
  if (image.channels < 3) return;
  // Where the config in force has the space itself, its numbers and its name mean the same light.
  if (const char* name = name_of(from); name && state_->foreign() && state_->config->getColorSpace(name))
    return to_working(image, name);
  const Matrix3 m = to_aces2065_1(from);
  const size_t count = size_t(image.width) * size_t(image.height);
  for (size_t i = 0; i < count; ++i) {
    float* p = image.pixels.data() + i * size_t(image.channels);
    const double rgb[3] = {p[0], p[1], p[2]};
    for (int row = 0; row < 3; ++row) p[row] = float(m[row][0] * rgb[0] + m[row][1] * rgb[1] + m[row][2] * rgb[2]);
  }
  run(state_->convert({true, "aces2065-1"}, state_->working), image);
}

void hear_color_messages(std::function<void(const std::string& message)> hear) {
  ocio::SetLoggingFunction([hear = std::move(hear)](const char* text) {
    std::string message = text;
    // "[OpenColorIO Warning]: Unknown key ..."
    if (const size_t end = message.find("]: "); message.starts_with('[') && end != std::string::npos)
      message.erase(0, end + 3);
    while (message.ends_with('\n')) message.pop_back();
    if (!message.empty()) hear(message);
  });
}

}  // namespace sateen
