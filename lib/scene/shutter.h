#pragma once
#include <span>

#include "sampling/sampler.h"
#include "scene/ray_tracer.h"

namespace sateen {

/// A turn about a vertical axis; positive walks a camera to the right around the object.
struct YTurn {
  float cosine = 1, sine = 0;
};
inline YTurn turn_by(double radians) {
  return {float(std::cos(radians)), float(std::sin(radians))};
}
inline Vec3 turned(const Vec3& v, const YTurn& t) {
  return {v.x * t.cosine + v.z * t.sine, v.y, v.z * t.cosine - v.x * t.sine};
}
inline Vec3 turned_back(const Vec3& v, const YTurn& t) {
  return turned(v, {t.cosine, -t.sine});
}

/// While the shutter is open the object or the camera turns at an even speed about the vertical axis through `pivot`;
/// the middle of the turn is the pose of the still. The mesh stands still in the ray tracer: a sample of a turning
/// object is traced in the object's own frame, and its directions are turned into the world's for light, ground and
/// backdrop. Light and ground do not turn.
struct Shutter {
  Vec3 pivot{0, 0, 0};
  float object_angle = 0, camera_angle = 0;  ///< radians from opening to closing

  Vec3 to_world(const Vec3& point, const YTurn& t) const { return pivot + turned(point - pivot, t); }
  Vec3 to_object(const Vec3& point, const YTurn& t) const { return pivot + turned_back(point - pivot, t); }
};

/// Where things stand at the time of each sample (`time` in [0, 1)): camera rays are turned with the camera, and what
/// is traced are the same rays as the turned object sees them.
struct MovingRays {
  std::array<YTurn, batch_size> object;
  std::array<Ray, batch_size> traced;
};
void open_shutter(const Shutter& shutter, const Batch1& time, std::span<Ray> rays, MovingRays& moving);

}  // namespace sateen
