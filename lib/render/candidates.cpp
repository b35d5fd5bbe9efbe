#include "render/candidates.h"

#include <fmt/format.h>

#include <cmath>

#include "render/compare.h"
#include "render/ray_time.h"

namespace sateen {

namespace {

constexpr int pilot_samples = 16;

/// Adds a trial; the errors of all become those that they show together.
void try_candidates(const Scene& scene, LightSettings light, const CandidateCounts& candidates, double error_floor,
                    std::uint32_t seed, int threads, std::vector<CandidateTrial>& trials,
                    std::vector<GridPicture>& pictures) {
  PixelGrid grid;
  grid.samples = pilot_samples;
  light.candidates = candidates;
  light.bounces = 0;
  pictures.push_back(trace_picture(scene, light, seed, grid, threads));
  const double rays = direct_time(pictures.back().work.rays, light);
  trials.push_back({candidates, 0, 1e9 * rays / (double(grid.pixels()) * grid.samples)});
  for (size_t k = 0; k < trials.size(); ++k)
    trials[k].squared_error = relative_variance(pictures[k], pictures, error_floor);
}

}  // namespace

double CandidateTrial::price() const {
  return squared_error * std::pow(cost, 1.25);
}

CandidateChoice choose_candidates(const Scene& scene, const LightSettings& light, double error_floor,
                                  std::uint32_t seed, int threads) {
  CandidateChoice choice;
  std::vector<CandidateTrial>& trials = choice.trials;
  std::vector<GridPicture> pictures;
  size_t least = 0;
  const auto best = [&] { return trials[least].candidates; };
  const auto gains = [&](const CandidateCounts& candidates) {
    try_candidates(scene, light, candidates, error_floor, seed, threads, trials, pictures);
    if (trials.size() > 1 && !(trials.back().price() < trials[least].price())) return false;
    least = trials.size() - 1;
    return true;
  };
  const CandidateCounts usual = LightSettings().candidates;
  // Nothing of a map without lights stands out: it proposes none.
  const bool has_lights = drawable(scene.environment.by_compensated);
  gains({usual.table, has_lights ? usual.map : 0});
  if (!(trials[0].price() > 0)) {
    choice.candidates = best();
    choice.reason = "the pilot met no noise";
    return choice;
  }
  if (has_lights && !gains({usual.table, usual.map / 2})) gains({usual.table, 2 * usual.map});
  if (gains({usual.table / 2, best().map})) gains({usual.table / 4, best().map});
  choice.candidates = best();
  for (const CandidateTrial& trial : trials)
    if (&trial != &trials[least])
      choice.reason += fmt::format("{}{} would have {:.2f}", choice.reason.empty() ? "" : ", ",
                                   candidates_text(trial.candidates), trial.price() / trials[least].price());
  choice.reason += " times the squared error at equal time";
  return choice;
}

std::string settle_candidates(const Scene& scene, const std::optional<CandidateCounts>& asked, LightSettings& light,
                              double error_floor, std::uint32_t seed, int threads) {
  if (asked) light.candidates = *asked;
  if (asked || light.strategy != Strategy::resampled) return {};
  const CandidateChoice choice = choose_candidates(scene, light, error_floor, seed, threads);
  light.candidates = choice.candidates;
  return choice.reason;
}

std::string sampling_text(const LightSettings& light, const std::string& reason) {
  if (light.strategy != Strategy::resampled) return strategy_name(light.strategy);
  const CandidateCounts& n = light.candidates;
  return fmt::format("{}, {} directions of the cloth's table{}{}{}", strategy_name(light.strategy), n.table,
                     n.map > 0 ? fmt::format(" and {} of the map", n.map) : "", reason.empty() ? "" : ": ", reason);
}

}  // namespace sateen
