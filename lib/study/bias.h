#pragma once
#include "image/color.h"
#include "render/picture.h"
#include "study/measure.h"

namespace sateen {

/// How far a cheap setting is from a fine one, with the noise of both taken out: two pairs of pictures with seeds A
/// and B. In the product of both differences, noise that the seeds do not share has no expectation.
struct Bias {
  Interval error;      ///< as E: sqrt of mean (cheap - fine)^2 / (fine^2 + floor^2); low is 0 where noise hides it
  double visible = 0;  ///< largest difference in 8-bit code values, means over 4 x 4 pixels, that both pairs agree on
};
struct FilmPair {
  const Film &a, &b;
};
Bias measure_bias(const FilmPair& cheap, const FilmPair& fine, const ColorManager& colors,
                  const DisplaySettings& display, float exposure_ev);

/// Whether two films hold the same light, bit for bit.
bool same_bits(const Film& a, const Film& b);

}  // namespace sateen
