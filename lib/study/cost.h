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
  int most_samples = 128;  ///< of the error against time
  int price_samples = 32;  ///< of every setting
  int pixels = 160 * 90;   ///< measured on a smaller picture of about so many pixels; times are scaled to the whole
  int seeds = 3;           ///< of the error against time
};

/// Error and time of whole pictures at one number of samples.
struct CostPoint {
  int samples = 0;
  double cpu_seconds = 0;    ///< of the picture as asked, scaled from the measured one; least of the seeds
  Interval true_error;       ///< E against the reference, over the seeds
  double claimed_error = 0;  ///< E as the program says it, mean of the seeds
};

/// One setting of an approximation.
struct Price {
  std::string setting;             ///< "level 2"
  std::vector<std::string> flags;  ///< that ask for it on the command line; empty where there are none
  double cpu_seconds = 0;          ///< of the picture as asked, at CostSettings::price_samples; least of the renders
  double setup_seconds = 0;        ///< CPU-seconds before the first sample for what the setting decides over
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
};

/// What to render with for a quality, by the prices.
struct Quality {
  std::string name;   ///< "draft", "preview", "final"
  double target = 0;  ///< E, noise and bias together
  bool reached = false;
  int samples = 0;
  std::vector<int> chosen;  ///< a setting of every list; -1 where the list is not advised
  std::string flags;        ///< "--spp 32 --level 1 --bounces 2"
  double noise = 0, bias = 0, cpu_seconds = 0;
};

struct CostResult {
  CostSettings settings;
  std::vector<std::string> warnings;
  int width = 0, height = 0, level = 0, reference_samples = 0;
  double scale = 1;  ///< pixels asked over pixels measured
  PictureMse reference_error;
  std::vector<CostPoint> points;
  PowerFit fit;  ///< true E against CPU-seconds
  std::vector<PriceList> lists;
  Plan plan;  ///< for E 1 %; the effects of all pictures
  Bill bill;
  std::vector<Quality> qualities;
  std::vector<PlotPoint> frontier;  ///< E against CPU-seconds over all combinations of settings
  std::vector<std::pair<std::string, Image>> ladder_pictures;
  double cpu_seconds = 0;
  bool interrupted = false;
};

/// Measures it. Stops where `interrupt` rises; what is finished by then is in the result.
CostResult measure_cost(const CostSettings& settings, const ColorManager& colors,
                        const std::function<void(const StudyState&)>& observe = {},
                        const std::atomic<bool>* interrupt = nullptr);

/// CPU-seconds until E is `error`, by the fit; 0 where there is none.
double seconds_for_error(const CostResult& result, double error);

/// Fills in PriceList::enough, qualities and frontier from what was measured.
void settle_advice(CostResult& result);

}  // namespace sateen
