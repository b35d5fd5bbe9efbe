#pragma once
#include <optional>
#include <vector>

#include "render/compare.h"
#include "render/picture.h"
#include "render/plan.h"

namespace sateen {

/// What one effect costs and what it is worth.
struct BillItem {
  Effect effect = Effect::interreflection;
  std::optional<double> time_share;      ///< of the CPU time of a sample, measured; below 0 where the effect saves
                                         ///< time; empty for parts of the cloth model
  std::optional<double> variance_share;  ///< of E^2; below 0 where the picture has less noise with the effect
  Interval loss;                         ///< E of the picture without it
  double visible = 0;                    ///< largest difference that its absence makes on the display, of 255
  Image without;                         ///< the picture without it, display code values, 3 channels
  Image difference;                      ///< what that changes, `difference_gain` times
};
inline constexpr float difference_gain = 4;

struct Bill {
  Image picture;  ///< small, display code values
  std::vector<BillItem> items;
  double cpu_seconds = 0;
};

struct BillSettings {
  DisplaySettings display;  ///< settled
  float exposure_ev = 0;    ///< errors count as they are shown (film/error.h)
  int columns = 64;         ///< of the small picture; its rows follow from the shape of the whole
  int samples = 32;
};

/// Bills every effect that a rendered scene has, on a grid of its pixels: traces it as it is and without each, with
/// the same random numbers. Parts of the cloth model (lobes, families) are billed by the direct light that comes by
/// way of them. Takes about a CPU-second; nothing of the render itself changes.
Bill make_bill(const Scene& scene, const Plan& plan, const LightSettings& light, const BillSettings& settings,
               const ColorManager& colors, std::uint32_t seed, int threads);

/// An open JSON object's member "bill", without the pictures.
void write_bill(JsonWriter& w, const Bill& bill);

}  // namespace sateen
