#pragma once
#include <cstdint>
#include <memory>
#include <optional>

#include "math/vector.h"
#include "mesh/mesh.h"

namespace sateen {

struct Ray {
  Vec3 origin, direction;  ///< direction need not be unit
  float t_min = 0, t_max = 1e30f;
};

struct Hit {
  float t = 0;
  std::uint32_t quad = 0;
  float u = 0, v = 0;  ///< Embree's quad coordinates: corner 0 at (0,0), 1 at (1,0), 2 at (1,1), 3 at (0,1)
};

/// Embree over the mesh's quads. The mesh must outlive it. Rays with a NaN or Inf miss and are never shown to Embree.
class RayTracer {
 public:
  explicit RayTracer(const Mesh& mesh, int threads = 0);
  ~RayTracer();
  RayTracer(RayTracer&&) noexcept;

  std::optional<Hit> closest_hit(const Ray& ray) const;
  bool occluded(const Ray& ray) const;
  std::int64_t memory_bytes() const;  ///< what Embree holds now

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sateen
