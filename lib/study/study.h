#pragma once
#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "integrator/strategy.h"
#include "study/measure.h"
#include "study/study_scene.h"
#include "study/thread_study.h"

namespace sateen {

/// What a study of the sampling strategies covers. Every look is seen under every light.
struct StudySettings {
  SceneSettings scene;  ///< mesh, camera, size; look and light are set from the lists
  std::vector<std::string> looks = study_looks(), lights = study_lights();
  int seeds = 4;    ///< independent repetitions that intervals come from, at least 2
  int samples = 0;  ///< of mis-compensated, whose time is the equal time; 0: as many as `cpu_seconds` allow, 8 to 64
  double cpu_seconds = 3600;  ///< about what the whole may take
  bool pictures = true;
  int threads = 0;
  int picture_width = 256, picture_height = 144;
};

/// One render, measured.
struct StudyRun {
  int scene = 0;  ///< place in StudyResult::scenes
  Strategy strategy = Strategy::uniform;
  int samples = 0, seed = 0;
  double cpu_seconds = 0;
  PictureMse mse;
};

/// A look under a light, with or without bounces.
struct StudyScene {
  std::string look, light;
  int bounces = 0;
  bool all_strategies = false;  ///< measured with all of them at equal time; else `uniform`, `talk`, `table` alone
  bool ladder = false;          ///< measured at growing samples: one of the talk's figures
  int reference_samples = 0;
  PictureMse reference_error{};                             ///< Reference::own
  double light_share = 0;                                   ///< half_light_share()
  CandidateCounts candidates = LightSettings().candidates;  ///< that `automatic` settled on
  bool finished = false;

  std::string label() const;  ///< "velvet, overcast", "velvet, overcast, 2 bounces"
};

/// Pictures of one scene, display-referred.
struct StudyPicture {
  int scene = 0;
  std::string label;  ///< "uniform, 16 samples"
  bool equal_time = false, reference = false;
  Image image;
};

struct StudyResult {
  StudySettings settings;  ///< with `samples` settled and only the lights that are there
  std::vector<StudyScene> scenes;
  std::vector<StudyRun> runs;
  std::vector<StudyPicture> pictures;
  std::vector<ThreadRow> thread_rows;    ///< the talk's claims of single threads, by quadrature
  std::vector<TalkFigure> talk_figures;  ///< its figures, of bare threads and of whole cloth
  std::vector<std::pair<std::string, Image>> thread_pictures;
  std::vector<std::string> skipped;     ///< what was left out and why, one sentence each
  Strategy ours = Strategy::automatic;  ///< what the program does unless told otherwise
  double seconds = 0, cpu_seconds = 0;
  bool interrupted = false;
};

struct StudyState {
  double fraction = 0, seconds_left = -1;  ///< left: wall clock, -1 while unknown
  std::string doing;
};

inline constexpr int study_bounces = 2;

/// Strategies of the talk's figures: uniform, the talk's importance sampling, and the direction table.
const std::vector<Strategy>& ladder_strategies();

/// Measures all of it. Strategies and seeds are interleaved, so that a machine that slows down slows all of them.
/// CPU-seconds are those of render(): tables and ray tracer are built before. Stops where `interrupt` rises; what is
/// finished by then is in the result.
StudyResult run_study(const StudySettings& settings, const ColorManager& colors,
                      const std::function<void(const StudyState&)>& observe = {},
                      const std::atomic<bool>* interrupt = nullptr);

}  // namespace sateen
