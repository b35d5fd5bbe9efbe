#pragma once
#include <functional>
#include <string>

#include "integrator/made_scenes.h"
#include "statistics/z_test.h"

// Values that a picture must have, found without any of the renderer's sampling: by quadrature or in closed form.

namespace sateen_test {

/// F of a fabric for directions of the cloth frame.
sateen::Color scattered(const sateen::Fabric& fabric, const sateen::Vec3& wi, const sateen::Vec3& wo);

/// Integral of F over the hemisphere by midpoints in theta and phi; error below `quadrature_error` of it.
sateen::Color reflectance(const sateen::Fabric& fabric, const sateen::Vec3& wo);
inline constexpr double quadrature_error = 3e-4;

/// A map of one lit texel.
struct Sun {
  int width = 64, height = 32, x = 0, y = 0;
  float radiance = 100;

  sateen::Environment map(float rotation = 0) const;
  double solid_angle() const;
  /// Direction to a place in the texel, 0 to 1 each, uniform in solid angle, as scene/environment.h lays maps out.
  sateen::Vec3 direction(double across, double down) const;
  /// Integral of radiance times `value` over the texel, by n x n midpoints.
  sateen::Color integral(const std::function<sateen::Color(const sateen::Vec3&)>& value, int n = 64) const;
};

/// Mean of one pixel in 16 batches.
struct Estimate {
  Batches channel[3];
  double alpha = 0;
  sateen::Vec3d backdrop{0, 0, 0}, indirect{0, 0, 0};
};
Estimate estimate(const sateen::Scene& scene, const sateen::LightSettings& light, int samples);

/// Fails where a channel is off by more than `deviate` standard errors and more than `slack` of the value.
void expect_value(const Estimate& got, const sateen::Color& expected, double deviate, double slack,
                  const std::string& what);

}  // namespace sateen_test
