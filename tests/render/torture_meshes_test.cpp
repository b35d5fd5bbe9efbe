// Torture meshes are rendered, not only read: nothing crashes and no light is lost to a number that is none.
#include <gtest/gtest.h>

#include "base/error.h"
#include "mesh/obj.h"
#include "mesh/subdivide.h"
#include "mesh/torture_meshes.h"
#include "mesh/weld.h"
#include "pictures.h"

using namespace sateen;
using namespace sateen_test;

namespace {

/// A stage into which any mesh is put.
class Stage {
 public:
  Stage() {
    SceneSettings settings = scene_settings("champagne_silk_satin", 8, 8);
    settings.mesh = "swatch";
    settings.level = 0;
    settings.approximations.map_size = 128;
    scene_ = scene_of(settings);
  }
  void expect_sound_picture(ControlMesh cage, int level) const {
    settle_placement(cage);
    Scene scene = scene_;
    scene.mesh = std::make_shared<const Mesh>(subdivide(cage, level));
    scene.rays = std::make_shared<const RayTracer>(*scene.mesh, 2);
    scene.camera = frame_points(scene.mesh->positions, {}, 8, 8);
    StageSettings stage;
    stage.ground = GroundSettings{};
    set_stage(scene, stage, 2);
    RenderSettings how = samples(1);
    how.light.bounces = 2;
    how.albedo_layer = false;  // a table of the look, which is the same for all meshes
    Film film(8, 8, true);
    EXPECT_EQ(render(scene, how, film).rays.non_finite, 0);
    double light = 0;
    for (const FilmPixel& pixel : film.pixels)
      for (const Vec3d& sum : pixel.beauty)
        for (int c = 0; c < 3; ++c) {
          // Not "not negative": what a floor's open sky takes off a single sample may be more than it has.
          ASSERT_TRUE(std::isfinite(sum[c]));
          light += sum[c];
        }
    EXPECT_GT(light, 0) << "the floor at least is lit";
    for (const LayerPixel& layer : film.layers)
      for (const Vec3& v : {layer.position, layer.normal, layer.warp})
        ASSERT_TRUE(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z));
  }

 private:
  Scene scene_;
};

}  // namespace

TEST(TortureMeshes, AllAreRenderedWithoutANumberThatIsNone) {
  const Stage stage;
  for (const torture::Case& c : torture::cases()) {
    SCOPED_TRACE(c.name);
    stage.expect_sound_picture(parse_obj(c.text, "torture.obj"), c.text.size() > 20'000 ? 0 : 1);
    if (HasFatalFailure()) return;
  }
}

TEST(TortureMeshes, BooksPillowsAndBowTiesInAnyCombinationAreRendered) {
  const Stage stage;
  const std::uint32_t meshes = std::getenv("SATEEN_LONG_TESTS") ? 3000 : 60;
  for (std::uint32_t i = 0; i < meshes; ++i) {
    SCOPED_TRACE(i);
    ControlMesh cage = parse_obj(torture::random_mesh(1'000'000 + i), "random.obj");
    if (i % 3 == 0) weld_borders(cage);
    stage.expect_sound_picture(std::move(cage), int(i % 3));
    if (HasFatalFailure()) return;
  }
}
