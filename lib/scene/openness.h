#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "math/vector.h"
#include "mesh/mesh.h"

namespace sateen {

struct Scene;
struct ClothPoint;

/// How open the directions of the sphere are at some place, in steps of a fifteenth: an octahedron's net of
/// net_side^2 cells, 14 degrees wide, two to a byte.
struct OpenDirections {
  static constexpr int net_side = 16;
  std::array<std::uint8_t, net_side * net_side / 2> halves{};

  /// 0 closed to 1 open; `direction` of any length but 0, in the frame of the ray tracer.
  float at(const Vec3& direction) const;
};

/// Which directions are open at each place of the cloth, roughly: a guide for sampling, whose 0 is not to be taken
/// for one. A place is a cube of space and one of six ways to face; its directions are traced when they are first
/// asked for, and depend on the scene alone, not on who asks or when.
class Openness {
 public:
  /// About 3000 cubes hold the cloth. Of a very fine mesh a part of the quads is looked at.
  explicit Openness(const Mesh& mesh);

  /// Null where nothing is known. `facing`: unit, in the frame of the ray tracer, the side that is lit.
  const OpenDirections* find(const Scene& scene, const Vec3& position, const Vec3& facing) const;

 private:
  static constexpr std::size_t most_origins = 4, slots = 1 << 14;
  struct Place {
    std::uint64_t key = 0;                            ///< 0: empty
    std::array<std::uint32_t, most_origins> quads{};  ///< where rays start
    std::uint32_t met = 0;                            ///< quads that belong here
    mutable std::once_flag traced;
    mutable std::unique_ptr<const OpenDirections> open;
  };
  std::uint64_t key(const Vec3& position, const Vec3& facing) const;
  std::size_t slot(std::uint64_t key) const;

  Vec3 middle_{0, 0, 0};
  float cubes_per_unit_ = 1;
  std::vector<Place> places_;  ///< a hash table
};

/// A fresh guide for a scene whose cloth or stage is another, none where the cloth does not shadow itself.
void renew_openness(Scene& scene);

/// The guide at a point of the cloth; null where it has none: nothing is in the way of light, or gaps let it through.
const OpenDirections* open_directions(const Scene& scene, const ClothPoint& point);

/// What it says of a direction of the world.
float openness_along(const Scene& scene, const ClothPoint& point, const OpenDirections& open, const Vec3& direction);

}  // namespace sateen
