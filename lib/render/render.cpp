#include "render/render.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/parallel.h"
#include "render/pass.h"

namespace sateen {

namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

constexpr int least_samples = 16;  // below that E is not trusted to promise anything
// An error so coarse may end a render before the first barrier, as soon as every replicate has a sample more: from 4
// to 16 samples E falls to less than a half.
constexpr double coarse_error = 0.06;

// Work of a sample that is dealt out by error, before any is: they go to folds, and pixels that are done keep what
// they have. 1.5 to 2.2 on the default drape, skirts and a sphere.
constexpr double dearer_by_error = 1.8;
// Seconds of one core for a look at the error and the samples' new shares, a pixel.
constexpr double look_seconds = 0.8e-6;

/// The rule that will be met first, as far as the past tells, and when.
Promise forecast(const std::vector<ErrorPoint>& past, const StopRules& stop, double seconds_before) {
  Promise first;
  const auto consider = [&](const Promise& p) {
    if (p.made && (!first.made || p.seconds.value < first.seconds.value)) first = p;
  };
  if (stop.error > 0) consider(promise_for_error(past, stop.error));
  if (stop.spp > 0) consider(promise_at(past, stop.spp));
  if (stop.seconds > 0) consider(promise_in_time(past, seconds_before + stop.seconds));
  return first;
}

/// The grid on which samples are added up: a power of two far below the light of the scene.
double grain_of(const Environment& environment) {
  const float light = max_component(environment.mean_radiance);
  return std::ldexp(1.0, (light > 0 ? std::ilogb(light) : 0) - 33);
}

/// The next number of samples that is the same for every replicate.
int next_whole(int samples) {
  return (samples / replicates + 1) * replicates;
}

/// Over the pixels that have some: of a pass that was cut off a part.
double mean_samples(const Film& film) {
  double sum = 0, pixels = 0;
  for (const FilmPixel& pixel : film.pixels) sum += double(pixel.samples), pixels += pixel.samples > 0;
  return pixels > 0 ? sum / pixels : 0;
}

/// One call of render(): clocks, what is told, and where the next pass ends.
struct Run {
  const RenderSettings& settings;
  Course& course;
  const RenderHooks& hooks;
  double start = now(), cpu_start = cpu_seconds();
  double seconds_before = course.seconds, cpu_before = course.cpu_seconds;  ///< of earlier runs
  double told = 0, saved = start, tracing = start;
  int first_samples = course.samples;
  double first_work = 0, work = 0;        ///< ErrorPoint::work at the start of this run and of this pass
  double coming_work = 0, next_work = 1;  ///< of this pass, and of one more mean sample
  RenderState state = {};
  Promise coming = {};  ///< the newest forecast
  std::vector<PixelError> errors = {};

  double elapsed() const { return now() - start; }
  double looking = 0;  ///< seconds that the last look at the error took; there is one at the end
  double time_left() const { return settings.stop.seconds - settings.seconds_spent - looking - elapsed(); }
  bool time_is_up() const { return settings.stop.seconds > 0 && course.samples > first_samples && time_left() <= 0; }
  void clock() {
    course.seconds = seconds_before + elapsed();
    course.cpu_seconds = cpu_before + cpu_seconds() - cpu_start;
    state.seconds = elapsed();
  }
  ErrorScale scale() const { return {settings.error_floor, settings.threads}; }

  void begin_pass(const Film& film, int end) {
    measured = false;
    work = work_of(film);
    coming_work = pass_work(film, course, end);
    next_work = std::max(coming_work / std::max(end - course.samples, 1), 1e-6);
  }

  /// Seconds for the work of one, from the later half of all runs where that is known, else from this run's passes.
  double per_work(double done) const {
    const ErrorPoint from = course.past.empty() ? ErrorPoint() : later_half_of(course.past);
    if (!course.past.empty() && done > from.work) return (course.seconds - from.seconds) / (done - from.work);
    return (now() - tracing) / std::max(done - first_work, 1e-9);
  }

  /// Of the samples after this pass, before anything is known of where they go. Once they are dealt out by error they
  /// go to what is covered.
  double work_until(int spp) const {
    const int even = settings.adaptive ? std::clamp(course.barrier, end_of_pass, std::max(spp, end_of_pass)) : spp;
    return (even - end_of_pass) * next_work + dearer_by_error * (spp - even);
  }

  /// `share`: of the pass that is under way.
  void tell(double share) {
    clock();
    const StopRules& stop = settings.stop;
    const double done = work + share * coming_work;
    double left = -1;
    if (coming.made)
      left = (std::max(coming.work, work + coming_work) - done) * per_work(done);
    else if (stop.spp > 0 && (work > first_work || (done > first_work && elapsed() > 2)))  // few tiles lie
      left = ((1 - share) * coming_work + work_until(stop.spp)) * per_work(done);
    if (stop.seconds > 0) left = left < 0 ? time_left() : std::min(left, time_left());
    state.seconds_left = left < 0 ? left : std::max(left, 0.0);
    const double whole = course.seconds + state.seconds_left;
    if (state.seconds_left >= 0 && whole > 0)
      state.fraction = std::max(state.fraction, std::min(course.seconds / whole, 0.999));
    told = now();
    if (hooks.observe) hooks.observe(state);
  }
  int end_of_pass = 0;

  bool looks_early() const { return settings.stop.error >= coarse_error && course.past.empty(); }

  /// Mean samples at the end of the next pass; where the course already is when time is up.
  int next_end(const Film& film) {
    // A first complete picture at once, then twice as many, so that a signal finds an even one.
    int end = course.samples == 0   ? 1
              : course.past.empty() ? std::min(2 * course.samples, course.barrier)
                                    : course.barrier;
    if (looks_early()) end = std::min(end, course.samples == 0 ? 1 : next_whole(course.samples));
    if (settings.stop.spp > 0) end = std::min(end, settings.stop.spp);
    if (settings.stop.seconds > 0 && course.samples > first_samples) {
      if (time_is_up()) return course.samples;
      clock();
      begin_pass(film, end);
      const double each = std::max(per_work(work) * next_work, 1e-9);
      const double fits = time_left() / each;
      // Half of what seems to fit, for the machine may get busier; of the last samples one is cut off.
      end = std::min(end, course.samples + int(std::clamp(fits / 2, 1.0, 1e8)));
    }
    return end;
  }

  bool is_met(const PictureError& error) const {
    return settings.stop.error > 0 && error.known && error.high <= settings.stop.error;
  }

  /// An error that few pixels make and that four times the samples did not lower.
  bool is_hopeless() const {
    constexpr double least = 1024, lower = 0.8;
    if (settings.stop.error <= 0 || course.samples < least || !state.error.rests_on_rare_samples) return false;
    const ErrorPoint* then = nullptr;
    for (const ErrorPoint& p : course.past)
      if (p.samples <= course.samples / 4) then = &p;
    return then && state.error.error > lower * then->error;
  }

  bool measured = false;  ///< since the last pass
  void measure(const Film& film) {
    if (measured) return;
    measured = true;
    errors = pixel_errors(film, scale());
    state.error = picture_error(film, errors);
  }

  /// Before the first barrier. Samples are not dealt out by what is seen here: where the render ends does not change
  /// how it would have gone on.
  bool met_early(const Film& film) {
    if (!looks_early() || course.samples == 0 || course.samples % replicates != 0) return false;
    measure(film);
    return is_met(state.error);
  }

  /// At a barrier: the error is looked at. True where it is small enough.
  bool look(const Film& film) {
    clock();
    measure(film);
    ErrorPoint point;
    point.samples = double(course.samples);
    point.useful = useful_samples(film, errors);
    point.work = work_of(film);
    point.error = state.error.error;
    point.high = state.error.high;
    point.seconds = course.seconds;
    point.cpu_seconds = course.cpu_seconds;
    if (course.past.empty() || course.past.back().samples < course.samples) course.past.push_back(point);
    return is_met(state.error);
  }

  /// What is to come, once it is known where the next samples go.
  void foresee(const Film& film) {
    const int next = course.barrier;
    course.past.back().next_work = std::max(pass_work(film, course, next) / std::max(next - course.samples, 1), 1e-6);
    StopRules stop = settings.stop;
    stop.seconds = std::max(stop.seconds - settings.seconds_spent, stop.seconds * 1e-3);
    coming = forecast(course.past, stop, seconds_before);
    // The promise wants three looks at how samples are dealt out, and about 2 % of the work.
    const bool short_run = settings.stop.spp > 0 && settings.stop.spp <= 4 * least_samples;
    if (!course.promise.made && coming.made && course.samples >= (short_run ? 2 : 4) * least_samples &&
        course.samples != settings.stop.spp && course.samples >= 0.02 * coming.samples.value)
      course.promise = coming;
    state.promise = course.promise;
  }
};

}  // namespace

RenderResult render(const Scene& scene, const RenderSettings& settings, Film& film, Course& course,
                    const RenderHooks& hooks) {
  Run run{settings, course, hooks};
  RenderResult result;
  const AlbedoMaps albedo =
      film.layers.empty() || !settings.albedo_layer ? AlbedoMaps() : map_albedos(scene, settings.threads);
  film.grain = grain_of(scene.environment);
  film.opaque = scene.backdrop != Backdrop::none;
  run.tracing = now();
  run.looking = look_seconds * double(film.pixels.size());
  run.first_work = work_of(film);
  run.state.samples = course.samples;
  run.state.target = settings.stop.error;
  if (course.promised_for != settings.stop) course.promise = {};
  course.promised_for = settings.stop;
  if (course.targets.empty()) {
    course.barrier = next_barrier(0);
    course.targets = allocate(film, settings.crop, course.barrier, settings.adaptive, run.scale());
  }
  const auto sum_up = [&](StopReason reason, bool cut_off = false) {
    run.clock();
    result.reason = reason;
    // Of a pass that was cut off a part counts; whole ones are counted as they were asked for.
    result.samples = cut_off ? std::max(course.samples, int(mean_samples(film))) : course.samples;
    run.measure(film);
    result.error = run.state.error;
    result.deviation = deviation_of_share(film, run.errors);
    result.seconds = run.state.seconds;
    result.cpu_seconds = course.cpu_seconds - run.cpu_before;
    result.total_seconds = course.seconds;
    result.total_cpu_seconds = course.cpu_seconds;
    result.promise = course.promise;
    result.rays = course.rays;
    return result;
  };
  const auto interrupted = [&] { return hooks.interrupt && hooks.interrupt->load(std::memory_order_relaxed); };
  const auto snapshot_asked = [&] {
    return hooks.snapshot_wanted && hooks.snapshot_wanted->load(std::memory_order_relaxed);
  };
  const auto snapshot_due = [&] { return hooks.snapshot_every > 0 && now() - run.saved >= hooks.snapshot_every; };
  const auto stop = [&] {
    return interrupted() || run.time_is_up() || (hooks.snapshot && (snapshot_asked() || snapshot_due()));
  };

  for (;;) {
    if (course.samples >= course.barrier) {
      const double look_began = now();
      if (run.look(film)) return sum_up(StopReason::error);
      if (run.is_hopeless()) return sum_up(StopReason::rare);
      // What was asked for may have been reached before this run began.
      if (settings.stop.spp <= 0 || course.samples < settings.stop.spp) {
        course.barrier = next_barrier(course.samples);
        course.targets = allocate(film, settings.crop, course.barrier, settings.adaptive, run.scale());
        run.foresee(film);
      }
      run.looking = now() - look_began;
    } else if (run.met_early(film)) {
      return sum_up(StopReason::error);
    }
    if (settings.stop.spp > 0 && course.samples >= settings.stop.spp) return sum_up(StopReason::samples);
    const int end = run.end_of_pass = run.next_end(film);
    if (end <= course.samples) return sum_up(StopReason::time);
    const auto tell = [&](double share) {
      if (share < 1 && now() - run.told >= 0.1) run.tell(share);
    };
    for (;;) {
      run.begin_pass(film, end);
      if (render_pass(scene, settings, albedo, film, course, end, stop, tell)) break;
      if (interrupted()) return sum_up(StopReason::interrupted, true);
      if (run.time_is_up()) return sum_up(StopReason::time, true);
      const bool asked = snapshot_asked();
      if (asked) *hooks.snapshot_wanted = false;
      hooks.snapshot(sum_up(StopReason::interrupted, true), asked);
      run.saved = now();
    }
    course.samples = run.state.samples = end;
    if (result.first_pass_seconds == 0) result.first_pass_seconds = run.elapsed();
    run.tell(1);
  }
}

RenderResult render(const Scene& scene, const RenderSettings& settings, Film& film,
                    const std::function<void(const RenderState&)>& observe, const std::atomic<bool>* interrupt) {
  Course course;
  RenderHooks hooks;
  hooks.observe = observe;
  hooks.interrupt = interrupt;
  return render(scene, settings, film, course, hooks);
}

}  // namespace sateen
