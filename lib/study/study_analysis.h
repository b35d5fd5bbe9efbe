#pragma once
#include <string>
#include <vector>

#include "study/study.h"

namespace sateen {

/// Which of the two mean squared errors is looked at.
enum class Measure { relative, absolute };
double value_of(const PictureMse& mse, Measure measure);

/// One strategy in one scene at one number of samples: mean over the seeds.
struct CurvePoint {
  int samples = 0;
  double cpu_seconds = 0;  ///< mean
  Interval mse;
};
std::vector<CurvePoint> study_curve(const StudyResult& result, int scene, Strategy strategy, Measure measure);

/// Samples that the strategy has taken after so many CPU-seconds, between the numbers that were measured (median over
/// the seeds) or beyond them. Samples dealt out by error grow dearer with their number, as they go to cloth and
/// folds: no price a sample would do. 0 where nothing was measured or times do not grow.
double samples_at_time(const StudyResult& result, int scene, Strategy strategy, double cpu_seconds);

/// MSE at a number of samples: mean over the seeds, but for seed `without`. 0 where it was not measured.
double mse_at_samples(const StudyResult& result, int scene, Strategy strategy, int samples, Measure measure,
                      int without = 0);

/// MSE at a CPU time, by the straight line in logarithms between the two measured sample numbers about it. 0 where
/// the strategy was not measured there.
double mse_at_time(const StudyResult& result, int scene, Strategy strategy, double cpu_seconds, Measure measure,
                   int without = 0);

/// The common CPU time of a scene: that of mis-compensated at StudySettings::samples.
double common_time(const StudyResult& result, int scene);

/// A number of samples that is not measured and is wanted so that the measured ones lie about the common time: twice
/// the largest or half the smallest. 0 where they do lie about it, or there are none.
int missing_samples(const StudyResult& result, int scene, Strategy strategy);

/// MSE of `above` over that of `below` at equal CPU time; the interval is over the seeds.
struct Ratio {
  bool known = false;
  Interval interval{};
};
Ratio equal_time_ratio(const StudyResult& result, int scene, Strategy above, Strategy below, Measure measure);
/// The same at numbers of samples, which may differ.
Ratio samples_ratio(const StudyResult& result, int scene, Strategy above, int above_samples, Strategy below,
                    int below_samples, Measure measure);

/// The strategy of least MSE at equal CPU time in a scene, and whether its lead over the second is beyond chance (the
/// interval of their ratio is below 1).
struct Winner {
  bool known = false, clear = false;
  Strategy strategy = Strategy::uniform, second = Strategy::uniform;
};
Winner scene_winner(const StudyResult& result, int scene, Measure measure);

/// One bar: a ratio that must not be passed.
struct Bar {
  std::string what;  ///< "mis-compensated over uniform, equal CPU time, geometric mean of 18 scenes"
  double limit = 0;
  Interval found;
  bool passed = false;
};
std::vector<Bar> study_bars(const StudyResult& result);

/// The talk's two claims in one scene, for one importance sampler.
struct Claim {
  int scene = 0;
  Strategy sampler = Strategy::talk;
  int samples = 0;
  Interval equal, against_four;  ///< MSE over uniform's at equal samples, and at 4 times uniform's
  bool quarter = false, beats_four = false;
  std::string why{};  ///< where one fails: what in the scene makes it so
};
std::vector<Claim> study_claims(const StudyResult& result);

/// Why claims fail: every reason once, with the scenes and samplers that it holds for.
std::vector<std::string> claim_reasons(const StudyResult& result);

}  // namespace sateen
