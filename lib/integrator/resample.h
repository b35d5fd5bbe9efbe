#pragma once
#include "integrator/light_rays.h"

namespace sateen {

/// Of a point's candidates that are open F is evaluated for at most so many: measured, 2 to 4 are much alike.
inline constexpr int most_evaluations = 3;

/// Resampled importance sampling (Talbot et al. 2005) over candidates of the table and of the compensated map with
/// balance weights (cloth-model.md section 6). What they are worth is the table's density times
/// radiance times weight, and the guide to open directions (scene/openness.h) gives the odds. Up to eight are all
/// proposed: plain multiple importance sampling. More are thinned out to about settings.shadows by `u`. How many of
/// each kind a scene wants: render/candidates.h; powers of two keep the sequences' strata whole.
void propose_candidates(const Scene& scene, const ClothPoint& point, const TableView& table, Sequence sequence,
                        std::uint32_t index, const LightSettings& settings, double u, LightRays& out);

/// Keeps the rays that are worth, times their odds, at least the `most`-th part of all together, as they are; of the
/// others by one number that steps evenly through what they are worth, each that is kept with the light of what it
/// stands for. Light has the expectation of all rays together; the table's floor and the least odds keep a ray's
/// worth positive wherever it brings light. Moves what is kept to the front and returns how many: at most `most`,
/// fewer where a few are worth more than the others together.
size_t thin_out(std::span<LightRay> rays, int most, double u);

}  // namespace sateen
