#pragma once
#include <cstdint>

#include "film/film.h"
#include "look/look.h"
#include "scene/scene.h"
#include "study/thread_sampling.h"

namespace sateen {

/// How directions are drawn where light meets a thread.
enum class ThreadStrategy { uniform, talk, both };  ///< over the sphere; by the talk; one of the two, at even odds

/// A picture of a scene whose cloth is bare threads (study/thread_sampling.h): at every point one thread, of a family
/// by coverage and with a tangent by length, lit from the whole sphere. Nothing masks it, nothing is divided out, and
/// no horizon takes light away; other cloth alone does, or sends it on up to `bounces` times. One ray through the
/// middle of every pixel; every sample has random numbers of its own, so that its error falls as 1/N.
struct ThreadPicture {
  ThreadStrategy strategy = ThreadStrategy::talk;
  VolumeAzimuth azimuth = VolumeAzimuth::flat;
  LobeChoice choice = LobeChoice::half;
  int bounces = 0, samples = 16;  ///< samples: a multiple of `replicates`
  std::uint32_t seed = 1;
  int threads = 0;
};
Film render_threads(const Scene& scene, const Look& look, const ThreadPicture& picture);

}  // namespace sateen
