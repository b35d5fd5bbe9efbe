#include "render/approximations.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "render/metadata.h"
#include "render/pictures.h"

namespace sateen_test {
namespace {

using namespace sateen;

const Approximation& approximation(const std::string& flag) {
  for (const Approximation& each : approximation_list())
    if (each.flag == flag) return each;
  throw InputError("no approximation has the flag " + flag);
}

SceneSettings with(const std::string& flag, const std::string& text) {
  SceneSettings settings = scene_settings("ivory_duchess_satin", 24, 16);
  approximation(flag).read(text, settings.approximations);
  return settings;
}

std::string fault(const std::string& flag, const std::string& text) {
  Approximations to;
  try {
    approximation(flag).read(text, to);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Approximations, AreReadAsTheyAreWrittenAndPricedAtThreeSettingsOrMore) {
  const Scene scene = scene_of(scene_settings("ivory_duchess_satin", 24, 16));
  for (const Approximation& each : approximation_list()) {
    Approximations read;
    const std::vector<std::string> ladder = each.ladder({}, scene);
    EXPECT_GE(ladder.size(), 3u) << each.name;
    EXPECT_NE(std::find(ladder.begin(), ladder.end(), each.text({})), ladder.end()) << each.name;
    for (const std::string& text : ladder) {
      each.read(text, read);
      EXPECT_EQ(each.text(read), text);
      const std::vector<std::string> again = each.ladder(read, scene);
      EXPECT_EQ(std::count(again.begin(), again.end(), text), 1) << each.name << ": what is asked for is priced";
    }
  }
}

TEST(Approximations, OutOfRangeAreRefused) {
  EXPECT_NE(fault("--quadrature", "0").find("--quadrature is 0, expected a number from 0.125 to 8"),
            std::string::npos);
  EXPECT_NE(fault("--quadrature", "nan").find("--quadrature is nan"), std::string::npos);
  EXPECT_NE(fault("--table-size", "1x").find("--table-size is 1x"), std::string::npos);
  EXPECT_NE(fault("--map-size", "4").find("expected a number from 8 to 65536, or file"), std::string::npos);
  EXPECT_NE(fault("--filter", "gausian").find("did you mean gaussian?"), std::string::npos);
  EXPECT_NE(fault("--filter", "box:9").find("the radius of box is 9"), std::string::npos);
}

TEST(Approximations, DecideOverTheSamplesAndSoOverTheJob) {
  const char* const changed[][2] = {
      {"--quadrature", "0.5"}, {"--table-size", "0.5"}, {"--map-size", "64"}, {"--filter", "box"}};
  ASSERT_EQ(std::size(changed), approximation_list().size());
  const SceneReport report;
  const RenderResult result;
  PictureJob usual;
  usual.scene = scene_settings("ivory_duchess_satin", 24, 16);
  for (const auto& [flag, text] : changed) {
    PictureJob job = usual;
    job.scene = with(flag, text);
    EXPECT_NE(job_hash(job, report), job_hash(usual, report)) << flag;
    EXPECT_EQ(std::get<std::string>(
                  picture_attributes(job, report, result).at("sateen:" + underscored(approximation(flag).name))),
              approximation(flag).text(job.scene.approximations));
  }
}

TEST(Approximations, ChangeTheSceneThatIsAssembledAndRebuiltAlike) {
  const Scene usual = scene_of(scene_settings("ivory_duchess_satin", 24, 16));
  const auto rebuilt = [&](const std::string& flag, const std::string& text) {
    Scene scene = usual;
    approximation(flag).rebuild(with(flag, text), ColorManager(), scene);
    return scene;
  };
  const Scene fine = scene_of(with("--quadrature", "8"));
  EXPECT_GT(fine.front.threads.count, usual.front.threads.count);
  EXPECT_EQ(rebuilt("--quadrature", "8").front.threads.node, fine.front.threads.node);

  const Scene small_table = scene_of(with("--table-size", "0.5"));
  EXPECT_LT(3 * small_table.front.table.cumulative.size(), usual.front.table.cumulative.size());
  EXPECT_EQ(rebuilt("--table-size", "0.5").front.table.cumulative, small_table.front.table.cumulative);

  const Scene small_map = scene_of(with("--map-size", "64"));
  EXPECT_EQ(small_map.environment.width, 64);
  EXPECT_EQ(small_map.environment.height, 32);
  EXPECT_NEAR(mean_component(small_map.environment.mean_radiance) / mean_component(usual.environment.mean_radiance),
              1, 1e-4);
  EXPECT_EQ(scene_of(with("--map-size", "65536")).environment.width, usual.environment.width) << "never made larger";
  EXPECT_EQ(rebuilt("--map-size", "64").environment.texels.size(), 64u * 32u);

  EXPECT_EQ(scene_of(with("--filter", "box")).filter->inverse.back(), 0.5f);
  EXPECT_EQ(rebuilt("--filter", "box").filter->inverse, compile_filter({FilterShape::box, 0.5f})->inverse);
  EXPECT_EQ(usual.filter, compile_filter());
}

}  // namespace
}  // namespace sateen_test
