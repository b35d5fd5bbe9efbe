#pragma once

namespace sateen {

/// Threshold in (0, 1) of the fixed dither pattern at a pixel: a 32 x 32 blue-noise tile (void and cluster, Ulichney
/// 1993), shifted for each of the three colour channels so that they do not round together.
float dither_threshold(int x, int y, int channel);

}  // namespace sateen
