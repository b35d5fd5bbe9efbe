#include "study/study_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "film/develop.h"
#include "render/picture.h"
#include "render/render.h"

namespace sateen {

namespace {
constexpr int reference_factor = 16;

const std::vector<Strategy>& pictured() {
  static const std::vector<Strategy> all = [] {
    std::vector<Strategy> list{Strategy::uniform, Strategy::talk, Strategy::table, Strategy::mis_talk};
    const Strategy ours = LightSettings().strategy;
    if (std::find(list.begin(), list.end(), ours) == list.end()) list.push_back(ours);
    return list;
  }();
  return all;
}

int picture_samples(int samples) {
  return std::max(replicates, samples / 4);
}
}  // namespace

double study_picture_units(int samples) {
  return picture_samples(samples) * (2 * double(pictured().size()) + reference_factor);
}

std::vector<StudyPicture> study_pictures(const SceneSettings& settings, const ColorManager& colors, int samples,
                                         const std::atomic<bool>* interrupt) {
  SceneReport report;
  const Scene scene = assemble_study_scene(settings, colors, report);
  const DisplaySettings display = settle_display({}, colors);
  const Strategy ours = LightSettings().strategy;
  const int number = picture_samples(samples);
  std::vector<StudyPicture> pictures;
  const auto take = [&](Strategy strategy, int spp, bool equal_time, bool reference) {
    RenderSettings render_settings;
    render_settings.light.strategy = strategy;
    render_settings.stop.spp = spp;
    render_settings.seed = reference ? 900001 : 1;
    render_settings.threads = settings.threads;
    render_settings.albedo_layer = false;
    Film film(scene.camera.width, scene.camera.height, false);
    const RenderResult result = render(scene, render_settings, film, {}, interrupt);
    if (result.reason == StopReason::interrupted) return result;
    StudyPicture picture;
    picture.label = reference ? fmt::format("reference, {} samples", spp)
                              : fmt::format("{}, {} samples", strategy_name(strategy), spp);
    picture.equal_time = equal_time;
    picture.reference = reference;
    picture.image = develop_display(develop_beauty(film), colors, display, report.metered_ev);
    pictures.push_back(std::move(picture));
    return result;
  };
  const auto stopped = [&] { return interrupt && interrupt->load(); };
  double time = 0;
  std::vector<double> price;
  for (const Strategy strategy : pictured()) {
    if (stopped()) return pictures;
    price.push_back(take(strategy, number, false, false).cpu_seconds / number);
    if (strategy == ours) time = price.back() * number;
  }
  for (size_t i = 0; i < pictured().size() && !stopped(); ++i)
    take(pictured()[i], pictured()[i] == ours ? number : std::max(1, int(std::lround(time / price[i]))), true, false);
  if (!stopped()) take(ours, number * reference_factor, false, true);
  return pictures;
}

}  // namespace sateen
