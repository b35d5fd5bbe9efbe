#pragma once
#include <optional>
#include <string>
#include <vector>

#include "integrator/strategy.h"
#include "scene/scene.h"

namespace sateen {

/// What the pilot found of one number of candidates.
struct CandidateTrial {
  CandidateCounts candidates;
  double squared_error = 0;  ///< E^2 (film/error.h) over the pilot's pixels
  double cost = 0;           ///< of a sample, [ns] of one core where the costs were measured
  /// E^2 at equal time, up to a constant. Where a sample costs less there are more of them, and E^2 of these
  /// sequences falls as about N^-1.25.
  double price() const;
};

/// Into how many directions a point of cloth looks for light, and why.
struct CandidateChoice {
  CandidateCounts candidates = LightSettings().candidates;
  std::string reason;  ///< one phrase for people, with the numbers
  std::vector<CandidateTrial> trials;
};

/// How many candidates of either kind `resampled` wants in this scene (integrator/resample.h): of the map 8, 4 or 16,
/// of the table 8, 4 or 2; none of a map without lights. Where lights make the noise many of the map pay, in a
/// studio; where light comes evenly a pixel wants more places on the cloth instead, velvet under a sky; and wide
/// lobes want few of the table. Tries them, first of the map, then of the table, further as long as that gains, on
/// some thousand pixels spread over the picture, direct light alone, and takes the least error at equal time. Its
/// noise is a tenth, and so little is what a wrong choice costs. Time is counted in rays and candidates at measured
/// costs, never by a clock: the same scene gives the same choice on every machine and any number of threads, and
/// whatever number of samples is asked for, so that ranges of one picture agree. Takes less than a tenth of a
/// CPU-second.
CandidateChoice choose_candidates(const Scene& scene, const LightSettings& light, double error_floor,
                                  std::uint32_t seed, int threads);

/// Sets light.candidates: to what is asked for; else of `resampled` to the pilot's choice, whose reason is returned.
std::string settle_candidates(const Scene& scene, const std::optional<CandidateCounts>& asked, LightSettings& light,
                              double error_floor, std::uint32_t seed, int threads);

/// "resampled, 4 directions of the cloth's table and 16 of the map: ..." for people; of another strategy its name,
/// and no reason where it is empty.
std::string sampling_text(const LightSettings& light, const std::string& reason);

}  // namespace sateen
