#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "base/parallel.h"
#include "render/candidates.h"
#include "render/render.h"
#include "study/study.h"
#include "study/study_analysis.h"
#include "study/study_pictures.h"
#include "study/work_clock.h"

namespace sateen {

namespace {

constexpr int reference_factor = 16;   // of the samples at equal time; each is worth two to four of those
constexpr double reference_price = 3;  // of one of its samples, in those at equal time
constexpr std::uint32_t reference_seed = 900001;
constexpr int ladder_looks = 2;  // the talk's: satin and silk

std::vector<Strategy> all_strategies() {
  std::vector<Strategy> all;
  for (const std::string& name : strategy_names()) all.push_back(strategy_from_name(name));
  all.push_back(Strategy::automatic);
  return all;
}

// Sample numbers at which every replicate's sequence is a power of two: there it is stratified best, and strategies
// are compared like with like.
std::vector<int> ladder_samples(int most) {
  std::vector<int> all;
  for (int n = replicates; n <= most; n *= 2) all.push_back(n);
  return all;
}

int power_below(double samples) {
  int n = replicates;
  while (2 * n <= samples) n *= 2;
  return n;
}

class Study {
 public:
  Study(const StudySettings& settings, const ColorManager& colors,
        const std::function<void(const StudyState&)>& observe, const std::atomic<bool>* interrupt)
      : colors_(colors), observe_(observe), clock_(1, interrupt) {
    result_.settings = settings;
  }

  StudyResult run() {
    const double cpu_start = cpu_seconds();
    plan();
    read_threads();
    for (int i = 0; i < int(result_.scenes.size()) && !clock_.stopped(); ++i) measure(i);
    if (result_.settings.pictures && !clock_.stopped()) take_pictures();
    result_.interrupted = clock_.stopped();
    result_.seconds = clock_.seconds();
    result_.cpu_seconds = cpu_seconds() - cpu_start;
    return std::move(result_);
  }

 private:
  SceneSettings scene_settings(const StudyScene& s) const {
    SceneSettings settings = result_.settings.scene;
    settings.look = s.look;
    settings.environment = s.light == white_light ? s.light : study_map(s.light);
    settings.threads = result_.settings.threads;
    return settings;
  }

  // The talk in its own terms: seconds, whatever the study covers.
  void read_threads() {
    const StudySettings& s = result_.settings;
    TalkFigureSettings figures;
    figures.looks.assign(s.looks.begin(),
                         s.looks.begin() + std::min<std::ptrdiff_t>(ladder_looks, std::ssize(s.looks)));
    figures.seeds = std::max(8, s.seeds);  // cheap, and uniform directions seldom meet the highlight
    figures.columns = figures.rows = std::clamp(s.scene.width / 2, 16, 96);
    figures.threads = s.threads;
    tell("single threads");
    result_.thread_rows = thread_rows(figures.looks);
    result_.talk_figures = talk_figures(
        figures, colors_, [this] { tell("the talk's figures"); }, clock_.interrupt());
    if (s.pictures && !clock_.stopped())
      result_.thread_pictures =
          thread_pictures(figures.looks[0], std::min(160, 2 * figures.columns), 16, s.threads, colors_);
  }

  void plan() {
    StudySettings& s = result_.settings;
    std::vector<std::string> lights;
    for (const std::string& light : s.lights)
      if (light == white_light || !study_map(light).empty())
        lights.push_back(light);
      else
        result_.skipped.push_back(
            fmt::format("light {} left out: no map of that name on the search path or at ../shared/hdri beside the "
                        "project",
                        light));
    s.lights = lights;
    if (lights.empty()) throw InputError("no light is left to study");
    for (size_t look = 0; look < s.looks.size(); ++look)
      for (const std::string& light : lights) {
        const bool ladder = look < ladder_looks;
        result_.scenes.push_back({s.looks[look], light, 0, true, ladder});
        if (ladder) result_.scenes.push_back({s.looks[look], light, study_bounces, false, true});
      }
    tell("the first scene");
    if (s.samples == 0) s.samples = affordable_samples();
    double units = 0;
    for (const StudyScene& scene : result_.scenes) units += units_of(scene, s.samples);
    clock_.plan(units + (s.pictures ? picture_units() : 0));
  }

  // Work in samples a pixel of the default strategy, roughly: it plans the time left, and the measured clock mends
  // it.
  double units_of(const StudyScene& scene, int samples) const {
    const double seeds = result_.settings.seeds, price = scene.bounces > 0 ? 2 : 1;
    double units = reference_units(samples);
    if (scene.all_strategies) units += seeds * double(strategy_names().size()) * 2.4 * samples;
    if (scene.ladder) units += seeds * double(ladder_strategies().size()) * ladder_top(scene, samples) * price;
    return units;
  }

  static int reference_samples(const StudyScene& scene, int samples) {
    return reference_factor * samples / (scene.bounces > 0 ? 2 : 1);
  }
  // With bounces half as many, each twice as dear.
  static double reference_units(int samples) { return reference_price * reference_factor * samples; }

  static int ladder_top(const StudyScene& scene, int samples) { return scene.bounces > 0 ? samples : 2 * samples; }

  double picture_units() const {
    const StudySettings& s = result_.settings;
    const double size = double(s.picture_width) * s.picture_height / (double(s.scene.width) * s.scene.height);
    return 2 * study_picture_units(s.samples) * size;
  }

  int affordable_samples() {
    SceneReport report;
    const Scene scene = assemble_study_scene(scene_settings(result_.scenes[0]), colors_, report);
    double price = 1e300;  // the least of three: another program's load must not change the study
    for (int i = 0; i < 3; ++i) {
      StudyRun run;
      render_film(scene, Strategy::mis_compensated, 32, 1, 0, run);
      price = std::min(price, run.cpu_seconds / 32);
    }
    for (const int samples : {64, 32, 16}) {
      double units = 0;
      result_.settings.samples = samples;
      for (const StudyScene& each : result_.scenes) units += units_of(each, samples);
      // Half a second of assembly a scene; other strategies and lights cost up to a tenth more than the default here.
      if (1.1 * price * (units + picture_units()) + 0.6 * double(result_.scenes.size()) <=
          result_.settings.cpu_seconds)
        return samples;
    }
    return 8;
  }

  Film render_film(const Scene& scene, Strategy strategy, int samples, std::uint32_t seed, int bounces,
                   StudyRun& run) {
    RenderSettings settings;
    if (strategy == Strategy::automatic)
      settings.light.candidates = candidates_;
    else
      settings.light.strategy = strategy;
    settings.adaptive = strategy == Strategy::automatic;
    settings.light.bounces = bounces;
    settings.stop.spp = samples;
    settings.seed = seed;
    settings.threads = result_.settings.threads;
    settings.albedo_layer = false;
    Film film(scene.camera.width, scene.camera.height, false);
    const RenderResult done = render(scene, settings, film, {}, clock_.interrupt());
    run.strategy = strategy;
    run.samples = samples;
    run.cpu_seconds = done.cpu_seconds;
    return film;
  }

  void tell(const std::string& doing) {
    if (observe_) observe_({clock_.fraction(), clock_.seconds_left(), doing});
  }

  void measure(int index) {
    StudyScene& s = result_.scenes[size_t(index)];
    const int at_equal_time = result_.settings.samples;
    tell(s.label());
    SceneReport report;
    const Scene scene = assemble_study_scene(scene_settings(s), colors_, report);
    s.light_share = half_light_share(scene.environment);
    if (s.all_strategies)
      s.candidates = choose_candidates(scene, {}, default_error_floor, 1, result_.settings.threads).candidates;
    candidates_ = s.candidates;
    s.reference_samples = reference_samples(s, at_equal_time);
    StudyRun ignored;
    const Film truth =
        render_film(scene, LightSettings().strategy, s.reference_samples, reference_seed, s.bounces, ignored);
    if (clock_.stopped()) return;
    const Reference reference = make_reference(truth, s.reference_samples, error_floor_at(double(report.metered_ev)));
    s.reference_error = reference.own;
    clock_.done(reference_units(at_equal_time));

    const std::vector<std::pair<Strategy, int>> list = runs_of(s, scene);
    const size_t runs_before = result_.runs.size();
    const double units = units_of(s, at_equal_time) - reference_units(at_equal_time);
    for (int seed = 1; seed <= result_.settings.seeds; ++seed)
      for (const auto& [strategy, samples] : list) {
        add_run(index, scene, reference, strategy, samples, seed);
        clock_.done(units / (double(list.size()) * result_.settings.seeds));
        tell(s.label());
      }
    if (s.all_strategies) bracket_common_time(index, scene, reference);
    s.finished = !clock_.stopped();  // a scene counts when it is whole
    if (!s.finished) result_.runs.resize(runs_before);
  }

  void add_run(int index, const Scene& scene, const Reference& reference, Strategy strategy, int samples, int seed) {
    if (clock_.stopped()) return;
    StudyRun run;
    const Film film =
        render_film(scene, strategy, samples, std::uint32_t(seed), result_.scenes[size_t(index)].bounces, run);
    run.scene = index;
    run.seed = seed;
    run.mse = mse_against(film, reference);
    result_.runs.push_back(run);
  }

  // Numbers of samples were chosen by the price that a pilot found; where the runs themselves were so much cheaper or
  // dearer that all of a strategy's lie on one side of the common time, it gets more, for no scene shall be left out.
  void bracket_common_time(int index, const Scene& scene, const Reference& reference) {
    constexpr int most_steps = 8;
    for (const Strategy strategy : all_strategies())
      for (int step = 0; step < most_steps; ++step) {
        const int samples = missing_samples(result_, index, strategy);
        if (samples == 0 || clock_.stopped()) break;
        for (int seed = 1; seed <= result_.settings.seeds; ++seed)
          add_run(index, scene, reference, strategy, samples, seed);
      }
  }

  // Strategy and samples of all renders of one seed: the ladder, and two numbers about the common time.
  std::vector<std::pair<Strategy, int>> runs_of(const StudyScene& s, const Scene& scene) {
    std::vector<std::pair<Strategy, int>> list;
    const auto add = [&](Strategy strategy, int samples) {
      if (std::find(list.begin(), list.end(), std::pair(strategy, samples)) == list.end())
        list.emplace_back(strategy, samples);
    };
    const int at_equal_time = result_.settings.samples;
    if (s.ladder)
      for (const int samples : ladder_samples(ladder_top(s, at_equal_time)))
        for (const Strategy strategy : ladder_strategies()) add(strategy, samples);
    if (!s.all_strategies) return list;
    const std::map<Strategy, double> price = prices(scene);
    for (const Strategy strategy : all_strategies()) {
      const int below = power_below(price.at(Strategy::mis_compensated) * at_equal_time / price.at(strategy));
      // What a mean sample costs is known less well where samples are dealt out by error.
      if (strategy == Strategy::automatic) add(strategy, std::max(below / 2, replicates));
      add(strategy, below);
      add(strategy, 2 * below);
    }
    // Equal samples are compared in the light that the talk was made for.
    if (s.light == white_light)
      for (const Strategy strategy : all_strategies()) add(strategy, at_equal_time);
    return list;
  }

  // CPU-seconds a sample, the smaller of two interleaved pilots.
  std::map<Strategy, double> prices(const Scene& scene) {
    const int at_equal_time = result_.settings.samples;
    std::map<Strategy, double> price;
    for (int round = 0; round < 2; ++round)
      for (const Strategy strategy : all_strategies()) {
        StudyRun run;
        // Samples are not dealt out by error before the first barriers.
        const int number = strategy == Strategy::automatic ? at_equal_time : 2 * replicates;
        render_film(scene, strategy, number, reference_seed + 1, 0, run);
        const double each = run.cpu_seconds / run.samples;
        price[strategy] = round == 0 ? each : std::min(price[strategy], each);
      }
    return price;
  }

  void take_pictures() {
    std::vector<int> chosen;
    const auto want = [&](size_t look, const std::string& light) {
      for (int i = 0; i < int(result_.scenes.size()); ++i) {
        const StudyScene& s = result_.scenes[size_t(i)];
        if (s.bounces == 0 && s.finished && look < result_.settings.looks.size() &&
            s.look == result_.settings.looks[look] && (light.empty() || s.light == light) &&
            std::find(chosen.begin(), chosen.end(), i) == chosen.end()) {
          chosen.push_back(i);
          return;
        }
      }
    };
    want(0, "studio_softboxes");
    want(1, "low_sun");
    want(0, "");
    if (chosen.size() > 2) chosen.resize(2);
    for (const int i : chosen) {
      tell("pictures of " + result_.scenes[size_t(i)].label());
      SceneSettings settings = scene_settings(result_.scenes[size_t(i)]);
      settings.width = result_.settings.picture_width;
      settings.height = result_.settings.picture_height;
      for (StudyPicture& picture : study_pictures(settings, colors_, result_.settings.samples, clock_.interrupt())) {
        picture.scene = i;
        result_.pictures.push_back(std::move(picture));
      }
      clock_.done(picture_units() / 2);
      if (clock_.stopped()) return;
    }
  }

  const ColorManager& colors_;
  const std::function<void(const StudyState&)>& observe_;
  WorkClock clock_;
  StudyResult result_;
  CandidateCounts candidates_ = LightSettings().candidates;  ///< of the scene that is being measured
};

}  // namespace

std::string StudyScene::label() const {
  return fmt::format("{}, {}{}", look, light_label(light), bounces > 0 ? fmt::format(", {} bounces", bounces) : "");
}

const std::vector<Strategy>& ladder_strategies() {
  static const std::vector<Strategy> all{Strategy::uniform, Strategy::talk, Strategy::table};
  return all;
}

StudyResult run_study(const StudySettings& settings, const ColorManager& colors,
                      const std::function<void(const StudyState&)>& observe, const std::atomic<bool>* interrupt) {
  if (settings.seeds < 2)
    throw InputError(
        fmt::format("a study has {} seed, expected 2 or more: intervals come from them", settings.seeds));
  if (settings.looks.empty()) throw InputError("no look is left to study");
  return Study(settings, colors, observe, interrupt).run();
}

}  // namespace sateen
