#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/error.h"
#include "base/parallel.h"
#include "film/develop.h"
#include "render/quality.h"
#include "study/cost.h"
#include "study/cost_steps.h"
#include "study/render_start.h"
#include "study/work_clock.h"

namespace sateen {

namespace {
constexpr int reference_factor = 8;
constexpr double plan_error = named_qualities[2].error;  // of the best quality that is recommended

enum class Part : std::uint32_t { reference, finest, points, prices, recommended };

class CostMeasurement {
 public:
  CostMeasurement(const CostSettings& settings, const ColorManager& colors,
                  const std::function<void(const StudyState&)>& observe, const std::atomic<bool>* interrupt)
      : colors_(colors), observe_(observe), clock_(1, interrupt) {
    result_.settings = settings;
    effects_ = settings.effects;
    request_light_ = settings.light;
  }

  CostResult run() {
    const double cpu_start = cpu_seconds();
    prepare();
    measure_points();
    if (!clock_.stopped()) {
      const CostBase base{small_,
                          result_.settings.light,
                          result_.plan,
                          described_,
                          scene_,
                          look_,
                          effects_,
                          most_bounces_,
                          result_.error_floor,
                          result_.settings.seed,
                          result_.settings.threads,
                          colors_};
      std::vector<CostSteps> all = cost_steps(base);
      for (CostSteps& each : all) measure_list(each);
      set_time_factors();
      make_out_bill();
      settle_advice(result_);
      measure_advice(all);
    }
    result_.interrupted = clock_.stopped();
    result_.cpu_seconds = cpu_seconds() - cpu_start;
    return std::move(result_);
  }

 private:
  // The level is that of the picture as asked, not of the small one that is measured.
  void prepare() {
    const CostSettings& s = result_.settings;
    tell("the scene");
    const double pixels = double(s.scene.width) * s.scene.height, share = std::min(1.0, s.pixels / pixels);
    result_.width = std::max(16, int(std::lround(s.scene.width * std::sqrt(share))));
    result_.height = std::max(16, int(std::lround(s.scene.height * std::sqrt(share))));
    result_.scale = pixels / (double(result_.width) * result_.height);
    SceneReport report;
    described_ = assemble_scene(s.scene, colors_, report);
    look_ = report.look;
    result_.warnings = report.warnings;
    result_.level = report.level;
    exposure_ = s.exposure_ev.value_or(report.metered_ev);
    result_.error_floor = error_floor_at(double(exposure_));
    const auto plan = [&](double error) {
      return make_plan(described_, look_, {effects_, error, result_.error_floor, s.light, s.seed, s.threads});
    };
    const Plan finest = plan(plan_error);
    most_bounces_ = finest.bounces;
    result_.effects_flags = effects_flags_of(finest, plan(0), effects_);
    std::vector<double> assembly, pilots, albedo;
    for (int k = 0; k < s.seeds && (k == 0 || !clock_.stopped()); ++k) {
      RenderStart start = start_render(s.scene, effects_, s.light, result_.error_floor, s.seed, s.threads, colors_);
      assembly.push_back(start.assembly_seconds);
      pilots.push_back(start.pilot_seconds);
      if (s.layers && s.albedo_layer) albedo.push_back(albedo_table_seconds(start.scene, s.threads));
      if (k > 0) continue;
      scene_ = std::move(start.scene);
      result_.plan = std::move(start.plan);
      result_.settings.light = start.light;
    }
    result_.start.program = {s.program_seconds, s.program_seconds, s.program_seconds};
    if (!assembly.empty()) result_.start.assembly = repeated_interval(assembly);
    if (!pilots.empty()) result_.start.pilots = repeated_interval(pilots);
    if (!albedo.empty()) result_.start.albedo_table = repeated_interval(albedo);
    small_ = s.scene;
    small_.level = report.level;
    small_.width = result_.width, small_.height = result_.height;
    frame_small(scene_);
    // In samples a pixel, roughly.
    constexpr double steps = 45;
    clock_.plan(s.seeds * 2.0 * s.most_samples + 2.0 * reference_factor * s.most_samples +
                s.price_samples * s.seeds * steps + s.seeds * 6.0 * s.most_samples);
  }

  void frame_small(Scene& scene) const {
    scene.camera = frame_points(scene.mesh->positions, small_.camera, small_.width, small_.height);
    if (scene.ground || scene.lens) set_stage(scene, small_.stage, result_.settings.threads);
  }

  void tell(const std::string& doing) {
    if (observe_) observe_({clock_.fraction(), clock_.seconds_left(), doing});
  }

  // Every part and repetition has samples of its own, and all of them follow the seed that is asked for.
  std::uint32_t seed_of(Part part, int repetition) const {
    std::uint32_t mixed = result_.settings.seed * 0x9e3779b9u + std::uint32_t(part) * 0x85ebca6bu;
    mixed ^= mixed >> 15;
    return mixed * 0x2c1b3c6du + std::uint32_t(repetition);
  }

  RenderResult render_film(const Scene& scene, const LightSettings& light, int samples, std::uint32_t seed,
                           Film& film) {
    RenderSettings settings;
    settings.light = light;
    settings.stop.spp = samples;
    settings.seed = seed;
    settings.threads = result_.settings.threads;
    settings.error_floor = result_.error_floor;
    settings.albedo_layer = false;  // its table is a part of the start
    const RenderResult done = render(scene, settings, film, {}, clock_.interrupt());
    clock_.done(samples);
    return done;
  }

  Film empty_film() const { return {result_.width, result_.height, result_.settings.layers}; }

  Image shown(const Film& film) const {
    return develop_display(develop_beauty(film), colors_, result_.settings.display, exposure_);
  }

  Interval whole(const Interval& samples, double start) const {
    const double value = samples.value + start, more = result_.start.scatter();
    return {value, value - std::hypot(samples.value - samples.low, more),
            value + std::hypot(samples.high - samples.value, more)};
  }

  void measure_points() {
    const CostSettings& s = result_.settings;
    tell("the reference");
    Film truth = empty_film();
    result_.reference_samples = reference_factor * s.most_samples;
    render_film(scene_, s.light, result_.reference_samples, seed_of(Part::reference, 0), truth);
    if (clock_.stopped()) return;
    reference_ = make_reference(truth, result_.reference_samples, result_.error_floor);
    result_.reference_error = reference_.own;
    result_.start.writing = writing_interval(truth, result_.scale, s.seeds, s.display, exposure_, colors_, s.threads);
    std::vector<std::vector<double>> times;
    for (int samples = replicates; samples <= s.most_samples; samples *= 2) {
      tell(fmt::format("error at {} samples", samples));
      CostPoint point;
      point.samples = samples;
      std::vector<double> squares, seconds;
      for (int k = 0; k < s.seeds; ++k) {
        Film film = empty_film();
        const RenderResult done = render_film(scene_, s.light, samples, seed_of(Part::points, k), film);
        if (clock_.stopped()) return set_point_times(times);
        squares.push_back(mse_against(film, reference_).relative);
        seconds.push_back(done.cpu_seconds * result_.scale);
        point.claimed_error += done.error.error / s.seeds;
        if (k == 0) result_.ladder_pictures.emplace_back(fmt::format("{} samples", samples), shown(film));
      }
      point.noise = error_interval(squares);
      times.push_back(seconds);
      result_.points.push_back(point);
    }
    set_point_times(times);
    result_.ladder_pictures.emplace_back(fmt::format("reference, {} samples", result_.reference_samples),
                                         shown(truth));
  }

  void set_point_times(const std::vector<std::vector<double>>& times) {
    std::vector<PlotPoint> curve;
    const std::vector<Interval> pooled = pooled_intervals(times);
    for (size_t i = 0; i < times.size(); ++i) {
      curve.push_back({pooled[i].value, result_.points[i].noise.value});
      result_.points[i].cpu_seconds = whole(pooled[i], result_.start.seconds());
    }
    result_.fit = fit_power(curve);
  }

  /// What a step was measured as, a repetition a place.
  struct Measured {
    std::shared_ptr<Scene> scene;  ///< empty: that of the picture
    double make_seconds = 0;
    std::vector<double> seconds, noise;  ///< of the samples, of the whole picture; E
    Film a, b;                           ///< of the first two repetitions
  };

  // What is quick is timed again and again: the first time pays for what the others find in the caches.
  double make_scene(const CostStep& step, Measured& m) const {
    std::vector<double> seconds;
    for (int k = 0; k < result_.settings.seeds; ++k) {
      m.scene = std::make_shared<Scene>(scene_);
      const double start = cpu_seconds();
      step.make(*m.scene);
      seconds.push_back(std::max(cpu_seconds() - start, 1e-9));
      if (seconds.back() > 0.5) break;
    }
    return repeated_interval(seconds).value;
  }

  /// Renders all steps of a list side by side, repetition after repetition, and keeps the list where it is whole.
  void measure_list(CostSteps& work) {
    PriceList& list = work.list;
    std::vector<Measured> all;
    std::vector<CostStep> steps;
    for (const CostStep& step : work.steps) {
      if (clock_.stopped()) return;
      tell(list.name + " " + step.setting);
      Measured m;
      try {
        if (step.make) m.make_seconds = make_scene(step, m);
      } catch (const InputError& error) {
        list.note += fmt::format("; {} is not possible here: {}", step.setting, error.diagnostics[0].message);
        continue;
      }
      all.push_back(std::move(m));
      steps.push_back(step);
    }
    work.steps = steps;
    if (steps.size() < 2) return;
    const CostSettings& s = result_.settings;
    for (int k = 0; k < s.seeds; ++k)
      for (size_t i = 0; i < steps.size(); ++i) {
        tell(list.name + " " + steps[i].setting);
        Film film = empty_film();
        const RenderResult done = render_film(all[i].scene ? *all[i].scene : scene_, steps[i].light, s.price_samples,
                                              seed_of(Part::prices, k), film);
        if (clock_.stopped()) return;
        all[i].seconds.push_back(done.cpu_seconds * result_.scale);
        // Of settings that converge to the same picture the true error: what they claim of themselves is too little
        // where light is met by rare samples, as a sun is by uniform ones.
        all[i].noise.push_back(list.biased ? done.error.error : std::sqrt(mse_against(film, reference_).relative));
        if (k < 2) (k == 0 ? all[i].a : all[i].b) = std::move(film);
      }
    set_prices(list, steps, all);
    result_.lists.push_back(list);
  }

  void set_prices(PriceList& list, const std::vector<CostStep>& steps, std::vector<Measured>& all) {
    // The same bits are the same work: only chance makes their times differ.
    for (size_t i = 0; i < all.size(); ++i)
      for (size_t j = 0; j < i; ++j)
        if (same_bits(all[i].a, all[j].a)) {
          all[i].seconds = all[j].seconds;
          break;
        }
    size_t own = all.size() - 1;  // stands for what is asked for where that is not in the list
    for (size_t i = 0; i < steps.size(); ++i)
      if (steps[i].asked) own = i;
    const auto ratios = [](const std::vector<double>& of, const std::vector<double>& base) {
      std::vector<double> found;
      for (size_t k = 0; k < of.size(); ++k) found.push_back(of[k] / base[k]);
      return found;
    };
    for (size_t i = 0; i < all.size(); ++i) {
      Price p;
      p.setting = steps[i].setting;
      p.flags = steps[i].flags;
      p.asked = steps[i].asked;
      p.start_seconds = std::max(result_.start.seconds() + all[i].make_seconds - all[own].make_seconds, 0.0);
      seconds_.push_back(all[i].seconds);
      if (i != own && all[i].seconds != all[own].seconds) {
        time_ratios_.push_back(ratios(all[i].seconds, all[own].seconds));
        timed_.emplace_back(result_.lists.size(), i);
      }
      p.noise_factor = repeated_interval(ratios(all[i].noise, all[own].noise));
      p.noise = repeated_interval(all[i].noise).value;
      if (list.has_finest && i + 1 < all.size())
        p.bias = measure_bias({all[i].a, all[i].b}, {all.back().a, all.back().b}, colors_, result_.settings.display,
                              exposure_);
      p.picture = shown(all[i].a);
      list.prices.push_back(std::move(p));
    }
  }

  // Times scatter alike whatever is timed, by what else the machine does.
  void set_time_factors() {
    const std::vector<Interval> factors = pooled_intervals(time_ratios_);
    for (size_t i = 0; i < factors.size(); ++i)
      result_.lists[timed_[i].first].prices[timed_[i].second].time_factor = factors[i];
    const std::vector<Interval> seconds = pooled_intervals(seconds_);
    size_t next = 0;
    for (PriceList& list : result_.lists)
      for (Price& p : list.prices) p.cpu_seconds = whole(seconds[next++], p.start_seconds);
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

  RenderStart start(const RenderRequest& request) const {
    RenderStart made = start_render(request.scene, request.effects, request.light, result_.error_floor,
                                    result_.settings.seed, result_.settings.threads, colors_);
    frame_small(made.scene);
    return made;
  }

  /// Renders what is recommended as the flags would, from the start, against a reference with the finest settings.
  void measure_advice(const std::vector<CostSteps>& all) {
    const CostSettings& s = result_.settings;
    const int most = 2 * reference_factor * s.most_samples;
    const auto affordable = [&](const Quality& q) { return q.reached && q.samples <= most; };
    if (clock_.stopped() || std::none_of(result_.qualities.begin(), result_.qualities.end(), affordable)) return;
    tell("the reference of the recommendations");
    const RenderRequest asked{s.scene, request_light_, effects_};
    std::vector<int> best_settings;
    for (const PriceList& list : result_.lists)
      best_settings.push_back(list.biased && list.advised ? int(list.prices.size()) - 1 : -1);
    const RenderRequest finest = request_of(all, result_.lists, best_settings, asked);
    Reference truth;
    {
      const RenderStart best = start(finest);
      Film film = empty_film();
      render_film(best.scene, best.light, result_.reference_samples, seed_of(Part::finest, 0), film);
      if (clock_.stopped()) return;
      truth = make_reference(film, result_.reference_samples, result_.error_floor);
    }
    for (Quality& q : result_.qualities) {
      if (!affordable(q)) continue;
      const RenderRequest request = request_of(all, result_.lists, q.chosen, asked);
      std::vector<double> squares, seconds;
      for (int k = 0; k < s.seeds; ++k) {
        tell(fmt::format("the recommended {}", q.name));
        const RenderStart made = start(request);
        const double fixed = result_.start.program.value + made.assembly_seconds + made.pilot_seconds +
                             result_.start.albedo_table.value + result_.start.writing.value;
        Film film = empty_film();
        const RenderResult done = render_film(made.scene, made.light, q.samples, seed_of(Part::recommended, k), film);
        if (clock_.stopped()) return;
        squares.push_back(mse_against(film, truth).relative);
        seconds.push_back(fixed + done.cpu_seconds * result_.scale);
      }
      q.measured = true;
      q.measured_error = error_interval(squares);
      q.measured_seconds = repeated_interval(seconds);
    }
  }

  const ColorManager& colors_;
  const std::function<void(const StudyState&)>& observe_;
  WorkClock clock_;
  CostResult result_;
  Reference reference_;
  SceneSettings small_;
  Look look_;
  EffectSwitches effects_;
  LightSettings request_light_;
  int most_bounces_ = 0;
  Scene described_, scene_;
  float exposure_ = 0;
  std::vector<std::vector<double>> seconds_;      ///< of every price's samples, a repetition a place
  std::vector<std::vector<double>> time_ratios_;  ///< of a sample to what is asked for, a repetition a place
  std::vector<std::pair<size_t, size_t>> timed_;  ///< list and setting that they belong to
};

}  // namespace

double StartPrice::scatter() const {
  double squares = 0;
  for (const Interval* each : {&program, &assembly, &pilots, &albedo_table, &writing})
    squares += std::pow((each->high - each->low) / 2, 2);
  return std::sqrt(squares);
}

CostResult measure_cost(const CostSettings& settings, const ColorManager& colors,
                        const std::function<void(const StudyState&)>& observe, const std::atomic<bool>* interrupt) {
  if (settings.seeds < 2 || settings.most_samples < 2 * replicates)
    throw InputError(fmt::format("a price list wants 2 seeds and {} samples or more, has {} and {}", 2 * replicates,
                                 settings.seeds, settings.most_samples));
  return CostMeasurement(settings, colors, observe, interrupt).run();
}

}  // namespace sateen
