#include "render/metadata.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "pictures.h"

namespace sateen_test {
namespace {

using namespace sateen;

std::string written(const char* place) {
  std::ifstream file(std::string(SATEEN_SOURCE_DIR) + place);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Of a job that asks for everything that has an attribute of its own.
TEST(Metadata, HasNoAttributeThatTheListLacks) {
  PictureJob job;
  job.scene = scene_settings("ivory_duchess_satin", 24, 16);
  job.scene.stage.ground = GroundSettings();
  job.scene.stage.lens = LensSettings();
  job.scene.stage.shutter_deg = 12;
  job.turn = "object 40";
  job.references = true;
  job.candidates_reason = "the pilot met no noise";
  job.first_sample = 8;
  job.timings = true;
  job.render.crop = {1, 2, 9, 8};
  job.render.stop = {64, 0.01, 30};
  RenderResult result;
  result.error.known = result.promise.made = true;
  const std::string list = written("/docs/attributes.md");
  ASSERT_FALSE(list.empty());
  int own = 0;
  for (const auto& [name, value] : picture_attributes(job, SceneReport(), result)) {
    if (name.rfind("sateen:", 0) != 0) continue;
    ++own;
    std::string word = name.substr(7);
    // A forecast's ends are listed with it.
    for (const char* end : {"_low", "_high"})
      if (const size_t at = word.rfind(end); word.rfind("promised_", 0) == 0 && at != std::string::npos)
        word.resize(at);
    EXPECT_NE(list.find("`" + word + "`"), std::string::npos) << name;
  }
  EXPECT_GT(own, 60);
}

}  // namespace
}  // namespace sateen_test
