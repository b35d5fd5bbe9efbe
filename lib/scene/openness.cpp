#include "scene/openness.h"

#include <cmath>

#include "scene/scene.h"

namespace sateen {

namespace {

constexpr double cubes = 3072;               // of the cloth's area
constexpr std::size_t most_quads = 1 << 16;  // that are looked at
constexpr int net_side = OpenDirections::net_side;
constexpr std::size_t directions = net_side * net_side;

std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ x >> 31) * 0x9e3779b97f4a7c15u;
  x = (x ^ x >> 29) * 0xbf58476d1ce4e5b9u;
  return x ^ x >> 32;
}

/// Where the octahedron's lower half lies in the net for a place of the upper one, and back.
Vec2 folded(float x, float y) {
  return {std::copysign(1 - std::abs(y), x), std::copysign(1 - std::abs(x), y)};
}

std::size_t net_cell(const Vec3& d) {
  const float scale = 1 / (std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
  const Vec2 place = d.z < 0 ? folded(d.x * scale, d.y * scale) : Vec2(d.x * scale, d.y * scale);
  const auto index = [](float v) { return std::size_t(std::min(int((v * 0.5f + 0.5f) * net_side), net_side - 1)); };
  return index(place.y) * net_side + index(place.x);
}

/// The middle of a cell.
Vec3 net_direction(int column, int row) {
  const Vec2 place((float(column) + 0.5f) * (2.0f / net_side) - 1, (float(row) + 0.5f) * (2.0f / net_side) - 1);
  const float z = 1 - std::abs(place.x) - std::abs(place.y);
  const Vec2 level = z < 0 ? folded(place.x, place.y) : place;
  return normalize(Vec3(level.x, level.y, z));
}

struct QuadPlace {
  Vec3 middle, normal;  ///< normal unit, or 0 where the quad has no area
  double area;
};
QuadPlace quad_place(const Mesh& mesh, std::size_t quad) {
  const std::array<std::uint32_t, 4>& q = mesh.quads[quad];
  const Vec3 &a = mesh.positions[q[0]], &b = mesh.positions[q[1]], &c = mesh.positions[q[2]],
             &d = mesh.positions[q[3]];
  const Vec3d across = Vec3d(c - a) % Vec3d(d - b);
  const double size = across.length();
  return {a * 0.25f + b * 0.25f + c * 0.25f + d * 0.25f, size > 0 ? Vec3(across / size) : Vec3(0), size / 2};
}

/// The middle of a quad as a place to start from, turned to face the way that is asked for.
struct Origin {
  SurfacePoint point;
  Vec3 facing;
};

bool is_open(const Scene& scene, const Origin& from, const Vec3& direction) {
  const Ray ray{offset_origin(from.point, direction), direction};
  // Under a shutter the ground turns in the object's frame; then the cloth alone is known.
  const Ground* const ground = scene.shutter ? nullptr : solid_ground(scene);
  return !scene.rays->occluded(ray) && !(ground && meet_ground(*ground, ray.origin, direction, far_away));
}

/// One ray a direction, smoothed over its neighbours: the cells are wider than the edges of what shadows.
OpenDirections trace_open(const Scene& scene, std::span<const Origin> origins) {
  std::array<float, directions> ray{}, known{};
  for (int row = 0; row < net_side; ++row)
    for (int column = 0; column < net_side; ++column) {
      const auto cell = std::size_t(row * net_side + column);
      const Vec3 direction = net_direction(column, row);
      const Origin& from = origins[(cell + std::size_t(row)) % origins.size()];
      if (dot(direction, from.facing) <= 0) continue;
      known[cell] = 1;
      ray[cell] = is_open(scene, from, direction) ? 1 : 0;
    }
  OpenDirections open;
  for (int row = 0; row < net_side; ++row)
    for (int column = 0; column < net_side; ++column) {
      float sum = 0, weights = 1e-6f;
      for (int y = std::max(row - 1, 0); y <= std::min(row + 1, net_side - 1); ++y)
        for (int x = std::max(column - 1, 0); x <= std::min(column + 1, net_side - 1); ++x) {
          const auto cell = std::size_t(y * net_side + x);
          const float weight = known[cell] / float(1 << (std::abs(x - column) + std::abs(y - row)));
          sum += weight * ray[cell];
          weights += weight;
        }
      const auto cell = std::size_t(row * net_side + column);
      open.halves[cell / 2] |= std::uint8_t(std::lround(15 * sum / weights) << (cell % 2 * 4));
    }
  return open;
}

}  // namespace

float OpenDirections::at(const Vec3& direction) const {
  const std::size_t cell = net_cell(direction);
  return float(halves[cell / 2] >> (cell % 2 * 4) & 15) * (1 / 15.0f);
}

std::uint64_t Openness::key(const Vec3& position, const Vec3& facing) const {
  const Vec3 p = (position - middle_) * cubes_per_unit_;
  const auto cube = [](float v) {
    return std::uint64_t(std::clamp(std::floor(v), -524288.0f, 524287.0f) + 524288.0f);  // 20 bits
  };
  const Vec3 a(std::abs(facing.x), std::abs(facing.y), std::abs(facing.z));
  const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
  const std::uint64_t way = std::uint64_t(2 * axis + (facing[axis] < 0 ? 2 : 1));  // 1 to 6: a key is never 0
  return way | cube(p.x) << 3 | cube(p.y) << 23 | cube(p.z) << 43;
}

std::size_t Openness::slot(std::uint64_t key) const {
  std::size_t slot = mixed(key) % slots;
  while (places_[slot].key != 0 && places_[slot].key != key) slot = (slot + 1) % slots;
  return slot;
}

Openness::Openness(const Mesh& mesh) : places_(slots) {
  const std::size_t stride = mesh.quads.size() / most_quads + 1;
  double area = 0;
  for (std::size_t i = 0; i < mesh.quads.size(); i += stride) area += quad_place(mesh, i).area * double(stride);
  middle_ = mesh.bounds_min * 0.5f + mesh.bounds_max * 0.5f;
  const double unit = std::sqrt(area / cubes);
  if (!(unit > 0) || !std::isfinite(float(1 / unit))) return;  // nothing is known of any place
  cubes_per_unit_ = float(1 / unit);
  std::size_t used = 0;
  for (std::size_t i = 0; i < mesh.quads.size(); i += stride) {
    const QuadPlace quad = quad_place(mesh, i);
    if (quad.normal == Vec3(0)) continue;
    for (const float side : {1.0f, -1.0f}) {
      const std::uint64_t of = key(quad.middle, quad.normal * side);
      Place& place = places_[slot(of)];
      if (place.key == 0) {
        if (used == slots * 3 / 4) continue;
        ++used;
        place.key = of;
      }
      // Later quads take the room of earlier ones, so that all parts of the cube have a chance.
      const std::uint32_t n = place.met++;
      const std::size_t at = n < most_origins ? n : mixed(of + n) % (n + 1);
      if (at < most_origins) place.quads[at] = std::uint32_t(i);
    }
  }
}

const OpenDirections* Openness::find(const Scene& scene, const Vec3& position, const Vec3& facing) const {
  const std::uint64_t of = key(position, facing);
  const Place& place = places_[slot(of)];
  if (place.key == 0) return nullptr;
  std::call_once(place.traced, [&] {
    const int way = int(of & 7) - 1;
    std::array<Origin, most_origins> origins;
    const std::size_t count = std::min<std::size_t>(place.met, most_origins);
    for (std::size_t k = 0; k < count; ++k) {
      const SurfacePoint point = surface_point(*scene.mesh, {0, place.quads[k], 1.0f / 3, 1.0f / 3});
      const bool turned = (point.geometric_normal[way / 2] < 0) != (way % 2 == 1);
      origins[k] = {point, point.geometric_normal * (turned ? -1.0f : 1.0f)};
    }
    place.open = std::make_unique<const OpenDirections>(trace_open(scene, {origins.data(), count}));
  });
  return place.open.get();
}

void renew_openness(Scene& scene) {
  scene.openness = scene.self_shadowing ? std::make_shared<const Openness>(*scene.mesh) : nullptr;
}

const OpenDirections* open_directions(const Scene& scene, const ClothPoint& point) {
  if (!scene.openness || scene.has_gaps) return nullptr;
  const float side = point.on_back ? -1.0f : 1.0f;
  return scene.openness->find(scene, point.surface.position, point.surface.geometric_normal * side);
}

float openness_along(const Scene& scene, const ClothPoint& point, const OpenDirections& open, const Vec3& direction) {
  return open.at(scene.shutter ? turned_back(direction, point.object) : direction);
}

}  // namespace sateen
