#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "math/vector.h"
#include "mesh/mesh.h"

namespace sateen {

/// Beyond every scene.
inline constexpr float far_away = 1e30f;

struct Ray {
  Vec3 origin, direction;  ///< direction need not be unit
  float t_min = 0, t_max = far_away;
};

/// Where a ray met the mesh. A quad is two flat triangles split along the diagonal from corner 1 to corner 3; (u, v)
/// is (0,0) at corner 0, (1,0) at 1, (1,1) at 2, (0,1) at 3, linear on each triangle:
///   u + v <= 1:  (1 - u - v) c0 + u c1 + v c3
///   else:        (u + v - 1) c2 + (1 - u) c3 + (1 - v) c1
/// surface_point() in scene/surface.h does this for all values.
struct Hit {
  float t = 0;
  std::uint32_t quad = 0;
  float u = 0, v = 0;
};

/// Embree over the mesh's quads, whose buffers it shares: the mesh must outlive it and stay where it is. Rays with a
/// NaN or Inf in origin or direction, or a NaN among t_min and t_max, miss and are never shown to Embree.
/// OperationError when Embree fails; InputError when a quad uses a vertex that is out of range or not finite.
class RayTracer {
 public:
  explicit RayTracer(const Mesh& mesh, int threads = 0);
  ~RayTracer();
  RayTracer(RayTracer&&) noexcept;

  std::optional<Hit> closest_hit(const Ray& ray) const;

  /// Up to `packet_size` rays that run close together, such as those of one pixel: three times as fast as one by one.
  /// `found[k]` says whether ray k met the mesh at `hits[k]`. A hit does not depend on the other rays of its packet,
  /// though its last bits may differ from closest_hit's.
  static constexpr int packet_size = 16;
  void closest_hits(std::span<const Ray> rays, Hit* hits, bool* found) const;

  bool occluded(const Ray& ray) const;
  /// The same for many rays that need have nothing in common, up to `stream_size`: a sixth faster than one by one.
  static constexpr int stream_size = 512;
  void occluded_each(std::span<const Ray> rays, bool* occluded) const;

  /// Share of light that passes where a ray meets the mesh, 0 to 1.
  using ShareAt = std::function<float(const Hit& hit, const Ray& ray)>;
  /// The product of the shares of all surfaces that a ray meets, in one walk through the tree; 0 below 1e-6. The
  /// surfaces come in no order. The same bits for a ray whatever the others are.
  void passed_each(std::span<const Ray> rays, const ShareAt& share, float* passed) const;
  std::int64_t memory_bytes() const;       ///< what Embree holds now
  std::int64_t peak_memory_bytes() const;  ///< the most that it held while building

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sateen
