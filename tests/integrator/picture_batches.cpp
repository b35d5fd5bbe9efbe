#include "integrator/picture_batches.h"

#include <fmt/format.h>

#include <memory>
#include <mutex>

#include "base/parallel.h"
#include "film/film.h"

namespace sateen_test {

using namespace sateen;

PictureBatches render_batches(const Scene& scene, const LightSettings& light, int batches, int samples,
                              std::uint32_t first_seed) {
  PictureBatches out;
  out.width = scene.camera.width;
  out.height = scene.camera.height;
  out.values.assign(size_t(batches), std::vector<float>(size_t(out.width) * size_t(out.height) * 3));
  std::mutex counting;
  parallel_for(out.height, 2, [&](int y) {
    const auto scratch = std::make_unique<PathScratch>();
    for (int b = 0; b < batches; ++b)
      for (int x = 0; x < out.width; ++x) {
        Vec3d sum(0);
        for (int k = 0; k < samples; ++k)
          sum += Vec3d(trace_sample(scene, light, first_seed + std::uint32_t(b), {x, y, k % replicates, std::uint32_t(k / replicates)},
                                    *scratch)
                           .total());
        for (int c = 0; c < 3; ++c)
          out.values[size_t(b)][size_t((y * out.width + x) * 3 + c)] = float(sum[c] / samples);
      }
    const std::lock_guard lock(counting);
    out.non_finite += scratch->counts.non_finite;
  });
  return out;
}

namespace {

struct Tiling {
  int size_x, size_y, across, down;
};

Tiling tiling(const PictureBatches& p, Scale scale) {
  const int w = scale == Scale::pixel ? 1 : scale == Scale::block ? 4 : p.width;
  const int h = scale == Scale::pixel ? 1 : scale == Scale::block ? 4 : p.height;
  return {w, h, (p.width + w - 1) / w, (p.height + h - 1) / h};
}

Batches tile_batches(const PictureBatches& p, const Tiling& t, int tile_x, int tile_y, int channel) {
  Batches out;
  for (const std::vector<float>& batch : p.values) {
    double sum = 0;
    int count = 0;
    for (int y = tile_y * t.size_y; y < std::min((tile_y + 1) * t.size_y, p.height); ++y)
      for (int x = tile_x * t.size_x; x < std::min((tile_x + 1) * t.size_x, p.width); ++x, ++count)
        sum += double(batch[size_t((y * p.width + x) * 3 + channel)]);
    out.add(sum / count);
  }
  return out;
}

constexpr Scale scales[] = {Scale::pixel, Scale::block, Scale::picture};

}  // namespace

double comparisons(const PictureBatches& picture, Scale finest) {
  double count = 0;
  for (const Scale scale : scales)
    if (scale >= finest) {
      const Tiling t = tiling(picture, scale);
      count += 3.0 * t.across * t.down;
    }
  return count;
}

Disagreement largest_deviate(const PictureBatches& a, const PictureBatches& b, Scale finest) {
  Disagreement worst;
  for (const Scale scale : scales) {
    if (scale < finest) continue;
    const Tiling t = tiling(a, scale);
    for (int y = 0; y < t.down; ++y)
      for (int x = 0; x < t.across; ++x)
        for (int c = 0; c < 3; ++c) {
          const Batches one = tile_batches(a, t, x, y, c), other = tile_batches(b, t, x, y, c);
          const double deviate = std::abs(difference_deviate(one, other));
          if (deviate <= worst.deviate) continue;
          worst.deviate = deviate;
          worst.place =
              fmt::format("{} x {} pixels from ({}, {}), channel {}: {:.6g} +- {:.2g} against {:.6g} +- {:.2g}",
                          t.size_x, t.size_y, x * t.size_x, y * t.size_y, c, one.mean,
                          std::sqrt(one.variance_of_mean()), other.mean, std::sqrt(other.variance_of_mean()));
        }
  }
  return worst;
}

}  // namespace sateen_test
