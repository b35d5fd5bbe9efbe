#include "study/thread_study.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "film/develop.h"
#include "look/read.h"
#include "render/picture.h"
#include "render/render.h"
#include "study/study_scene.h"
#include "study/thread_path.h"

namespace sateen {

namespace {

constexpr const char* talk_mesh = "skirt";
constexpr std::uint32_t reference_seed = 900001;
constexpr int figure_bounces = 2, reference_factor = 24;

// Lights that a few samples know: what is left is the noise of the cloth, of which the talk speaks.
const std::vector<std::string>& figure_lights() {
  static const std::vector<std::string> all{white_light, "overcast"};
  return all;
}

Scene skirt(const std::string& look, const std::string& light, int columns, int rows, int threads,
            const ColorManager& colors, SceneReport& report) {
  SceneSettings settings;
  settings.look = look;
  settings.mesh = talk_mesh;
  settings.environment = light;
  settings.width = columns;
  settings.height = rows;
  settings.threads = threads;
  return assemble_study_scene(settings, colors, report);
}

Film render_cloth(const Scene& scene, Strategy strategy, int bounces, int samples, std::uint32_t seed, int threads,
                  const std::atomic<bool>* interrupt) {
  RenderSettings settings;
  settings.light.strategy = strategy;
  settings.light.bounces = bounces;
  settings.stop.spp = samples;
  settings.seed = seed;
  settings.threads = threads;
  settings.albedo_layer = false;
  Film film(scene.camera.width, scene.camera.height, false);
  render(scene, settings, film, {}, interrupt);
  return film;
}

using Render = std::function<Film(bool talk, int samples, std::uint32_t seed)>;

TalkRatios measure(const Reference& reference, int samples, int seeds, const Render& render) {
  std::vector<double> talk, talk_few, uniform;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto mse = [&](bool by_talk, int number) {
      return mse_against(render(by_talk, number, std::uint32_t(seed)), reference).relative;
    };
    uniform.push_back(mse(false, samples));
    talk.push_back(mse(true, samples));
    talk_few.push_back(mse(true, samples / 4));
  }
  const auto ratio = [&](const std::vector<double>& above, const std::vector<double>& below) {
    return jackknife_interval(seeds, [&](int without) {
      double top = 0, bottom = 0;
      for (int k = 0; k < seeds; ++k)
        if (k + 1 != without) top += above[size_t(k)], bottom += below[size_t(k)];
      return std::log(top / bottom);
    });
  };
  return {ratio(talk, uniform), ratio(talk_few, uniform)};
}

}  // namespace

const std::vector<double>& thread_views_deg() {
  static const std::vector<double> all{0, 30, 60, 80};
  return all;
}

std::vector<ThreadRow> thread_rows(const std::vector<std::string>& looks) {
  std::vector<ThreadRow> rows;
  for (const std::string& name : looks) {
    const Look look = read_look(name);
    for (const bool warp : {true, false}) {
      const ThreadFamily& family = warp ? look.warp : look.weft;
      if (!(family.coverage > 0)) continue;
      const Thread thread = thread_of(family);
      for (const VolumeAzimuth azimuth : {VolumeAzimuth::flat, VolumeAzimuth::cosine})
        for (const LobeChoice choice : {LobeChoice::half, LobeChoice::weight}) {
          ThreadRow row{name, warp, double(family.gamma_s_deg), double(family.gamma_v_deg), azimuth, choice, {}};
          for (const double view : thread_views_deg())
            row.ratios.push_back(
                thread_variance(thread_sampler(thread, view * std::numbers::pi / 180, azimuth, choice)).ratio());
          rows.push_back(std::move(row));
        }
    }
  }
  return rows;
}

std::vector<TalkFigure> talk_figures(const TalkFigureSettings& s, const ColorManager& colors,
                                     const std::function<void()>& tell, const std::atomic<bool>* interrupt) {
  std::vector<TalkFigure> figures;
  const auto stopped = [&] { return interrupt && interrupt->load(); };
  for (const std::string& name : s.looks)
    for (const std::string& light : figure_lights()) {
      SceneReport report;
      const Scene scene = skirt(name, light, s.columns, s.rows, s.threads, colors, report);
      const double floor = error_floor_at(double(report.metered_ev));
      for (const int bounces : {0, figure_bounces}) {
        tell();
        const int most = reference_factor * s.samples;
        ThreadPicture truth{ThreadStrategy::both, {}, {}, bounces, most, reference_seed, s.threads};
        const Reference threads = make_reference(render_threads(scene, report.look, truth), most, floor);
        const Reference cloth = make_reference(
            render_cloth(scene, LightSettings().strategy, bounces, most, reference_seed, s.threads, interrupt), most,
            floor);
        TalkFigure figure{name, light, bounces, {}, {}};
        figure.threads = measure(threads, s.samples, s.seeds, [&](bool talk, int samples, std::uint32_t seed) {
          ThreadPicture picture{
              talk ? ThreadStrategy::talk : ThreadStrategy::uniform, {}, {}, bounces, samples, seed, s.threads};
          return render_threads(scene, report.look, picture);
        });
        figure.cloth = measure(cloth, s.samples, s.seeds, [&](bool talk, int samples, std::uint32_t seed) {
          return render_cloth(scene, talk ? Strategy::talk : Strategy::uniform, bounces, samples, seed, s.threads,
                              interrupt);
        });
        if (stopped()) return figures;
        figures.push_back(figure);
      }
    }
  return figures;
}

std::vector<std::pair<std::string, Image>> thread_pictures(const std::string& look, int size, int samples,
                                                           int threads, const ColorManager& colors) {
  SceneReport report;
  const Scene scene = skirt(look, white_light, size, size, threads, colors, report);
  const DisplaySettings display = settle_display({}, colors);
  std::vector<std::pair<std::string, Image>> pictures;
  const auto take = [&](const std::string& label, ThreadStrategy strategy, int number) {
    const ThreadPicture picture{strategy, {}, {}, 0, number, 1, threads};
    const Film film = render_threads(scene, report.look, picture);
    pictures.emplace_back(fmt::format("{}, {} samples", label, number),
                          develop_display(develop_beauty(film), colors, display, report.metered_ev));
  };
  take("uniform", ThreadStrategy::uniform, samples);
  take("the talk's", ThreadStrategy::talk, samples);
  take("reference", ThreadStrategy::both, 8 * samples);
  return pictures;
}

}  // namespace sateen
