#pragma once
#include <array>

#include "math/vector.h"

namespace sateen {

/// Pixel filter by importance sampling (Ernst, Stamminger, Greiner 2006): every sample belongs to one pixel and weighs
/// 1, so pixels stay independent. Blackman-Harris over 3 x 3 pixels: nearly a Gaussian of 0.44 pixels, without its tail.

/// Offset from the pixel's centre in pixels, each coordinate in [-1.5, 1.5].
Vec2 sample_filter(const std::array<double, 2>& u);

}  // namespace sateen
