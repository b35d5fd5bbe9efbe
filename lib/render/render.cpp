#include "render/render.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <mutex>

#include "base/parallel.h"
#include "render/albedo_map.h"

namespace sateen {

namespace {

constexpr int tile_size = 32;  // the unit of work; does not depend on the number of threads

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void add_sample(FilmPixel& pixel, LayerPixel* layer, const CameraSample& s, const AlbedoMaps& albedo) {
  pixel.beauty[pixel.samples % replicates] += s.total();
  pixel.alpha += s.alpha;
  ++pixel.samples;
  if (!layer) return;
  for (int family = 0; family < 2; ++family) {
    layer->surface[family] += s.direct.surface[family];
    layer->volume[family] += s.direct.volume[family];
  }
  layer->indirect += s.indirect;
  layer->backdrop += s.backdrop;
  if (!s.hit) return;
  layer->albedo += look_up(s.back ? albedo.back : albedo.front, s.wo);
  layer->normal += s.normal;
  layer->position += s.position;
  layer->warp += s.warp;
  layer->uv += s.uv;
  ++layer->hits;
}

struct Window {
  int x0, y0, x1, y1;
};

Window window_of(const RenderSettings& settings, const Film& film) {
  const Crop& c = settings.crop;
  if (c.x1 <= c.x0 || c.y1 <= c.y0) return {0, 0, film.width, film.height};
  return {std::max(c.x0, 0), std::max(c.y0, 0), std::min(c.x1, film.width), std::min(c.y1, film.height)};
}

/// Adds `count` samples to the pixels from x0 to x1 of row y, in batches that run on from pixel to pixel.
void trace_row(const Scene& scene, const RenderSettings& settings, const AlbedoMaps& albedo, Film& film, int y,
               int x0, int x1, int count, PathScratch& scratch) {
  std::array<SampleId, batch_size> ids;
  std::array<CameraSample, batch_size> samples;
  size_t waiting = 0;
  const auto at = [&](const SampleId& id) { return size_t(id.y) * size_t(film.width) + size_t(id.x); };
  const auto trace = [&] {
    trace_samples(scene, settings.light, settings.seed, {ids.data(), waiting}, scratch, samples.data());
    for (size_t k = 0; k < waiting; ++k) {
      const size_t i = at(ids[k]);
      add_sample(film.pixels[i], film.layers.empty() ? nullptr : &film.layers[i], samples[k], albedo);
    }
    waiting = 0;
  };
  for (int x = x0; x < x1; ++x) {
    const std::uint32_t first = film.pixels[at({x, y, 0, 0})].samples;
    for (std::uint32_t n = first; n < first + std::uint32_t(count); ++n) {
      ids[waiting++] = {x, y, int(n % replicates), n / replicates};
      if (waiting == ids.size()) trace();
    }
  }
  if (waiting > 0) trace();
}

/// Adds `count` samples to every pixel of the window; `tell` hears the share that is done. Returns false when
/// interrupted.
bool render_pass(const Scene& scene, const RenderSettings& settings, const AlbedoMaps& albedo, Film& film, int count,
                 RayCounts& rays, const std::atomic<bool>* interrupt, const std::function<void(double)>& tell) {
  const Window w = window_of(settings, film);
  const int across = (w.x1 - w.x0 + tile_size - 1) / tile_size, down = (w.y1 - w.y0 + tile_size - 1) / tile_size;
  std::mutex merging;
  std::atomic<bool> whole = true;
  int tiles_done = 0;
  parallel_for(across * down, settings.threads, [&](int tile) {
    // Scratch is large and reused; nothing of it outlives a sample but the counts.
    static thread_local std::unique_ptr<PathScratch> scratch = std::make_unique<PathScratch>();
    scratch->counts = {};
    const int x0 = w.x0 + tile % across * tile_size, y0 = w.y0 + tile / across * tile_size;
    for (int y = y0; y < std::min(y0 + tile_size, w.y1); ++y) {
      // Between rows, not tiles: late passes put hundreds of samples into a pixel, and a signal wants to be heard.
      if (interrupt && interrupt->load(std::memory_order_relaxed)) {
        whole = false;
        break;
      }
      trace_row(scene, settings, albedo, film, y, x0, std::min(x0 + tile_size, w.x1), count, *scratch);
    }
    const std::lock_guard lock(merging);
    rays.camera += scratch->counts.camera;
    rays.shadow += scratch->counts.shadow;
    rays.bounce += scratch->counts.bounce;
    rays.non_finite += scratch->counts.non_finite;
    tell(double(++tiles_done) / (across * down));
  });
  return whole;
}

/// Samples still needed for the asked error, from the error now: E falls about as n^-0.75 with low-discrepancy
/// samples.
double samples_for_error(const RenderState& state, double target) {
  if (!state.error.known || state.error.high <= 0) return -1;
  return state.samples * std::pow(state.error.high / target, 1 / 0.75);
}

/// `done`: samples a pixel so far, with the share of the pass that is under way.
void predict(RenderState& state, const StopRules& stop, double seconds_per_sample, double done) {
  double samples = stop.spp > 0 ? stop.spp : 1e18;
  if (stop.error > 0) {
    const double needed = samples_for_error(state, stop.error);
    if (needed > 0)
      samples = std::min(samples, std::max(needed, done));
    else if (stop.spp <= 0)
      samples = 1e18;
  }
  double left = samples < 1e17 ? (samples - done) * seconds_per_sample : -1;
  if (stop.seconds > 0) left = left < 0 ? stop.seconds - state.seconds : std::min(left, stop.seconds - state.seconds);
  state.seconds_left = left < 0 && samples > 1e17 ? -1 : std::max(left, 0.0);
  const double whole = state.seconds + state.seconds_left;
  if (state.seconds_left >= 0 && whole > 0)
    state.fraction = std::max(state.fraction, std::min(state.seconds / whole, 0.999));
}

}  // namespace

RenderResult render(const Scene& scene, const RenderSettings& settings, Film& film,
                    const std::function<void(const RenderState&)>& observe, const std::atomic<bool>* interrupt) {
  const double start = now(), cpu_start = cpu_seconds();
  const AlbedoMaps albedo =
      film.layers.empty() || !settings.albedo_layer ? AlbedoMaps() : map_albedos(scene, settings.threads);
  const double tracing_start = now();
  RenderResult result;
  RenderState state;
  // A first complete picture at once, then whole rounds of the replicates.
  int next = 1;
  for (;;) {
    if (settings.stop.spp > 0) next = std::min(next, settings.stop.spp - state.samples);
    const double pass_start = now();
    double told = pass_start;
    const auto tell = [&](double share) {
      const double time = now();
      if (!observe || share >= 1 || time - told < 0.1) return;
      told = time;
      state.seconds = time - start;
      // The mean over all passes: a pass that has just begun has met the easy tiles alone, or another program's load.
      const double done = state.samples + next * share;
      predict(state, settings.stop, (time - tracing_start) / done, done);
      observe(state);
    };
    const bool whole = render_pass(scene, settings, albedo, film, next, result.rays, interrupt, tell);
    const double pass_seconds = now() - pass_start;
    if (!whole) {
      result.reason = StopReason::interrupted;
      break;
    }
    state.samples += next;
    if (state.samples == 1) result.first_pass_seconds = now() - start;
    state.seconds = now() - start;
    const double per_sample = pass_seconds / next;
    if (state.samples % replicates == 0) state.error = picture_error(film);
    predict(state, settings.stop, (now() - tracing_start) / state.samples, state.samples);
    if (observe) observe(state);

    if (settings.stop.error > 0 && state.error.known && state.samples >= 4 * replicates &&
        state.error.high <= settings.stop.error) {
      result.reason = StopReason::error;
      break;
    }
    if (settings.stop.spp > 0 && state.samples >= settings.stop.spp) {
      result.reason = StopReason::samples;
      break;
    }
    // Rounds grow with the picture so that looking at the error stays cheap, but never past the time asked.
    next = state.samples < replicates ? replicates - state.samples
                                      : std::max(replicates, state.samples / 4 / replicates * replicates);
    if (settings.stop.seconds > 0) {
      const double left = settings.stop.seconds - state.seconds;
      const int fits = int(left / std::max(per_sample, 1e-9));
      if (fits < 1) {
        result.reason = StopReason::time;
        break;
      }
      next = std::min(next, fits);
    }
  }
  result.samples = state.samples;
  result.error = picture_error(film);
  result.seconds = now() - start;
  result.cpu_seconds = cpu_seconds() - cpu_start;
  return result;
}

}  // namespace sateen
