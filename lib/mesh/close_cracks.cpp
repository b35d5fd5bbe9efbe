#include "mesh/close_cracks.h"

#include <algorithm>
#include <cmath>

namespace sateen {

void close_cracks(Mesh& mesh) {
  constexpr float rounding = 5e-7f;  // a few units in the last place of what is as large as the mesh
  const Vec3 size = mesh.bounds_max - mesh.bounds_min;
  const float tolerance = rounding * std::max({size.x, size.y, size.z});
  // Sorted along a direction that no border is likely to be square to, a vertex meets few others within it.
  const Vec3d across(0.3596, 0.5507, 0.7533);
  std::vector<std::pair<double, std::uint32_t>> order;
  order.reserve(mesh.positions.size());
  for (std::uint32_t i = 0; i < mesh.positions.size(); ++i)
    order.emplace_back(across.dot(Vec3d(mesh.positions[i])), i);
  std::sort(order.begin(), order.end());
  std::vector<bool> settled(order.size(), false);
  for (size_t n = 0; n < order.size(); ++n) {
    const std::uint32_t i = order[n].second;
    if (settled[i]) continue;
    const Vec3 p = mesh.positions[i];
    for (size_t m = n + 1; m < order.size() && order[m].first - order[n].first <= 2 * double(tolerance); ++m) {
      const std::uint32_t j = order[m].second;
      Vec3& q = mesh.positions[j];
      const Vec3 d = q - p;
      if (settled[j] || std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) > tolerance) continue;
      q = p;
      settled[j] = true;
    }
  }
}

}  // namespace sateen
