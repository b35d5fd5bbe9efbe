#pragma once
#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "image/color.h"
#include "study/measure.h"
#include "study/thread_sampling.h"

namespace sateen {

/// One thread by the talk's sampler against uniform directions over the sphere, by quadrature.
struct ThreadRow {
  std::string look;
  bool warp = true;
  double gamma_s_deg = 0, gamma_v_deg = 0;
  VolumeAzimuth azimuth = VolumeAzimuth::flat;
  LobeChoice choice = LobeChoice::half;
  std::vector<double> ratios;  ///< of variance, a view of thread_views_deg() a place
};
const std::vector<double>& thread_views_deg();  ///< inclinations of the view to the thread
std::vector<ThreadRow> thread_rows(const std::vector<std::string>& looks);

/// MSE of the talk's sampler over that of uniform directions in one picture: at equal samples, and with a quarter of
/// uniform's.
struct TalkRatios {
  Interval equal, against_four;
};

/// One of the talk's figures: a look on the skirt, of bare threads and of whole cloth.
struct TalkFigure {
  std::string look, light;
  int bounces = 0;
  TalkRatios threads;  ///< uniform over the sphere, samples independent of each other
  TalkRatios cloth;    ///< as the program renders, uniform over the hemisphere, sequences of low discrepancy
};

struct TalkFigureSettings {
  std::vector<std::string> looks;
  int columns = 48, rows = 48, seeds = 4, samples = 16;  ///< samples: the larger of two numbers, the other a quarter
  int threads = 0;
};
std::vector<TalkFigure> talk_figures(const TalkFigureSettings& settings, const ColorManager& colors,
                                     const std::function<void()>& tell, const std::atomic<bool>* interrupt);

/// Pictures of the skirt of bare threads at equal samples, and their reference; display-referred.
std::vector<std::pair<std::string, Image>> thread_pictures(const std::string& look, int size, int samples,
                                                           int threads, const ColorManager& colors);

}  // namespace sateen
