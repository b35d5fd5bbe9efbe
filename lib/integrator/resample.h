#pragma once
#include "integrator/light_rays.h"

namespace sateen {

/// Resampled importance sampling (Talbot et al. 2005) over `count` candidates of the table and `count` of the
/// compensated map, target = table density times radiance times how open the direction is, balance weights
/// (cloth-model.md section 6). Unbiased: the table's floor and a least openness keep the target positive wherever the
/// integrand is. LightRays::most of them are kept, by one number that steps evenly through the candidates' weights:
/// shadows are cheap beside a point of cloth and its view, and what keeps one alone leaves the noise of a coin. Where
/// there are no more than that all are kept, and nothing is chosen by chance: plain multiple importance sampling.
/// How many a scene wants: render/candidates.h.
void resample(const Scene& scene, const ClothPoint& point, const TableView& table, Sequence sequence,
              std::uint32_t index, int count, LightRays& out);

}  // namespace sateen
