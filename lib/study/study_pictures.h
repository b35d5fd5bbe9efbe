#pragma once
#include <atomic>
#include <vector>

#include "study/study.h"

namespace sateen {

/// Samples a pixel of the default strategy that study_pictures() takes, roughly.
double study_picture_units(int samples);

/// One scene by some strategies with a quarter of `samples` each, with as many samples as take the default strategy's
/// CPU time, and the reference; shown as the default display shows it. What is finished when `interrupt` rises.
std::vector<StudyPicture> study_pictures(const SceneSettings& settings, const ColorManager& colors, int samples,
                                         const std::atomic<bool>* interrupt);

}  // namespace sateen
