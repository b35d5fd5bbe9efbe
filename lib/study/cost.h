#pragma once
#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "render/bill.h"
#include "render/render.h"
#include "report/plot.h"
#include "study/bias.h"
#include "study/study.h"

namespace sateen {

/// What the price list of one scene covers.
struct CostSettings {
  SceneSettings scene;  ///< as it will be rendered
  LightSettings light;
  EffectSwitches effects;
  DisplaySettings display;           ///< settled
  std::optional<float> exposure_ev;  ///< empty: metered
  std::uint32_t seed = 1;
  int threads = 0;
  bool layers = true, albedo_layer = true;  ///< pictures are rendered with the layers of an EXR
  double program_seconds = 0;               ///< CPU-seconds of the program before, a part of every render
  int most_samples = 128;                   ///< of the error against time
  int price_samples = 32;                   ///< of every setting
  int pixels = 160 * 90;  ///< measured on a smaller picture of about so many pixels; times are scaled to the whole
  int seeds = 3;          ///< repetitions of everything, that intervals come from
};

/// CPU-seconds, everywhere here, are those of a whole `sateen render` of the picture as asked: start of the program,
/// mesh, cloth and map, pilots, samples, files. E, everywhere here, is noise and what the settings are off by (bias),
/// in one: the root of the sum of their squares.

/// Error and time of whole pictures with the settings as asked at one number of samples.
struct CostPoint {
  int samples = 0;
  Interval cpu_seconds;      ///< whole render
  Interval noise;            ///< E against a reference with the same settings, over the seeds
  double claimed_error = 0;  ///< E as the program says it, mean of the seeds
  double error = 0;          ///< noise, and what the settings as asked are off by
};

/// CPU-seconds of a whole render that its samples have no part in, with the settings as asked.
struct StartPrice {
  Interval program, assembly, pilots, albedo_table, writing;
  double seconds() const {
    return program.value + assembly.value + pilots.value + albedo_table.value + writing.value;
  }
  double scatter() const;  ///< of seconds(), half of its 95 % interval
};

/// One setting of an approximation. Factors are against the setting that is asked for, measured side by side.
struct Price {
  std::string setting;             ///< "level 2"
  std::vector<std::string> flags;  ///< that ask for it on the command line; empty where there are none
  bool asked = false;
  Interval cpu_seconds;            ///< whole render at CostSettings::price_samples
  double start_seconds = 0;        ///< of it, before the first sample and after the last
  Interval time_factor{1, 1, 1};   ///< of a sample's time
  Interval noise_factor{1, 1, 1};  ///< of the noise at equal samples
  double noise = 0;                ///< E at price_samples: as claimed; true where `biased` is false
  Bias bias;                       ///< against the finest setting; zero where there is none
  Image picture;                   ///< display-referred
};
struct PriceList {
  std::string name;        ///< "subdivision level"
  bool biased = true;      ///< false: all settings converge to the same picture, and noise^2 x time decides
  bool has_finest = true;  ///< false: none is finer than another, as of strategies, and no bias is measured
  bool advised = true;  ///< the qualities choose from it; not where that gains nothing, or another list holds it too
  std::vector<Price> prices = {};  ///< cheapest first, the finest last
  int enough = -1;                 ///< the first setting that more buys nothing over
  std::string note = {};

  int asked() const;  ///< place of the setting that is asked for; -1
};

/// What to render with for a quality, by the prices, and what came of it.
struct Quality {
  std::string name;   ///< "draft", "preview", "final"
  double target = 0;  ///< E, noise and bias together
  bool reached = false;
  int samples = 0;
  std::vector<int> chosen;  ///< a setting of every list; -1 where the list is not advised
  std::string flags;        ///< added to those of the picture: "--spp 32 --level 1"; settings as asked need none
  double noise = 0, bias = 0, cpu_seconds = 0;  ///< forecast
  double error() const;                         ///< forecast E

  bool measured = false;  ///< rendered with these flags, at the measured size
  Interval measured_error, measured_seconds;
};

struct CostResult {
  CostSettings settings;
  std::vector<std::string> warnings;
  int width = 0, height = 0, level = 0, reference_samples = 0;
  double scale = 1;        ///< pixels asked over pixels measured
  double error_floor = 0;  ///< of E, in the light of the scene
  PictureMse reference_error;
  StartPrice start;
  std::vector<CostPoint> points;
  PowerFit fit;  ///< noise against the CPU-seconds of the samples alone
  std::vector<PriceList> lists;
  Plan plan;                  ///< for E 1 %; the effects of all pictures
  std::string effects_flags;  ///< that ask for them where `sateen render` of a number of samples plans others
  Bill bill;
  std::vector<Quality> qualities;
  std::vector<Quality> frontier;  ///< the least CPU-seconds for every E, finest first
  std::vector<std::pair<std::string, Image>> ladder_pictures;
  double cpu_seconds = 0;
  bool interrupted = false;
};

/// Measures it. Stops where `interrupt` rises; what is finished by then is in the result.
CostResult measure_cost(const CostSettings& settings, const ColorManager& colors,
                        const std::function<void(const StudyState&)>& observe = {},
                        const std::atomic<bool>* interrupt = nullptr);

/// CPU-seconds of samples until the noise is `error`, by the fit; 0 where there is none.
double seconds_for_noise(const CostResult& result, double error);

/// Fills in CostPoint::error, PriceList::enough, qualities and frontier from what was measured. Qualities are
/// ordered: of a coarser one no setting, no number of samples and no price is above a finer one's, nor E below it. A
/// setting that is not asked for is taken where it is cheaper beyond the intervals of both; ties stay with what is
/// asked for.
void settle_advice(CostResult& result);

}  // namespace sateen
