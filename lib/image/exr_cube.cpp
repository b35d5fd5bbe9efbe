#include "image/exr_cube.h"

#include <OpenEXR/ImfEnvmap.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "image/image.h"

namespace sateen {

namespace {
class CubeLight : public LightFile {
 public:
  CubeLight(std::unique_ptr<LightFile> faces)
      : faces_(faces->info.width, faces->info.height, 3),
        window_({0, 0}, {faces->info.width - 1, faces->info.height - 1}) {
    info = faces->info;
    info.width = 4 * faces_.width;
    info.height = 2 * faces_.width;
    info.whole = true;
    info.first_row = 0;
    info.end_row = info.height;
    info.notes.push_back(fmt::format("its cube of six faces of {0} x {0} was made a lat-long map of {1} x {2}",
                                     faces_.width, info.width, info.height));
    faces->read_rows(0, faces_.height, faces_.pixels.data());
  }

  void read_rows(int y, int count, float* rgb) override {
    constexpr double pi_d = std::numbers::pi;
    constexpr int side = 2;  // look-ups along each side of a pixel
    for (int row = y; row < y + count; ++row)
      for (int x = 0; x < info.width; ++x, rgb += 3) {
        double sum[3] = {0, 0, 0};
        for (int j = 0; j < side; ++j)
          for (int i = 0; i < side; ++i) {
            const double longitude = pi_d * (1 - 2 * (x + (i + 0.5) / side) / info.width);
            const double latitude = pi_d * (0.5 - (row + (j + 0.5) / side) / info.height);
            add(Imath::V3f(float(std::sin(longitude) * std::cos(latitude)), float(std::sin(latitude)),
                           float(std::cos(longitude) * std::cos(latitude))),
                sum);
          }
        for (int c = 0; c < 3; ++c) rgb[c] = float(sum[c] / (side * side));
      }
  }

 private:
  void add(const Imath::V3f& direction, double (&sum)[3]) const {
    Imf::CubeMapFace face{};
    Imath::V2f place;
    Imf::CubeMap::faceAndPixelPosition(direction, window_, face, place);
    const int last = faces_.width - 1;
    const float u = std::clamp(place.x, 0.0f, float(last)), v = std::clamp(place.y, 0.0f, float(last));
    const int u0 = std::min(int(u), std::max(last - 1, 0)), v0 = std::min(int(v), std::max(last - 1, 0));
    const double fu = double(u) - u0, fv = double(v) - v0;
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) {
        const double weight = (i ? fu : 1 - fu) * (j ? fv : 1 - fv);
        if (!(weight > 0)) continue;  // an infinite neighbour must not make 0 * Inf
        const Imath::V2f at = Imf::CubeMap::pixelPosition(face, window_, {float(u0 + i), float(v0 + j)});
        const float* p = faces_.at(std::clamp(int(std::lround(at.x)), 0, faces_.width - 1),
                                   std::clamp(int(std::lround(at.y)), 0, faces_.height - 1));
        for (int c = 0; c < 3; ++c) sum[c] += weight * double(p[c]);
      }
  }

  Image faces_;
  Imath::Box2i window_;
};
}  // namespace

std::unique_ptr<LightFile> unfold_cube(const std::filesystem::path& path, std::unique_ptr<LightFile> faces,
                                       const ImageLimits& limits) {
  const int width = faces->info.width, height = faces->info.height;
  if ((long long)(width)*6 != height)
    refuse_picture(path,
                   fmt::format("says that it is a cube map and is {} x {} pixels, expected six times as high as "
                               "wide",
                               width, height),
                   "make it a lat-long map first");
  check_image_size(path, "lat-long map of its cube", 4ll * width, 2ll * width, 3, limits);
  return std::make_unique<CubeLight>(std::move(faces));
}

}  // namespace sateen
