#include "render/pixel_grid.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <vector>

#include "base/parallel.h"

namespace sateen {

PixelGrid grid_of(const Camera& camera) {
  PixelGrid grid;
  grid.columns = std::min(grid.columns, camera.width);
  grid.rows = std::min(grid.rows, camera.height);
  return grid;
}

GridWork trace_grid(const Scene& scene, const LightSettings& light, std::uint32_t seed, const PixelGrid& grid,
                    int threads, const std::function<void(int, std::span<const CameraSample>)>& use) {
  GridWork work;
  std::mutex merging;
  const double start = cpu_seconds();
  const auto place = [](int cell, float in_cell, int cells, int size) {
    return std::min(int((double(cell) + double(in_cell)) * size / cells), size - 1);
  };
  parallel_for(grid.rows, threads, [&](int row) {
    static thread_local std::unique_ptr<PathScratch> scratch = std::make_unique<PathScratch>();
    scratch->counts = {};
    std::vector<CameraSample> samples(size_t(grid.samples));
    std::int64_t hits = 0;
    const int y = place(row, grid.place.y, grid.rows, scene.camera.height);
    for (int column = 0; column < grid.columns; ++column) {
      const int x = place(column, grid.place.x, grid.columns, scene.camera.width);
      for (int first = 0; first < grid.samples; first += batch_size) {
        std::array<SampleId, batch_size> ids;
        const int count = std::min(batch_size, grid.samples - first);
        for (int k = 0; k < count; ++k) {
          const int number = grid.first + first + k;
          ids[size_t(k)] = {x, y, number % replicates, std::uint32_t(number / replicates)};
        }
        trace_samples(scene, light, seed, {ids.data(), size_t(count)}, *scratch, &samples[size_t(first)]);
      }
      for (const CameraSample& s : samples) hits += s.hit;
      use(row * grid.columns + column, samples);
    }
    const std::lock_guard lock(merging);
    work.rays.add(scratch->counts);
    work.hits += hits;
  });
  work.cpu_seconds = cpu_seconds() - start;
  return work;
}

}  // namespace sateen
