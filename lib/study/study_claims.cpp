#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/plot.h"
#include "study/study_analysis.h"

namespace sateen {

namespace {

double slope_of(const StudyResult& result, int scene, Strategy strategy) {
  std::vector<PlotPoint> points;
  for (const CurvePoint& p : study_curve(result, scene, strategy, Measure::relative))
    points.push_back({double(p.samples), p.mse.value});
  return fit_power(points).slope;
}

// What in the scene makes a claim fail. Each sentence rests on a number of this study.
std::string reason(const StudyResult& result, const Claim& claim) {
  const StudyScene& scene = result.scenes[size_t(claim.scene)];
  std::vector<std::string> parts;
  if (scene.light_share < 0.1)
    parts.push_back(fmt::format(
        "half of this light comes from {:.2g} % of the sphere: directions drawn from the cloth alone seldom meet it, "
        "whatever the sampler",
        100 * scene.light_share));
  if (!claim.beats_four) {
    const double slope = slope_of(result, claim.scene, Strategy::uniform);
    if (slope < -1.1)
      parts.push_back(
          fmt::format("uniform's MSE falls as N^{:.1f} here, so 4 times the samples divide it by {:.0f} and not 4",
                      slope, std::pow(4.0, -slope)));
  }
  if (claim.sampler == Strategy::talk && scene.light_share >= 0.1)
    parts.push_back(
        "the talk's density knows neither masking nor Fresnel nor the cloth's horizon: directions below it are "
        "wasted and grazing ones weigh too much");
  return fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace

std::vector<Claim> study_claims(const StudyResult& result) {
  std::vector<Claim> claims;
  for (int i = 0; i < int(result.scenes.size()); ++i) {
    const StudyScene& scene = result.scenes[size_t(i)];
    if (!scene.ladder || !scene.finished) continue;
    const std::vector<CurvePoint> uniform = study_curve(result, i, Strategy::uniform, Measure::relative);
    if (uniform.size() < 3) continue;
    // The largest number of which uniform was measured at four times.
    int samples = 0;
    for (const CurvePoint& p : uniform)
      for (const CurvePoint& q : uniform)
        if (q.samples == 4 * p.samples) samples = p.samples;
    for (const Strategy sampler : {Strategy::talk, Strategy::table}) {
      const Ratio equal = samples_ratio(result, i, sampler, samples, Strategy::uniform, samples, Measure::relative);
      const Ratio four =
          samples_ratio(result, i, sampler, samples, Strategy::uniform, 4 * samples, Measure::relative);
      if (!equal.known || !four.known) continue;
      Claim claim{i, sampler, samples, equal.interval, four.interval};
      claim.quarter = equal.interval.value <= 0.25;
      claim.beats_four = four.interval.value < 1;
      if (!claim.quarter || !claim.beats_four) claim.why = reason(result, claim);
      claims.push_back(claim);
    }
  }
  return claims;
}

std::vector<std::string> claim_reasons(const StudyResult& result) {
  std::vector<std::pair<std::string, std::string>> found;  // reason, where
  for (const Claim& claim : study_claims(result)) {
    if (claim.why.empty()) continue;
    const std::string where =
        fmt::format("{} ({})", result.scenes[size_t(claim.scene)].label(), strategy_name(claim.sampler));
    const auto known =
        std::find_if(found.begin(), found.end(), [&](const auto& each) { return each.first == claim.why; });
    if (known == found.end())
      found.emplace_back(claim.why, where);
    else
      known->second += "; " + where;
  }
  std::vector<std::string> all;
  for (const auto& [why, where] : found) all.push_back(fmt::format("{}. In: {}", why, where));
  return all;
}

}  // namespace sateen
