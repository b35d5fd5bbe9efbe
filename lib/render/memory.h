#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace sateen {

/// What a picture takes beside its scene, by the size of the film and by what is kept and written.
struct PictureSize {
  std::int64_t width = 0, height = 0;
  bool layers = false;               ///< the film keeps those beside the beauty
  bool references = false;           ///< balls and chart are laid over it
  int exr_channels = 0;              ///< of the widest EXR; 0: none is written
  std::vector<std::string> outputs;  ///< by their extension
  int threads = 1;
};

/// Bytes of the film itself: what cannot be had smaller.
std::int64_t film_bytes(const PictureSize& size);

/// Bytes at the peak of rendering and writing, the film's own among them.
std::int64_t picture_bytes(const PictureSize& size);

}  // namespace sateen
