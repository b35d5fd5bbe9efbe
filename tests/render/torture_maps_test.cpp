#include <gtest/gtest.h>

#include <cmath>

#include "image/chromaticities.h"
#include "image/file.h"
#include "image/scratch_folder.h"
#include "render/pictures.h"
#include "scene/maps.h"

namespace sateen_test {
namespace {

using namespace sateen;

// Every map of the list, written as a file, read and rendered by whatever way light is estimated by default, with
// ground, so that each user of a map meets it. (With few samples the ground's control variate may go below 0.)
TEST(TortureMaps, AreRenderedToFinitePictures) {
  const ScratchFolder folder;
  for (const NamedMap& map : torture_maps()) {
    SCOPED_TRACE(map.name);
    ImageLayer layer;
    layer.channels = {"R", "G", "B"};
    layer.image = map.image;
    const std::filesystem::path path = folder.path / "map.exr";
    write_exr(path, {layer}, {}, rec709_chromaticities);
    SceneSettings settings = scene_settings("ivory_duchess_satin", 8, 8);
    settings.mesh = "sphere";
    settings.level = 0;
    settings.environment = path.string();
    settings.approximations.table_size = 0.125f;
    settings.stage.ground = GroundSettings{};
    const Scene scene = scene_of(settings);
    Film film(8, 8, true);
    RenderSettings render_settings = samples(2);
    render_settings.light.bounces = 1;
    const RenderResult result = render(scene, render_settings, film);
    EXPECT_EQ(result.rays.non_finite, 0);
    double brightest = 0;
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) {
        const Color c = pixel_mean(film.pixels[size_t(8 * y + x)]);
        for (int i = 0; i < 3; ++i) {
          ASSERT_TRUE(std::isfinite(c[i])) << x << " " << y;
          brightest = std::max(brightest, double(c[i]));
        }
      }
    if (map.name == "constant" || map.name == "sun of 1e30") {
      EXPECT_GT(brightest, 0);
    }
  }
}

}  // namespace
}  // namespace sateen_test
