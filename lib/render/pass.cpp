#include "render/pass.h"

#include <algorithm>
#include <array>
#include <memory>
#include <mutex>

#include "base/parallel.h"

namespace sateen {

namespace {

constexpr int tile_size = 32;  // the unit of work; does not depend on the number of threads

void add_layers(LayerPixel& layer, const CameraSample& s, const AlbedoMaps& albedo) {
  for (int family = 0; family < 2; ++family) {
    layer.surface[family] += s.direct.surface[family];
    layer.volume[family] += s.direct.volume[family];
  }
  for (int b = 0; b < tracked_bounces; ++b) layer.indirect.bounce[b] += s.indirect.bounce[b];
  layer.through_gaps += s.through_gaps;
  layer.backdrop += s.backdrop;
  if (!s.hit) return;
  layer.albedo += sample_albedo(albedo, s);
  layer.normal += s.normal;
  layer.position += s.position;
  layer.warp += s.warp;
  layer.uv += s.uv;
  ++layer.hits;
}

/// Brings the pixels from x0 to x1 of row y to the samples that `until` says, in batches that run on from pixel to
/// pixel; returns their work. A sample has the same bits in any batch, so it does not matter where they end.
template <class Until>
double add_row(const Scene& scene, const RenderSettings& settings, const AlbedoMaps& albedo, Film& film, int y,
               int x0, int x1, const Until& until, PathScratch& scratch) {
  std::array<SampleId, batch_size> ids;
  std::array<CameraSample, batch_size> samples;
  size_t waiting = 0;
  double added = 0;
  const auto trace = [&] {
    trace_samples(scene, settings.light, settings.seed, {ids.data(), waiting}, scratch, samples.data());
    for (size_t k = 0; k < waiting; ++k) {
      const size_t i = size_t(y) * size_t(film.width) + size_t(ids[k].x);
      add_sample(film.pixels[i], samples[k].total(), samples[k].coverage, film.grain);
      if (!film.layers.empty()) add_layers(film.layers[i], samples[k], albedo);
    }
    waiting = 0;
  };
  for (int x = x0; x < x1; ++x) {
    const size_t i = size_t(y) * size_t(film.width) + size_t(x);
    if (until(i) > film.pixels[i].samples)
      added += double(until(i) - film.pixels[i].samples) * sample_work(film.pixels[i]);
    for (std::uint64_t n = film.pixels[i].samples, end = until(i); n < end; ++n) {
      const std::uint32_t number = film.first_sample + std::uint32_t(n);
      ids[waiting++] = {x, y, int(number % replicates), number / replicates};
      if (waiting == ids.size()) trace();
    }
  }
  if (waiting > 0) trace();
  return added;
}

}  // namespace

double sample_work(const FilmPixel& pixel) {
  constexpr double empty = 0.1;  // measured: a ray that meets nothing, over one that is lit
  return pixel.samples == 0 ? 1 : empty + (1 - empty) * std::clamp(pixel_coverage(pixel), 0.0, 1.0);
}

double work_of(const Film& film) {
  double work = 0;
  for (const FilmPixel& pixel : film.pixels) work += double(pixel.samples) * sample_work(pixel);
  return work / double(film.pixels.size());
}

double pass_work(const Film& film, const Course& course, int samples) {
  double work = 0;
  for (size_t i = 0; i < film.pixels.size(); ++i) {
    const std::uint64_t until = part_of_target(course.targets[i], samples, course.barrier);
    if (until > film.pixels[i].samples) work += double(until - film.pixels[i].samples) * sample_work(film.pixels[i]);
  }
  return work / double(film.pixels.size());
}

bool render_pass(const Scene& scene, const RenderSettings& settings, const AlbedoMaps& albedo, Film& film,
                 Course& course, int samples, const std::function<bool()>& stop,
                 const std::function<void(double)>& tell) {
  const Crop w = clipped(settings.crop, film.width, film.height);
  const int across = (w.x1 - w.x0 + tile_size - 1) / tile_size, down = (w.y1 - w.y0 + tile_size - 1) / tile_size;
  const auto until = [&](size_t i) {
    return std::uint64_t(part_of_target(course.targets[i], samples, course.barrier));
  };
  const double wanted = pass_work(film, course, samples) * double(film.pixels.size());
  double added = 0;
  std::mutex merging;
  std::atomic<bool> whole = true;
  parallel_for(across * down, settings.threads, [&](int tile) {
    // Scratch is large and reused; nothing of it outlives a sample but the counts.
    static thread_local std::unique_ptr<PathScratch> scratch = std::make_unique<PathScratch>();
    scratch->counts = {};
    double here = 0;
    const int x0 = w.x0 + tile % across * tile_size, y0 = w.y0 + tile / across * tile_size;
    const int x1 = std::min(x0 + tile_size, w.x1), y1 = std::min(y0 + tile_size, w.y1);
    for (int y = y0; y < y1; ++y) {
      // Between rows, not tiles: late passes put hundreds of samples into a pixel, and a signal wants to be heard.
      if (stop()) {
        whole = false;
        break;
      }
      here += add_row(scene, settings, albedo, film, y, x0, x1, until, *scratch);
    }
    const std::lock_guard lock(merging);
    course.rays.add(scratch->counts);
    added += here;
    tell(wanted > 0 ? added / wanted : 1);
  });
  return whole;
}

}  // namespace sateen
