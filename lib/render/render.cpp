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
// to 16 samples E falls to less than a half. Few samples have not met the rare bright ones yet, and the more noise
// there is the more of it they do not know of: E comes out up to a fifth too small at 0.2 and a tenth at 0.1 in some
// of the scenes of docs/error.md, also when it is right on average. So much below the error asked for it must be.
constexpr double coarse_error = 0.03, unknown_per_error = 2.5;
// Measured on 403 runs of those scenes: stated E over the real one is 0.91, 0.94, 0.96 at 4, 8, 12 samples.
constexpr double unknown_per_sample = 0.45;

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

/// What a sample that is dealt out by error costs more than one of the first, even pass: it goes to the cloth, and
/// one that meets none costs about a tenth.
double dearer_by_error(const Film& film) {
  double met = 0, all = 0;
  for (const FilmPixel& pixel : film.pixels) {
    all += pixel.samples > 0;
    met += pixel.alpha > 0;
  }
  return met > 0 ? all / (met + 0.1 * (all - met)) : 1;
}

/// The next number of samples that is the same for every replicate.
int next_whole(int samples) {
  return (samples / replicates + 1) * replicates;
}

/// One call of render(): clocks, what is told, and where the next pass ends.
struct Run {
  const RenderSettings& settings;
  Course& course;
  const RenderHooks& hooks;
  double start = now(), cpu_start = cpu_seconds();
  double seconds_before = course.seconds, cpu_before = course.cpu_seconds;  ///< of earlier runs
  double told = 0, saved = start, tracing = start;
  double dearer = 1;  ///< later samples than those so far
  int first_samples = course.samples;
  RenderState state = {};
  Promise coming = {};  ///< the newest forecast

  double elapsed() const { return now() - start; }
  void clock() {
    course.seconds = seconds_before + elapsed();
    course.cpu_seconds = cpu_before + cpu_seconds() - cpu_start;
    state.seconds = elapsed();
  }

  /// Seconds for one more mean sample, from this run's passes.
  double per_sample(double done) const { return (now() - tracing) / std::max(done - first_samples, 1e-9); }

  /// `done`: mean samples with the share of the pass that is under way.
  void tell(double done) {
    clock();
    const StopRules& stop = settings.stop;
    double left = -1;
    if (coming.made)
      left = std::max(coming.seconds.value - course.seconds, 0.0) * (course.past.size() == 1 ? dearer : 1);
    else if (stop.spp > 0 && (done >= first_samples + 1 || (done > first_samples && elapsed() > 2)))  // few tiles lie
      left = (stop.spp - done) * per_sample(done) * dearer;
    if (stop.seconds > 0)
      left = left < 0 ? stop.seconds - state.seconds : std::min(left, stop.seconds - state.seconds);
    state.seconds_left = left;
    const double whole = course.seconds + state.seconds_left;
    if (state.seconds_left >= 0 && whole > 0)
      state.fraction = std::max(state.fraction, std::min(course.seconds / whole, 0.999));
    told = now();
    if (hooks.observe) hooks.observe(state);
  }

  bool looks_early() const { return settings.stop.error >= coarse_error && course.past.empty(); }

  /// Mean samples at the end of the next pass; where the course already is when time is up.
  int next_end() const {
    int end = course.samples == 0 ? 1 : course.barrier;  // a first complete picture at once
    if (looks_early()) end = std::min(end, course.samples == 0 ? 1 : next_whole(course.samples));
    if (settings.stop.spp > 0) end = std::min(end, settings.stop.spp);
    if (settings.stop.seconds > 0 && course.samples > first_samples) {
      const double fits = (settings.stop.seconds - elapsed()) / std::max(per_sample(course.samples), 1e-9);
      end = std::min(end, course.samples + int(std::clamp(fits, 0.0, 1e8)));
    }
    return end;
  }

  /// Before the first barrier. Samples are not dealt out by what is seen here: where the render ends does not change
  /// how it would have gone on.
  bool met_early(const Film& film) {
    if (!looks_early() || course.samples == 0 || course.samples % replicates != 0) return false;
    state.error = error_of(film, course.samples);
    PictureError cautious = state.error;
    cautious.high *= 1 + unknown_per_error * state.error.error;
    return is_met(cautious);
  }
  bool is_met(const PictureError& error) const {
    return settings.stop.error > 0 && error.known && error.high <= settings.stop.error;
  }

  /// At a barrier: the error is looked at. True where it is small enough.
  bool look(const Film& film) {
    clock();
    state.error = error_of(film, course.samples);
    if (course.past.empty() || course.past.back().samples < course.samples)
      course.past.push_back({double(course.samples), useful_samples(film), state.error.error, state.error.high,
                             course.seconds, course.cpu_seconds});
    coming = forecast(course.past, settings.stop, seconds_before);
    // The promise wants three looks at how samples are dealt out, and about 2 % of the work.
    const bool short_run = settings.stop.spp > 0 && settings.stop.spp <= 4 * least_samples;
    if (!course.promise.made && coming.made && course.samples >= (short_run ? 2 : 4) * least_samples &&
        course.samples != settings.stop.spp && course.samples >= 0.02 * coming.samples.value)
      course.promise = coming;
    state.promise = course.promise;
    return is_met(state.error);
  }
};

}  // namespace

PictureError error_of(const Film& film, int samples) {
  PictureError e = picture_error(film);
  if (samples <= 0 || samples >= next_barrier(0)) return e;
  for (double* each : {&e.error, &e.low, &e.high}) *each *= 1 + unknown_per_sample / samples;
  return e;
}

RenderResult render(const Scene& scene, const RenderSettings& settings, Film& film, Course& course,
                    const RenderHooks& hooks) {
  Run run{settings, course, hooks};
  RenderResult result;
  const AlbedoMaps albedo =
      film.layers.empty() || !settings.albedo_layer ? AlbedoMaps() : map_albedos(scene, settings.threads);
  film.grain = grain_of(scene.environment);
  run.tracing = now();
  run.state.samples = course.samples;
  run.state.target = settings.stop.error;
  if (course.promised_for != settings.stop) course.promise = {};
  course.promised_for = settings.stop;
  if (course.targets.empty()) {
    course.barrier = next_barrier(0);
    course.targets = allocate(film, settings.crop, course.barrier, settings.adaptive);
  }
  const auto sum_up = [&](StopReason reason) {
    run.clock();
    result.reason = reason;
    result.samples = course.samples;
    result.error = error_of(film, course.samples);
    result.deviation = deviation_of_share(film);
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
  const auto stop = [&] { return interrupted() || (hooks.snapshot && (snapshot_asked() || snapshot_due())); };

  for (;;) {
    if (course.samples >= course.barrier) {
      if (run.look(film)) return sum_up(StopReason::error);
      // What was asked for may have been reached before this run began.
      if (settings.stop.spp <= 0 || course.samples < settings.stop.spp) {
        course.barrier = next_barrier(course.samples);
        course.targets = allocate(film, settings.crop, course.barrier, settings.adaptive);
      }
    } else if (run.met_early(film)) {
      return sum_up(StopReason::error);
    }
    if (settings.stop.spp > 0 && course.samples >= settings.stop.spp) return sum_up(StopReason::samples);
    const int end = run.next_end();
    if (end <= course.samples) return sum_up(StopReason::time);
    const auto tell = [&](double share) {
      // The mean over all passes: one that has just begun has met the easy tiles alone, or another program's load.
      if (share < 1 && now() - run.told >= 0.1) run.tell(course.samples + (end - course.samples) * share);
    };
    while (!render_pass(scene, settings, albedo, film, course, end, stop, tell)) {
      if (interrupted()) return sum_up(StopReason::interrupted);
      const bool asked = snapshot_asked();
      if (asked) *hooks.snapshot_wanted = false;
      hooks.snapshot(sum_up(StopReason::interrupted), asked);
      run.saved = now();
    }
    course.samples = run.state.samples = end;
    if (result.first_pass_seconds == 0) {
      result.first_pass_seconds = run.elapsed();
      if (settings.adaptive) run.dearer = dearer_by_error(film);
    }
    run.tell(end);
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
