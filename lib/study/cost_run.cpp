#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/error.h"
#include "base/parallel.h"
#include "film/develop.h"
#include "mesh/subdivide.h"
#include "render/pilot.h"
#include "study/cost.h"
#include "study/environment_size.h"
#include "study/work_clock.h"

namespace sateen {

namespace {

constexpr int reference_factor = 8;
constexpr double plan_error = 0.01;  // that of the best quality that is recommended
constexpr std::uint32_t reference_seed = 900001, pair_seed = 700001;

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
    measure_environment();
    measure_strategies();
    measure_candidates();
    measure_levels();
    make_out_bill();
    result_.fixed = {
        "tangent quadrature: its number of points follows from the lobes' widths and is no setting of this version",
        "direction table: its size is fixed in this version",
        "pixel filter: Blackman-Harris over 3 x 3 pixels is the only one of this version"};
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
    result_.plan = make_plan(scene_, report.look, s.effects, plan_error, light, s.seed, s.threads);
    apply_plan(result_.plan, scene_, light);
    if (light.strategy == Strategy::automatic)
      light.strategy = choose_strategy(scene_, light, s.seed, s.threads).strategy;
    exposure_ = s.exposure_ev.value_or(report.metered_ev);
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
    clock_.plan(s.seeds * 2.0 * s.most_samples + reference_factor * s.most_samples + s.price_samples * 2.0 * 40);
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
        point.cpu_seconds += done.cpu_seconds * result_.scale / s.seeds;
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
      pair.cpu_seconds += done.cpu_seconds * result_.scale / 2;
      pair.noise += done.error.error / 2;
    }
    return pair;
  }

  Price price_of(const std::string& setting, std::vector<std::string> flags, const Pair& pair, const Pair* fine) {
    Price price;
    price.setting = setting;
    price.flags = std::move(flags);
    price.cpu_seconds = pair.cpu_seconds;
    price.noise = pair.noise;
    if (fine)
      price.bias = measure_bias({pair.a, pair.b}, {fine->a, fine->b}, colors_, result_.settings.display, exposure_);
    price.picture = shown(pair.a);
    return price;
  }

  // Of settings that converge to the same picture: the true error. What they claim of themselves is too little where
  // light is met by rare samples, as a sun is by uniform ones.
  Price unbiased_price(const std::string& setting, std::vector<std::string> flags, const LightSettings& light) {
    Pair pair = render_pair(scene_, light);
    pair.noise = std::sqrt((mse_against(pair.a, reference_).relative + mse_against(pair.b, reference_).relative) / 2);
    return price_of(setting, std::move(flags), pair, nullptr);
  }

  // A list is kept when it is whole.
  void keep(PriceList list) {
    if (!clock_.stopped() && list.prices.size() > 1) result_.lists.push_back(std::move(list));
  }

  static std::string asked(const std::string& text, bool is_asked) { return text + (is_asked ? " (asked)" : ""); }

  void measure_bounces() {
    PriceList list{"bounces", true, true, {}, -1, ""};
    std::vector<int> numbers{0, 1, 2, 4, 8};
    const int own = result_.settings.light.bounces;
    if (std::find(numbers.begin(), numbers.end(), own) == numbers.end()) numbers.push_back(own);
    std::sort(numbers.begin(), numbers.end());
    std::vector<Pair> pairs;
    for (const int bounces : numbers) {
      if (clock_.stopped()) return;
      tell(fmt::format("{} bounces", bounces));
      LightSettings light = result_.settings.light;
      light.bounces = bounces;
      pairs.push_back(render_pair(scene_, light));
    }
    for (size_t i = 0; i < pairs.size(); ++i)
      list.prices.push_back(price_of(asked(fmt::format("{}", numbers[i]), numbers[i] == own),
                                     {fmt::format("--bounces {}", numbers[i])}, pairs[i],
                                     i + 1 < pairs.size() ? &pairs.back() : nullptr));
    keep(std::move(list));
  }

  void measure_environment() {
    PriceList list{
        "environment size", true, false, {}, -1, "the map shrunk before use; this version has no flag for it"};
    std::vector<Pair> pairs;
    std::vector<std::string> names;
    const Environment whole = scene_.environment;
    for (const int factor : {32, 16, 8, 4, 2, 1}) {
      if (clock_.stopped()) return;
      const int width = whole.width / factor, height = whole.height / factor;
      if (width < 8 || height < 4) continue;
      tell(fmt::format("map of {} x {}", width, height));
      scene_.environment = factor > 1 ? shrink_environment(whole, width, height) : whole;
      names.push_back(asked(fmt::format("{} x {}", width, height), factor == 1));
      pairs.push_back(render_pair(scene_, result_.settings.light));
    }
    for (size_t i = 0; i < pairs.size(); ++i)
      list.prices.push_back(price_of(names[i], {}, pairs[i], i + 1 < pairs.size() ? &pairs.back() : nullptr));
    keep(std::move(list));
  }

  void measure_strategies() {
    PriceList list{"strategy", false, true,
                   {},         -1,    "all converge to the same picture: true error squared times time decides"};
    for (const std::string& name : strategy_names()) {
      if (clock_.stopped()) return;
      tell("strategy " + name);
      LightSettings light = result_.settings.light;
      light.strategy = strategy_from_name(name);
      list.prices.push_back(unbiased_price(asked(name, light.strategy == result_.settings.light.strategy),
                                           {"--strategy " + name}, light));
    }
    keep(std::move(list));
  }

  void measure_candidates() {
    const bool own = result_.settings.light.strategy == Strategy::resampled;
    PriceList list{"candidates", false, false,
                   {},           -1,    "of strategy resampled; true error squared times time decides"};
    for (const int number : {1, 2, 4, 8, 16}) {
      if (clock_.stopped()) return;
      tell(fmt::format("{} candidates", number));
      LightSettings light = result_.settings.light;
      light.strategy = Strategy::resampled;
      light.candidates = number;
      list.prices.push_back(
          unbiased_price(asked(fmt::format("{}", number), own && number == result_.settings.light.candidates),
                         {"--strategy resampled", fmt::format("--candidates {}", number)}, light));
    }
    keep(std::move(list));
  }

  void measure_levels() {
    constexpr std::int64_t most_triangles = 6'000'000;
    PriceList list{"subdivision level", true, true, {}, -1, ""};
    int finest = result_.level;
    std::int64_t triangles = scene_.mesh->triangles();
    while (finest < finest_level && (finest < result_.level + 2) && 4 * triangles <= most_triangles)
      ++finest, triangles *= 4;
    std::vector<Pair> pairs;
    std::vector<double> setups;
    std::vector<int> levels;
    for (int level = finest; level >= std::max(0, finest - 4); --level) {
      if (clock_.stopped()) return;
      tell(fmt::format("level {}", level));
      SceneSettings settings = small_;
      settings.level = level;
      SceneReport report;
      Scene scene = assemble_scene(settings, colors_, report);
      scene.camera = scene_.camera;  // one framing for all
      LightSettings planned = result_.settings.light;
      apply_plan(result_.plan, scene, planned);
      pairs.push_back(render_pair(scene, result_.settings.light));
      setups.push_back(report.mesh_seconds + report.tracer_seconds);
      levels.push_back(level);
    }
    if (clock_.stopped()) return;
    for (size_t i = pairs.size(); i-- > 0;) {
      list.prices.push_back(price_of(asked(fmt::format("{}", levels[i]), levels[i] == result_.level),
                                     {fmt::format("--level {}", levels[i])}, pairs[i], i > 0 ? &pairs[0] : nullptr));
      list.prices.back().setup_seconds = setups[i];
    }
    keep(std::move(list));
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
