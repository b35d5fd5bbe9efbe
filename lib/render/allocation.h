#pragma once
#include <cstdint>
#include <vector>

#include "film/error.h"

namespace sateen {

/// A window of the picture in pixels, x0 <= x < x1.
struct Crop {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};
/// The part of it that lies in the picture; the whole picture for an empty one.
Crop clipped(const Crop& crop, int width, int height);

/// Where a render looks at its error and deals samples out anew, in mean samples a pixel: 16, 32 ... 1024, then steps
/// of about 1/32. A fixed row, so that neither time nor threads nor interruption decides over a bit.
int next_barrier(int samples);

/// How many samples each pixel shall have in all once the mean is `barrier`. Uniform: that many everywhere.
/// Adaptive: in proportion to sqrt(coverage * variance of one sample / (value^2 + floor^2)), which makes E least,
/// each of them the mean over the 24 pixels around a pixel WITHOUT the pixel itself: were its own samples to decide
/// how many it gets, those that look wrong would be outweighed more often than others, and its mean would be biased.
/// Nowhere fewer than there are, nor fewer than 1/16 of the mean; powers of two and one and a half times those, where
/// the sequences are even. Outside the window 0.
std::vector<std::uint32_t> allocate(const Film& film, const Crop& window, int barrier, bool adaptive,
                                    const ErrorScale& scale = {});

/// Mean over the pixels with samples of those that went where there is noise: above a thousandth of its mean.
double useful_samples(const Film& film, const std::vector<PixelError>& errors);

/// Samples of a pixel on the way to its `target` at `barrier` when the mean passes `samples`.
std::uint32_t part_of_target(std::uint32_t target, int samples, int barrier);

}  // namespace sateen
