#pragma once
#include <span>
#include <vector>

#include "image/image.h"
#include "render/loss.h"
#include "render/pixel_grid.h"

namespace sateen {

/// The smallest float (FilmPixel's grain): a pixel of a grid is summed up by one thread, and nothing need be rounded.
inline constexpr double no_grain = 0x1p-149;

/// A grid of pixels as a small picture, with what it took.
struct GridPicture {
  PixelGrid grid;
  std::vector<FilmPixel> pixels;
  bool opaque = false;  ///< a backdrop is seen
  GridWork work;
};
/// Without a sample yet.
GridPicture blank_picture(const Scene& scene, const PixelGrid& grid);
GridPicture trace_picture(const Scene& scene, const LightSettings& light, std::uint32_t seed, const PixelGrid& grid,
                          int threads);
/// Goes on to `samples` a pixel: the same sums as of a picture that had them all at once.
void trace_more(GridPicture& picture, const Scene& scene, const LightSettings& light, std::uint32_t seed, int samples,
                int threads);

/// What `less` lacks of `whole`: two pictures of one grid, the same random numbers. Where nothing is rendered both
/// stand before a grey card, so that what can be seen through counts as well.
std::vector<PixelLoss> differences(const GridPicture& less, const GridPicture& whole, double error_floor);

/// Mean of the pixels' variance over what is rendered, relative as in E: E^2 of such a picture. 0 of nothing.
double relative_variance(const GridPicture& picture, double error_floor);
/// The same, relative to what `judges` show together: pictures of one scene and grid that are compared are judged
/// alike, and one that came out too bright does not excuse itself.
double relative_variance(const GridPicture& picture, std::span<const GridPicture> judges, double error_floor);

/// Premultiplied RGBA, working space.
Image grid_image(const GridPicture& picture);

}  // namespace sateen
