#pragma once
#include <functional>
#include <string>
#include <vector>

#include "render/plan.h"

namespace sateen {

/// How one effect that a plan ruled out fared once it was switched on.
struct Verdict {
  Effect effect = Effect::interreflection;
  bool tested = false;  ///< false: the scene does not have it, so there is nothing to switch on
  Interval loss;        ///< E between the picture with and without it
  enum class Outcome { right, undecided, wrong } outcome = Outcome::right;
  std::string note;
};

/// Checks a plan: traces pixels spread over the picture (other ones than the pilot's, many more samples) as planned
/// and with each effect that the plan ruled out by itself switched on, the same random numbers in both, and compares.
/// `wrong`: the difference is above the plan's error with 97.5 % confidence; `undecided`: it may be. `scene` has
/// everything that its settings describe, as for make_plan(). An effect that the user switched off is tested too, for
/// the record: its outcome is always right.
std::vector<Verdict> verify_plan(const Scene& scene, const Plan& plan, const LightSettings& light, double error_floor,
                                 std::uint32_t seed, int threads, const std::function<void(double)>& tell = {});

/// An open JSON object's member "verified".
void write_verdicts(JsonWriter& w, const std::vector<Verdict>& verdicts);

}  // namespace sateen
