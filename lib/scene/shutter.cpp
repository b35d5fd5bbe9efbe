#include "scene/shutter.h"

namespace sateen {

void open_shutter(const Shutter& shutter, const Batch1& time, std::span<Ray> rays, MovingRays& moving) {
  for (size_t k = 0; k < rays.size(); ++k) {
    const double place = time[k] - 0.5;
    Ray& ray = rays[k];
    const YTurn walk = turn_by(place * double(shutter.camera_angle));
    ray.origin = shutter.to_world(ray.origin, walk);
    ray.direction = turned(ray.direction, walk);
    const YTurn object = turn_by(place * double(shutter.object_angle));
    moving.object[k] = object;
    moving.traced[k] = ray;
    moving.traced[k].origin = shutter.to_object(ray.origin, object);
    moving.traced[k].direction = turned_back(ray.direction, object);
  }
}

}  // namespace sateen
