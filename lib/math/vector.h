#pragma once
#include <Imath/ImathColor.h>
#include <Imath/ImathVec.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sateen {

using Vec2 = Imath::V2f;
using Vec3 = Imath::V3f;
using Vec3d = Imath::V3d;
using Color = Imath::C3f;  ///< scene-linear RGB; the space is said where it is stored

inline constexpr float pi = std::numbers::pi_v<float>;

inline float dot(const Vec3& a, const Vec3& b) { return a.dot(b); }
inline Vec3 cross(const Vec3& a, const Vec3& b) { return a.cross(b); }
inline float length(const Vec3& a) { return std::sqrt(dot(a, a)); }
inline Vec3 normalize(const Vec3& a) { return a / length(a); }
inline float max_component(const Color& c) { return std::max({c.x, c.y, c.z}); }
inline float mean_component(const Color& c) { return (c.x + c.y + c.z) * (1.0f / 3.0f); }
inline float radians(float degrees) { return degrees * (pi / 180.0f); }
inline float degrees(float radians) { return radians * (180.0f / pi); }

}  // namespace sateen
