#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/error.h"
#include "base/parallel.h"
#include "film/develop.h"
#include "mesh/subdivide.h"
#include "render/candidates.h"
#include "study/cost.h"
#include "study/work_clock.h"

namespace sateen {

namespace {

constexpr int reference_factor = 8;
constexpr double plan_error = 0.01;  // that of the best quality that is recommended
constexpr std::uint32_t reference_seed = 900001, pair_seed = 700001;

bool same_bits(const Film& a, const Film& b) {
  return std::equal(a.pixels.begin(), a.pixels.end(), b.pixels.begin(), b.pixels.end(),
                    [](const FilmPixel& p, const FilmPixel& q) { return p.beauty == q.beauty; });
}

class CostMeasurement {
 public:
  CostMeasurement(const CostSettings& settings, const ColorManager& colors,
                  const std::function<void(const StudyState&)>& observe, const std::atomic<bool>* interrupt)
      : colors_(colors), observe_(observe), clock_(1, interrupt) {
    result_.settings = settings;
  }

  CostResult run() {
    const double cpu_start = cpu_seconds();
    prepare();
    measure_points();
    measure_bounces();
    measure_levels();
    for (const Approximation& each : approximation_list()) measure_approximation(each);
    measure_strategies();
    measure_candidates();
    make_out_bill();
    settle_advice(result_);
    result_.interrupted = clock_.stopped();
    result_.cpu_seconds = cpu_seconds() - cpu_start;
    return std::move(result_);
  }

 private:
  struct Pair {
    Film a, b;
    double cpu_seconds = 0, noise = 0;
  };

  // The level is that of the picture as asked, not of the small one that is measured.
  void prepare() {
    const CostSettings& s = result_.settings;
    tell("the scene");
    SceneReport report;
    scene_ = assemble_scene(s.scene, colors_, report);
    result_.warnings = report.warnings;
    result_.level = report.level;
    LightSettings& light = result_.settings.light;
    exposure_ = s.exposure_ev.value_or(report.metered_ev);
    const double floor = error_floor_at(double(exposure_));
    result_.plan =
        make_plan(scene_, report.look, {s.effects, plan_error, floor, light, std::uint32_t(s.seed), s.threads});
    apply_plan(result_.plan, scene_, light);
    settle_candidates(scene_, s.effects.candidates, light, floor, s.seed, s.threads);
    const double pixels = double(s.scene.width) * s.scene.height, share = std::min(1.0, s.pixels / pixels);
    result_.width = std::max(16, int(std::lround(s.scene.width * std::sqrt(share))));
    result_.height = std::max(16, int(std::lround(s.scene.height * std::sqrt(share))));
    result_.scale = pixels / (double(result_.width) * result_.height);
    small_ = s.scene;
    small_.level = report.level;
    small_.width = result_.width;
    small_.height = result_.height;
    scene_.camera = frame_points(scene_.mesh->positions, small_.camera, small_.width, small_.height);
    // Samples a pixel, roughly; bounces and levels cost about twice a plain one.
    clock_.plan(s.seeds * 2.0 * s.most_samples + reference_factor * s.most_samples + s.price_samples * 2.0 * 45);
  }

  void tell(const std::string& doing) {
    if (observe_) observe_({clock_.fraction(), clock_.seconds_left(), doing});
  }

  RenderResult render_film(const Scene& scene, const LightSettings& light, int samples, std::uint32_t seed,
                           Film& film) {
    RenderSettings settings;
    settings.light = light;
    settings.stop.spp = samples;
    settings.seed = seed;
    settings.threads = result_.settings.threads;
    settings.albedo_layer = false;
    const RenderResult done = render(scene, settings, film, {}, clock_.interrupt());
    clock_.done(samples);
    return done;
  }

  Film empty_film() const { return {result_.width, result_.height, false}; }

  Image shown(const Film& film) const {
    return develop_display(develop_beauty(film), colors_, result_.settings.display, exposure_);
  }

  void measure_points() {
    const CostSettings& s = result_.settings;
    tell("the reference");
    Film truth = empty_film();
    result_.reference_samples = reference_factor * s.most_samples;
    render_film(scene_, s.light, result_.reference_samples, reference_seed, truth);
    if (clock_.stopped()) return;
    reference_ = make_reference(truth, result_.reference_samples);
    result_.reference_error = reference_.own;
    std::vector<PlotPoint> curve;
    for (int samples = replicates; samples <= s.most_samples; samples *= 2) {
      tell(fmt::format("error at {} samples", samples));
      CostPoint point;
      point.samples = samples;
      std::vector<double> squares;
      for (int k = 0; k < s.seeds; ++k) {
        Film film = empty_film();
        const RenderResult done = render_film(scene_, s.light, samples, s.seed + std::uint32_t(k), film);
        if (clock_.stopped()) return;
        squares.push_back(mse_against(film, reference_).relative);
        // Another program's load adds to times and never takes away.
        const double seconds = done.cpu_seconds * result_.scale;
        point.cpu_seconds = k == 0 ? seconds : std::min(point.cpu_seconds, seconds);
        point.claimed_error += done.error.error / s.seeds;
        if (k == 0) result_.ladder_pictures.emplace_back(fmt::format("{} samples", samples), shown(film));
      }
      point.true_error = jackknife_interval(s.seeds, [&](int without) {
        double sum = 0;
        for (int k = 0; k < s.seeds; ++k) sum += k + 1 == without ? 0 : squares[size_t(k)];
        return std::log(sum / (s.seeds - (without > 0 ? 1 : 0))) / 2;
      });
      result_.points.push_back(point);
      curve.push_back({point.cpu_seconds, point.true_error.value});
    }
    result_.fit = fit_power(curve);
    result_.ladder_pictures.emplace_back(fmt::format("reference, {} samples", result_.reference_samples),
                                         shown(truth));
  }

  Pair render_pair(const Scene& scene, const LightSettings& light) {
    Pair pair{empty_film(), empty_film()};
    for (Film* film : {&pair.a, &pair.b}) {
      const RenderResult done = render_film(scene, light, result_.settings.price_samples,
                                            film == &pair.a ? pair_seed : pair_seed + 1, *film);
      const double seconds = done.cpu_seconds * result_.scale;
      pair.cpu_seconds = film == &pair.a ? seconds : std::min(pair.cpu_seconds, seconds);
      pair.noise += done.error.error / 2;
    }
    return pair;
  }

  /// One setting to be priced.
  struct Step {
    std::string setting;
    std::vector<std::string> flags = {};
    bool asked = false;
    LightSettings light;
    std::function<void(Scene&)> make = {};  ///< changes a copy of the scene
  };

  /// Renders a pair at every step, the last of which is the finest, and keeps the list where it is whole.
  void measure_list(PriceList list, const std::vector<Step>& steps) {
    std::vector<Pair> pairs;
    for (const Step& step : steps) {
      if (clock_.stopped()) return;
      tell(list.name + " " + step.setting);
      Price price;
      price.setting = step.setting + (step.asked ? " (asked)" : "");
      price.flags = step.flags;
      if (step.make) {
        Scene scene = scene_;
        const double start = cpu_seconds();
        try {
          step.make(scene);
        } catch (const InputError& error) {
          list.note += fmt::format("; {} is not possible here: {}", step.setting, error.diagnostics[0].message);
          continue;
        }
        price.setup_seconds = cpu_seconds() - start;
        pairs.push_back(render_pair(scene, step.light));
      } else {
        pairs.push_back(render_pair(scene_, step.light));
      }
      list.prices.push_back(std::move(price));
    }
    if (clock_.stopped() || pairs.size() < 2) return;
    // The same bits are the same work: only chance makes their times differ.
    for (size_t i = 1; i < pairs.size(); ++i)
      if (same_bits(pairs[i - 1].a, pairs[i].a))
        pairs[i].cpu_seconds = std::min(pairs[i].cpu_seconds, pairs[i - 1].cpu_seconds);
    for (size_t i = pairs.size() - 1; i > 0; --i)
      if (same_bits(pairs[i - 1].a, pairs[i].a)) pairs[i - 1].cpu_seconds = pairs[i].cpu_seconds;
    for (size_t i = 0; i < pairs.size(); ++i) {
      const Pair& pair = pairs[i];
      Price& price = list.prices[i];
      price.cpu_seconds = pair.cpu_seconds;
      // Of settings that converge to the same picture the true error: what they claim of themselves is too little
      // where light is met by rare samples, as a sun is by uniform ones.
      price.noise = list.biased ? pair.noise : true_error(pair);
      if (list.has_finest && i + 1 < pairs.size())
        price.bias = measure_bias({pair.a, pair.b}, {pairs.back().a, pairs.back().b}, colors_,
                                  result_.settings.display, exposure_);
      price.picture = shown(pair.a);
    }
    result_.lists.push_back(std::move(list));
  }

  double true_error(const Pair& pair) const {
    return std::sqrt((mse_against(pair.a, reference_).relative + mse_against(pair.b, reference_).relative) / 2);
  }

  void measure_bounces() {
    const int own = result_.settings.light.bounces;
    std::vector<int> numbers{0, 1, 2, 4};
    if (own <= numbers.back()) numbers.push_back(8);  // else its own are the finest
    if (std::find(numbers.begin(), numbers.end(), own) == numbers.end()) numbers.push_back(own);
    std::sort(numbers.begin(), numbers.end());
    std::vector<Step> steps;
    for (const int bounces : numbers) {
      steps.push_back({fmt::format("{}", bounces),
                       {fmt::format("--bounces {}", bounces)},
                       bounces == own,
                       result_.settings.light});
      steps.back().light.bounces = bounces;
    }
    measure_list({"bounces"}, steps);
  }

  void measure_strategies() {
    PriceList list{"strategy"};
    list.biased = list.has_finest = false;
    list.note = "all converge to the same picture: true error squared times time decides";
    std::vector<Step> steps;
    for (const std::string& name : strategy_names()) {
      LightSettings light = result_.settings.light;
      light.strategy = strategy_from_name(name);
      steps.push_back({name, {"--strategy " + name}, light.strategy == result_.settings.light.strategy, light});
    }
    measure_list(std::move(list), steps);
  }

  void measure_candidates() {
    const bool own = result_.settings.light.strategy == Strategy::resampled;
    PriceList list{"candidates"};
    list.biased = list.advised = false;
    list.note = "of strategy resampled; true error squared times time decides";
    std::vector<Step> steps;
    const CandidateCounts settled = result_.settings.light.candidates;
    std::vector<CandidateCounts> counts{1, 2, 4, 8, 16};
    if (own && std::find(counts.begin(), counts.end(), settled) == counts.end()) counts.push_back(settled);
    for (const CandidateCounts& each : counts) {
      LightSettings light = result_.settings.light;
      light.strategy = Strategy::resampled;
      light.candidates = each;
      const std::string text = candidates_text(each);
      steps.push_back({text, {"--strategy resampled", "--candidates " + text}, own && each == settled, light});
    }
    measure_list(std::move(list), steps);
  }

  void measure_levels() {
    constexpr std::int64_t most_triangles = 6'000'000;
    int finest = result_.level;
    std::int64_t triangles = scene_.mesh->triangles();
    while (finest < finest_level && finest < result_.level + 2 && 4 * triangles <= most_triangles)
      ++finest, triangles *= 4;
    std::vector<Step> steps;
    for (int level = std::max(0, finest - 4); level <= finest; ++level)
      steps.push_back({fmt::format("{}", level),
                       {fmt::format("--level {}", level)},
                       level == result_.level,
                       result_.settings.light,
                       [this, level](Scene& scene) {
                         SceneSettings settings = small_;
                         settings.level = level;
                         SceneReport report;
                         const Camera camera = scene.camera;  // one framing for all
                         scene = assemble_scene(settings, colors_, report);
                         scene.camera = camera;
                         follow_plan(scene);
                       }});
    measure_list({"subdivision level"}, steps);
  }

  void measure_approximation(const Approximation& each) {
    const Approximations& own = small_.approximations;
    PriceList list{each.name};
    list.biased = each.biased;
    list.advised = each.advised;
    list.note = each.note;
    std::vector<Step> steps;
    for (const std::string& text : each.ladder(own, scene_)) {
      SceneSettings settings = small_;
      each.read(text, settings.approximations);
      Step step{text, {}, text == each.text(own), result_.settings.light};
      if (text != each.text({})) step.flags = {each.flag + " " + text};
      step.make = [this, settings, &each](Scene& scene) {
        each.rebuild(settings, colors_, scene);
        follow_plan(scene);
      };
      steps.push_back(std::move(step));
    }
    measure_list(std::move(list), steps);
  }

  void follow_plan(Scene& scene) const {
    LightSettings planned = result_.settings.light;
    apply_plan(result_.plan, scene, planned);
  }

  void make_out_bill() {
    if (clock_.stopped()) return;
    tell("the bill of effects");
    const CostSettings& s = result_.settings;
    BillSettings settings;
    settings.display = s.display;
    settings.exposure_ev = exposure_;
    settings.columns = 128;
    result_.bill = make_bill(scene_, result_.plan, s.light, settings, colors_, s.seed, s.threads);
  }

  const ColorManager& colors_;
  const std::function<void(const StudyState&)>& observe_;
  WorkClock clock_;
  CostResult result_;
  Reference reference_;
  SceneSettings small_;
  Scene scene_;
  float exposure_ = 0;
};

}  // namespace

CostResult measure_cost(const CostSettings& settings, const ColorManager& colors,
                        const std::function<void(const StudyState&)>& observe, const std::atomic<bool>* interrupt) {
  if (settings.seeds < 2 || settings.most_samples < 2 * replicates)
    throw InputError(fmt::format("a price list wants 2 seeds and {} samples or more, has {} and {}", 2 * replicates,
                                 settings.seeds, settings.most_samples));
  return CostMeasurement(settings, colors, observe, interrupt).run();
}

}  // namespace sateen
