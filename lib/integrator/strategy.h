#pragma once
#include <string>
#include <vector>

#include "fabric/fabric.h"

namespace sateen {

/// Ways to estimate the light that the environment sends by way of the cloth. All converge to the same picture.
enum class Strategy {
  uniform,          ///< hemisphere, one shadow ray
  talk,             ///< Wang et al. 2014, one shadow ray
  table,            ///< the direction table, one shadow ray
  environment,      ///< the map by its radiance, one shadow ray
  mis,              ///< table and map, balance heuristic, two shadow rays
  mis_compensated,  ///< table and compensated map, balance heuristic, two shadow rays
  mis_talk,         ///< the talk's sampler and map, balance heuristic, two shadow rays
  resampled,        ///< candidates of table and compensated map, thinned out before and after their shadows
                    ///< (integrator/resample.h)
  automatic         ///< the program's own way: `resampled`, in a study with candidates by the pilot, samples by error
};

const std::vector<std::string>& strategy_names();      ///< in the order of the enum, without `automatic`
Strategy strategy_from_name(const std::string& name);  ///< "auto" is `resampled`; InputError with the nearest name
std::string strategy_name(Strategy strategy);
FabricSampler strategy_sampler(Strategy strategy);  ///< what the fabric view must be prepared for

/// Into how many directions a point of cloth looks for light, for resampling: those that its table proposes, 1 to
/// most_candidates, and those that the compensated map does, from 0.
struct CandidateCounts {
  int table, map;

  constexpr CandidateCounts(int each) : table(each), map(each) {}
  constexpr CandidateCounts(int of_table, int of_map) : table(of_table), map(of_map) {}
  bool operator==(const CandidateCounts&) const = default;
};

inline constexpr int most_candidates = 64;  ///< of a kind

std::string candidates_text(const CandidateCounts& counts);     ///< "8" for both kinds, else "4+16", table first
CandidateCounts candidates_from_text(const std::string& text);  ///< the inverse; InputError with the forms

struct LightSettings {
  Strategy strategy = Strategy::resampled;  ///< least error at equal time, docs/study.md
  CandidateCounts candidates = 8;           ///< by a pilot in render/candidates.h
  int bounces = 0;                          ///< light that meets cloth or ground again, 0 to 64
  /// Share of the samples that follow it, above 0 to 1; their light counts for the others. Light from fold to fold is
  /// smooth and dear: a part of the samples knows it well enough.
  float bounce_share = 1;
  int shadows = 16;  ///< of resampling's candidates that are traced, about, 1 or more; 8 to 24 measure much alike
};

}  // namespace sateen
