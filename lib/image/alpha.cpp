#include "image/alpha.h"

#include <algorithm>

namespace sateen {

std::vector<float> take_alpha(Image& image, const ImageFileInfo& info) {
  if (info.alpha_channel < 0 || info.alpha_channel >= image.channels) return {};
  std::vector<float> alpha(size_t(image.width) * size_t(image.height));
  const auto channels = size_t(image.channels), at = size_t(info.alpha_channel);
  bool opaque = true;
  for (size_t i = 0; i < alpha.size(); ++i) {
    const float found = image.pixels[i * channels + at];
    alpha[i] = found > 0 ? std::min(found, 1.0f) : 0;
    opaque = opaque && alpha[i] == 1;
  }
  if (opaque) return {};
  for (size_t i = 0; info.colors_times_alpha && i < alpha.size(); ++i)
    for (size_t c = 0; c < channels; ++c)
      if (c != at && alpha[i] > 0) image.pixels[i * channels + c] /= alpha[i];
  return alpha;
}

}  // namespace sateen
