#include "study/thread_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/parallel.h"
#include "fabric/tangent_curve.h"
#include "math/frame.h"
#include "sampling/split_mix.h"
#include "scene/surface.h"

namespace sateen {

namespace {
constexpr double pi_d = std::numbers::pi;

using Random = SplitMix;  // every sample has its own stream

struct Family {
  const ThreadFamily* authored;
  Thread thread;
};

/// A thread at a point: t along it, the two across, in the world.
struct Placed {
  const Family* family;
  Vec3 along, normal, binormal;
};

struct Angles {
  double theta, phi;
};
Angles angles_on(const Placed& p, const Vec3& w) {
  return {std::asin(std::clamp(double(dot(w, p.along)), -1.0, 1.0)),
          std::atan2(double(dot(w, p.binormal)), double(dot(w, p.normal)))};
}

Vec3 direction_on(const Placed& p, double theta, double phi) {
  const double across = std::cos(theta);
  return p.along * float(std::sin(theta)) + p.normal * float(across * std::cos(phi)) +
         p.binormal * float(across * std::sin(phi));
}

class Tracer {
 public:
  Tracer(const Scene& scene, const Look& look, const ThreadPicture& picture) : scene_(scene), picture_(picture) {
    families_[0] = {&look.warp, thread_of(look.warp)};
    families_[1] = {&look.weft, thread_of(look.weft)};
    warp_share_ = double(look.warp.coverage) / (double(look.warp.coverage) + double(look.weft.coverage));
    warp_angle_ = double(look.warp_angle_deg) * pi_d / 180;
  }

  Color sample(const Ray& ray, const Hit& first, Random& random) const {
    Color weight(1), light(0);
    Vec3 direction = ray.direction;
    Hit hit = first;
    for (int bounce = 0; bounce <= picture_.bounces; ++bounce) {
      const SurfacePoint point = surface_point(*scene_.mesh, hit);
      const Placed placed = place(point, direction, random);
      weight *= scatter(placed, direction, random);
      if (!(weight.x + weight.y + weight.z > 0)) return light;
      const std::optional<Hit> next =
          scene_.rays->closest_hit({offset_origin(point, direction), direction, 0, far_away});
      if (!next) return weight * environment_radiance(scene_.environment, direction);
      hit = *next;
    }
    return light;
  }

 private:
  Placed place(const SurfacePoint& point, const Vec3& direction, Random& random) const {
    // The side that is looked at is the thread's own.
    const Vec3 normal = dot(point.normal, direction) > 0 ? point.normal * -1.0f : point.normal;
    const Frame frame =
        frame_from(normal, point.dpdu * float(std::cos(warp_angle_)) + point.dpdv * float(std::sin(warp_angle_)));
    const bool warp = random.uniform() < warp_share_;
    const Family& family = families_[warp ? 0 : 1];
    const double offset = tangent_offset(family.authored->offsets_deg, family.authored->lengths, random.uniform());
    const Vec3 d = warp ? frame.x : frame.y, b = warp ? frame.y : frame.x * -1.0f;
    const float c = float(std::cos(offset)), s = float(std::sin(offset));
    return {&family, d * c + normal * s, normal * c - d * s, b};
  }

  /// Draws where the light comes from and gives f cos theta_i over its density.
  Color scatter(const Placed& placed, Vec3& direction, Random& random) const {
    const Angles view = angles_on(placed, normalize(direction) * -1.0f);
    const ThreadSampler sampler =
        thread_sampler(placed.family->thread, view.theta, picture_.azimuth, picture_.choice);
    const double which = random.uniform();
    const std::array<double, 3> u{random.uniform(), random.uniform(), random.uniform()};
    const bool uniform =
        picture_.strategy == ThreadStrategy::uniform || (picture_.strategy == ThreadStrategy::both && which < 0.5);
    const ThreadDirection drawn =
        uniform ? ThreadDirection{std::asin(2 * u[1] - 1), pi_d * (2 * u[2] - 1)} : sample_thread(sampler, u);
    const double even = 1 / (4 * pi_d);
    const double density = picture_.strategy == ThreadStrategy::uniform ? even
                           : picture_.strategy == ThreadStrategy::talk
                               ? thread_pdf(sampler, drawn.theta, drawn.phi_d)
                               : (even + thread_pdf(sampler, drawn.theta, drawn.phi_d)) / 2;
    direction = direction_on(placed, drawn.theta, view.phi + drawn.phi_d);
    if (!(density > 0)) return Color(0);
    Thread white = placed.family->thread;
    white.albedo = 1;
    const ThreadLight light = thread_light(white, view.theta, drawn.theta, drawn.phi_d);
    const Color& a = placed.family->authored->A.value;
    return (Color(float(light.surface)) + a * float(light.volume)) * float(1 / density);
  }

  const Scene& scene_;
  const ThreadPicture& picture_;
  Family families_[2];
  double warp_share_ = 1, warp_angle_ = 0;
};

}  // namespace

Film render_threads(const Scene& scene, const Look& look, const ThreadPicture& picture) {
  const Tracer tracer(scene, look, picture);
  Film film(scene.camera.width, scene.camera.height, false);
  parallel_for(film.height, thread_count(picture.threads), [&](int y) {
    for (int x = 0; x < film.width; ++x) {
      const size_t place = size_t(y) * size_t(film.width) + size_t(x);
      const Ray ray = scene.camera.ray(float(x) + 0.5f, float(y) + 0.5f);
      const std::optional<Hit> hit = scene.rays->closest_hit(ray);
      for (int n = 0; n < picture.samples; ++n) {
        Random random{(std::uint64_t(picture.seed) << 40) ^ (std::uint64_t(place) << 16) ^ std::uint64_t(n)};
        random.uniform();
        add_sample(film.pixels[place], hit ? tracer.sample(ray, *hit, random) : Color(0), hit ? 1.0f : 0.0f,
                   film.grain);
      }
    }
  });
  return film;
}

}  // namespace sateen
