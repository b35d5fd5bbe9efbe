#include <gtest/gtest.h>

#include <fstream>

#include "image/chromaticities.h"
#include "image/file.h"
#include "program.h"

namespace sateen_test {

namespace {
// Layers of one colour each, beside each other in one file.
void write_layers(const std::filesystem::path& path, const std::vector<std::pair<std::string, float>>& layers) {
  std::vector<sateen::ImageLayer> all;
  for (const auto& [name, value] : layers) {
    sateen::ImageLayer layer;
    layer.name = name;
    layer.channels = {"R", "G", "B"};
    layer.image = sateen::Image(64, 32, 3);
    std::fill(layer.image.pixels.begin(), layer.image.pixels.end(), value);
    all.push_back(layer);
  }
  sateen::write_exr(path, all, {}, sateen::rec709_chromaticities);
}
}  // namespace

TEST(LightFlags, ChooseALayerInEveryCommandThatReadsALight) {
  const Folder folder;
  write_layers(folder / "a.exr", {{"View Layer.AO", 0.5f}, {"View Layer.Emit", 3.0f}});
  const Finished refused = run_sateen({"env", "inspect", "a.exr"}, {folder.path});
  EXPECT_EQ(refused.code, 3);
  EXPECT_NE(refused.err.find("View Layer.AO (B, G, R), View Layer.Emit (B, G, R)"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("--env-layer"), std::string::npos) << refused.err;
  const Finished emit = run_sateen({"env", "inspect", "a.exr", "--env-layer", "emit"}, {folder.path});
  EXPECT_EQ(emit.code, 0) << emit.err;
  EXPECT_NE(emit.out.find("luminance 3 to 3"), std::string::npos) << emit.out;
  EXPECT_NE(run_sateen({"check", "a.exr", "--env-layer", "AO"}, {folder.path}).out.find("AO is the light"),
            std::string::npos);
  EXPECT_EQ(run_sateen(tiny({"-o", "a.png", "-e", "a.exr"}), {folder.path}).code, 3);
  EXPECT_EQ(run_sateen(tiny({"-o", "a.png", "-e", "a.exr", "--env-layer", "Emit"}), {folder.path}).code, 0);
}

TEST(LightFlags, RaiseTheLimitThatTheMessageNames) {
  const Folder folder;
  const std::vector<std::string> small{"env", "inspect", "studio_softboxes", "--image-limit", "0.001"};
  const Finished refused = run_sateen(small, {folder.path});
  EXPECT_EQ(refused.code, 3);
  EXPECT_NE(refused.err.find("--image-limit"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("--map-size"), std::string::npos) << refused.err;
  std::vector<std::string> shrunk = small;
  shrunk.insert(shrunk.end(), {"--map-size", "128"});
  EXPECT_EQ(run_sateen(shrunk, {folder.path}).code, 0);
  EXPECT_EQ(run_sateen(tiny({"-o", "a.png", "--image-limit", "0.001"}), {folder.path}).code, 3);
}

TEST(LightFlags, TellWhatIsAssumedOfAMapThatIsNotTwoToOne) {
  const Folder folder;
  std::ofstream(folder / "square.hdr", std::ios::binary) << "#?RADIANCE\nEXPOSURE=2\n\n-Y 2 +X 2\n"
                                                         << std::string(
                                                                "\x80\x80\x80\x80\x80\x80\x80\x80"
                                                                "\x80\x80\x80\x80\x80\x80\x80\x80",
                                                                16);
  for (const char* command : {"inspect", "check"}) {
    const Finished run = std::string(command) == "check"
                             ? run_sateen({"check", "square.hdr"}, {folder.path})
                             : run_sateen({"env", "inspect", "square.hdr"}, {folder.path});
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_NE(run.out.find("it is 2 x 2, and a lat-long map is twice as wide as high"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("divided by 2, the exposure"), std::string::npos) << run.out;
  }
  const Finished picture = run_sateen(tiny({"-o", "a.png", "-e", "square.hdr"}), {folder.path});
  EXPECT_NE(picture.err.find("taken for the whole sphere and stretched"), std::string::npos) << picture.err;
}

}  // namespace sateen_test
