#pragma once
#include <optional>

#include "scene/camera.h"
#include "scene/environment.h"
#include "scene/ray_tracer.h"
#include "scene/shutter.h"

namespace sateen {

enum class GroundKind {
  catcher,   ///< unseen; takes the cloth's shadow into the picture's alpha and leaves the cloth as it is
  floor,     ///< an endless matte plane; seen it fades into the backdrop far from the object
  cyclorama  ///< a matte floor that sweeps up into a wall behind the object
};

/// The ground as it is authored.
struct GroundSettings {
  GroundKind kind = GroundKind::floor;
  std::optional<float> height;    ///< scene units, along +Y; empty: just below the object's lowest point
  Color color{0.4f, 0.4f, 0.4f};  ///< reflectance, working space, 0 to 1
};

/// Compiled. No part of the mesh: a ray is met in closed form. It is there from above and from the front alone, so
/// that a camera below or behind looks through it. What lies below it is not lit through it.
struct Ground {
  GroundKind kind = GroundKind::floor;
  float height = 0;
  Color albedo{0.4f, 0.4f, 0.4f};
  Vec3 middle{0, 0, 0};                ///< of the object
  float fade_from = 0, fade_to = 0;    ///< distances from the middle at which a floor begins and ends to fade
  Vec3 away{0, 0, -1};                 ///< unit, level: from the camera to the wall
  float wall = 0, sweep = 0, top = 0;  ///< cyclorama: distance of the wall, radius of the sweep, height of the edge

  /// Irradiance over pi of the level plane where nothing is in the way, working space.
  Color open_sky{0, 0, 0};
  float radius = 1;  ///< of the object

  bool blocks_light() const { return kind != GroundKind::catcher; }
};

/// Where a ray meets the ground.
struct GroundPoint {
  float t = 0;            ///< of the ray
  Vec3 position, normal;  ///< world
  YTurn object;           ///< how the object stands when the point is lit
};

/// Places the ground under and behind the object as `camera` sees it. A floor is opaque to 5 of the object's radii
/// and gone at 16; a cyclorama's wall stands 3 radii behind it, as high as the picture sees it and at least twice as
/// high as the object.
Ground compile_ground(const GroundSettings& settings, const Mesh& mesh, const Camera& camera,
                      const Environment& environment);

/// The ground nearer than t_max along a ray in the world.
std::optional<GroundPoint> meet_ground(const Ground& ground, const Vec3& origin, const Vec3& direction, float t_max);

/// Share of what the camera sees of it at a point: 1, or less where a floor fades.
float ground_opacity(const Ground& ground, const Vec3& position);

/// 0 under the object, 1 from a little beside it on: where little of the sky is likely to be hidden.
float openness(const Ground& ground, const Vec3& position);

/// Irradiance of a plane that looks up, by exact integrals over the texels.
Color upward_irradiance(const Environment& environment);

}  // namespace sateen
