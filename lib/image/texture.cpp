#include "image/texture.h"

#include <algorithm>
#include <utility>

#include "image/oiio/functions.h"

namespace sateen {

namespace {

/// What each pixel of a side of `to` pixels takes from one of `from`: at most three neighbours and their shares.
struct Share {
  int first = 0, count = 0;
  float weight[3] = {0, 0, 0};
};
std::vector<Share> shares_of(int from, int to) {
  std::vector<Share> all(static_cast<size_t>(to));
  const double ratio = double(from) / to;  // 2, 2 and a bit below 3, or 1
  for (int i = 0; i < to; ++i) {
    Share& share = all[size_t(i)];
    const double begin = i * ratio, end = (i + 1) * ratio;
    share.first = int(begin);
    for (int k = share.first; k < from && double(k) < end - 1e-9 && share.count < 3; ++k)
      share.weight[share.count++] = float((std::min(end, k + 1.0) - std::max(begin, double(k))) / ratio);
  }
  return all;
}

}  // namespace

Image halve_image(const Image& image) {
  const int width = std::max(image.width / 2, 1), height = std::max(image.height / 2, 1);
  const std::vector<Share> across = shares_of(image.width, width), down = shares_of(image.height, height);
  Image out(width, height, image.channels);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Share &row = down[size_t(y)], &column = across[size_t(x)];
      for (int c = 0; c < image.channels; ++c) {
        float sum = 0;
        for (int j = 0; j < row.count; ++j)
          for (int i = 0; i < column.count; ++i)
            sum += row.weight[j] * column.weight[i] * image.at(column.first + i, row.first + j)[c];
        out.at(x, y)[c] = sum;
      }
    }
  return out;
}

Texture::Texture(const Image& picture, TextureWrap wrap, bool as_half) {
  std::vector<Image> levels{picture};
  while (levels.back().width > 1 || levels.back().height > 1) levels.push_back(halve_image(levels.back()));
  state_ = image_file_functions().make_texture(levels, wrap, as_half);
}
Texture::~Texture() {
  if (state_) image_file_functions().free_texture(state_);
}
Texture::Texture(Texture&& other) noexcept : state_(std::exchange(other.state_, nullptr)) {}

void Texture::look_up(const TexturePoint& point, float* values) const {
  image_file_functions().look_up(state_, point, values);
}

}  // namespace sateen
