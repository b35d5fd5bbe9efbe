#pragma once
#include <array>
#include <span>
#include <string>

#include "film/error.h"

namespace sateen {

/// One pixel of a picture and what it would lose, as means of its independent replicates.
struct PixelLoss {
  std::array<Vec3d, replicates> lost{Vec3d(0), Vec3d(0), Vec3d(0), Vec3d(0)};
  Vec3d value{0, 0, 0};  ///< of the whole picture
  double weight = 1;     ///< how much is rendered there: alpha, 0 to 1
};

/// Mean over the channels of square / (value^2 + error_floor^2): what a pixel adds to E^2 (film/error.h).
double relative_square(const Vec3d& square, const Vec3d& value, double error_floor);

/// How far the picture would be off without it, as E is: the root of the mean of lost^2 / (value^2 + error_floor^2)
/// over what is rendered. The square comes from products of different replicates, so that noise does not count as
/// loss; below 0, which chance may bring, it is 0. The interval takes the pixels for a random choice from the
/// picture.
Interval picture_loss(std::span<const PixelLoss> pixels, double error_floor);

/// Share of the picture's light that would be lost, mean of the channels; its interval in the same way.
Interval light_share(std::span<const PixelLoss> pixels);

/// "15 % (12.4 to 17.5)" of an interval of shares.
std::string percent_text(const Interval& share);

}  // namespace sateen
