#include "scene/environment_size.h"

#include <algorithm>

namespace sateen {

Environment shrink_environment(const Environment& map, int width, int height) {
  width = std::clamp(width, 1, map.width);
  height = std::clamp(height, 1, map.height);
  Image small(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double sum[3] = {0, 0, 0}, weight = 0;
      const int y0 = int(std::int64_t(y) * map.height / height), y1 = int(std::int64_t(y + 1) * map.height / height);
      const int x0 = int(std::int64_t(x) * map.width / width), x1 = int(std::int64_t(x + 1) * map.width / width);
      for (int v = y0; v < y1; ++v) {
        const double row = environment_row_weight(v, map.height);
        for (int u = x0; u < x1; ++u) {
          const Color& c = map.texels[size_t(v) * size_t(map.width) + size_t(u)].radiance;
          for (int i = 0; i < 3; ++i) sum[i] += row * double(c[i]);
          weight += row;
        }
      }
      for (int i = 0; i < 3; ++i) small.at(x, y)[i] = float(sum[i] / weight);
    }
  EnvironmentOptions options;
  options.rotation = map.rotation;
  options.name = map.name;
  options.luminance = map.luminance;
  Environment shrunk = build_environment(std::move(small), options);
  shrunk.repairs = map.repairs;
  return shrunk;
}

}  // namespace sateen
