#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstring>

#include "image/file.h"
#include "program.h"

namespace sateen_test {

namespace {
std::string text_of(const sateen::Attributes& a, const std::string& name) {
  const auto found = a.find("sateen:" + name);
  const auto* text = found == a.end() ? nullptr : std::get_if<std::string>(&found->second);
  return text ? *text : "";
}
int whole_of(const sateen::Attributes& a, const std::string& name) {
  const auto found = a.find("sateen:" + name);
  const int* value = found == a.end() ? nullptr : std::get_if<int>(&found->second);
  return value ? *value : -1;
}
// No temporary file may stay behind.
size_t files_in(const Folder& folder) {
  size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path)) ++count;
  return count;
}
double mean_of(const sateen::Image& image) {
  double sum = 0;
  for (const float v : image.pixels) sum += double(v);
  return sum / double(image.pixels.size());
}
}  // namespace

TEST(Render, WithoutOutputsWritesAPngAndAnExrHereAndSaysSo) {
  const Folder folder;
  const Finished run = run_sateen(tiny({}), {folder.path});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("wrote sateen.png  64 x 36"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("wrote sateen.exr  64 x 36"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("all samples done"), std::string::npos) << run.out;
  EXPECT_EQ(files_in(folder), 2u);
  EXPECT_EQ(sateen::read_image(folder / "sateen.png").channels, 3);
  EXPECT_GT(mean_of(sateen::read_image(folder / "sateen.png")), 0.1);
}

TEST(Render, AnExrHoldsItsLayersAndSaysHowItWasMade) {
  const Folder folder;
  ASSERT_EQ(run_sateen(tiny({"-o", "a.exr", "--look", "emerald_satin", "--env", "studio_softboxes", "--seed", "7",
                             "--env-rotate", "30"}),
                       {folder.path})
                .code,
            0);
  sateen::ImageFileInfo info;
  sateen::read_image(folder / "a.exr", {}, &info);
  const auto has = [&](const char* name) {
    return std::find(info.channel_names.begin(), info.channel_names.end(), name) != info.channel_names.end();
  };
  for (const char* name : {"R", "A", "albedo.R", "N.X", "P.Z", "uv.U", "error.G", "samples.Y", "surface.R",
                           "volume.B", "direct.R", "indirect.R", "warp.X"})
    EXPECT_TRUE(has(name)) << name;
  const sateen::Attributes a = sateen::read_attributes(folder / "a.exr");
  EXPECT_EQ(text_of(a, "look_name"), "emerald_satin");
  EXPECT_EQ(text_of(a, "mesh"), "swatch");
  EXPECT_EQ(text_of(a, "map"), "studio_softboxes");
  EXPECT_EQ(text_of(a, "stopped_by"), "samples");
  EXPECT_NE(text_of(a, "command").find("sateen render --mesh swatch"), std::string::npos);
  EXPECT_TRUE(is_json(text_of(a, "look")));
  EXPECT_EQ(whole_of(a, "seed"), 7);
  EXPECT_EQ(whole_of(a, "spp"), 4);
  EXPECT_EQ(whole_of(a, "non_finite"), 0);
  for (const char* name : {"look_hash", "mesh_hash", "map_hash", "job"})
    EXPECT_EQ(text_of(a, name).size(), 16u) << name;
  for (const char* name : {"map_rotation", "error", "error_low", "error_high", "exposure"})
    EXPECT_TRUE(a.contains(std::string("sateen:") + name)) << name;
  EXPECT_FALSE(a.contains("sateen:seconds")) << "equal renders write equal bytes";
}

TEST(Render, AQualityAsksForItsErrorAndWhatThatCallsForWhereTheCommandLineDoesNot) {
  const auto dry = [](std::vector<std::string> flags) {
    flags.insert(flags.end(), {"render", "--mesh", "swatch", "--dry-run", "--json"});
    std::rotate(flags.begin(), flags.end() - 5, flags.end());
    const Finished run = run_sateen(flags);
    EXPECT_EQ(run.code, 0) << run.err;
    return run.out;
  };
  const std::string final_ = dry({"--quality", "final"});
  EXPECT_EQ(final_.find("\"bounces\": 0"), std::string::npos) << "one percent calls for bounces: " << final_;
  const std::string rough = dry({"--error", "0.5"});
  EXPECT_NE(rough.find("\"bounces\": 0"), std::string::npos) << rough;
  EXPECT_NE(final_.find("\"error\": 0.01"), std::string::npos) << final_;
  const std::string mixed = dry({"--quality", "final", "--bounces", "0", "--error", "0.25"});
  EXPECT_NE(mixed.find("\"bounces\": 0"), std::string::npos) << mixed;
  EXPECT_NE(mixed.find("\"error\": 0.25"), std::string::npos) << mixed;
}

TEST(Render, RangesOfSamplesMergeAndResumeWithTheUsualStrategy) {
  const Folder folder;
  const auto picture = [&](std::vector<std::string> flags) {
    flags.insert(flags.begin(), {"render", "-l", "crimson_velvet", "-r", "64", "36", "-q", "--progress", "none"});
    return run_sateen(flags, {folder.path});
  };
  ASSERT_EQ(picture({"-s", "16", "-o", "a.png", "--checkpoint", "a.cp"}).code, 0);
  ASSERT_EQ(picture({"-s", "48", "--samples-from", "16", "-o", "b.png", "--checkpoint", "b.cp"}).code, 0);
  const Finished merged = run_sateen({"merge", "a.cp", "b.cp", "-o", "m.exr"}, {folder.path});
  EXPECT_EQ(merged.code, 0) << merged.err;
  EXPECT_EQ(text_of(sateen::read_attributes(folder / "m.exr"), "strategy"), "resampled");
  const Finished resumed = picture({"-s", "64", "-o", "c.png", "--resume", "a.cp"});
  EXPECT_EQ(resumed.code, 0) << resumed.err;
}

TEST(Render, ChosenLayersAreTheOnlyOnes) {
  const Folder folder;
  ASSERT_EQ(run_sateen(tiny({"-o", "a.exr", "--aov", "N,samples"}), {folder.path}).code, 0);
  EXPECT_EQ(sateen::read_image_info(folder / "a.exr").channels, 8);
  ASSERT_EQ(run_sateen(tiny({"-o", "b.exr", "--aov", "none"}), {folder.path}).code, 0);
  EXPECT_EQ(sateen::read_image_info(folder / "b.exr").channels, 4);
}

TEST(Render, PixelsAreTheSameOnOneTwoThreeAndEightThreads) {
  const Folder folder;
  for (const std::string threads : {"1", "2", "3", "8"}) {
    const Finished run = run_sateen(tiny({"-r", "100", "70", "--bounces", "1", "--aov", "N,surface,error", "-t",
                                          threads, "-o", threads + ".exr", "-o", threads + ".png", "-q"}),
                                    {folder.path});
    ASSERT_EQ(run.code, 0);
    EXPECT_EQ(run.err, "") << "libraries are quiet, too, on more threads than there are processors";
  }
  for (const char* kind : {".exr", ".png"}) {
    const auto first = sateen::read_image(folder / (std::string("1") + kind)).pixels;
    for (const char* threads : {"2", "3", "8"}) {
      const auto other = sateen::read_image(folder / (std::string(threads) + kind)).pixels;
      ASSERT_EQ(other.size(), first.size());
      EXPECT_EQ(std::memcmp(other.data(), first.data(), first.size() * sizeof(float)), 0) << threads << kind;
    }
  }
}

TEST(Render, ACropHasTheBitsOfTheWholePicture) {
  const Folder folder;
  ASSERT_EQ(run_sateen(tiny({"-o", "whole.exr", "--aov", "none"}), {folder.path}).code, 0);
  const Finished run =
      run_sateen(tiny({"-o", "crop.exr", "--aov", "none", "--crop", "20", "10", "50", "30"}), {folder.path});
  ASSERT_EQ(run.code, 0);
  EXPECT_NE(run.out.find("error E 0."), std::string::npos) << run.out;
  const sateen::Image whole = sateen::read_image(folder / "whole.exr"),
                      crop = sateen::read_image(folder / "crop.exr");
  ASSERT_EQ(crop.width, 30);
  ASSERT_EQ(crop.height, 20);
  double sum = 0;
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 30; ++x)
      for (int c = 0; c < 4; ++c) {
        ASSERT_EQ(crop.at(x, y)[c], whole.at(x + 20, y + 10)[c]);
        sum += double(crop.at(x, y)[c]);
      }
  EXPECT_GT(sum, 0);
}

TEST(Render, ExposureChangesDisplayPicturesAndNotTheLight) {
  const Folder folder;
  ASSERT_EQ(run_sateen(tiny({"--exposure", "0", "-o", "a.exr", "-o", "a.png", "--aov", "none"}), {folder.path}).code,
            0);
  ASSERT_EQ(run_sateen(tiny({"--exposure", "-2", "--aov", "none", "-o", "b.exr", "-o", "b.png"}), {folder.path}).code,
            0);
  EXPECT_EQ(sateen::read_image(folder / "a.exr").pixels, sateen::read_image(folder / "b.exr").pixels);
  EXPECT_GT(mean_of(sateen::read_image(folder / "a.png")), 1.1 * mean_of(sateen::read_image(folder / "b.png")));
}

TEST(Render, ThePaperAndAHexadecimalBackdropDoNotDependOnExposureOrView) {
  const Folder folder;
  const std::vector<std::vector<std::string>> variants{{"--exposure", "3"},
                                                       {"--exposure", "-3", "--view", "Un-tone-mapped"}};
  std::vector<float> paper;
  for (auto words : variants) {
    words.insert(words.end(), {"-o", "a.tif"});
    ASSERT_EQ(run_sateen(tiny(words), {folder.path}).code, 0);
    const sateen::Image image = sateen::read_image(folder / "a.tif");
    const std::vector<float> corner(image.at(1, 1), image.at(1, 1) + 3);
    if (paper.empty()) paper = corner;
    EXPECT_EQ(corner, paper);
    words.insert(words.end(), {"--backdrop", "#ff8000"});
    ASSERT_EQ(run_sateen(tiny(words), {folder.path}).code, 0);
    const sateen::Image orange = sateen::read_image(folder / "a.tif");
    EXPECT_EQ(orange.at(1, 1)[0], 1.0f);
    EXPECT_NEAR(orange.at(1, 1)[1], 128 / 255.0f, 1.01f / 255);
    EXPECT_EQ(orange.at(1, 1)[2], 0.0f);
  }
  EXPECT_GT(paper[0], 0.05f);
  EXPECT_LT(paper[0], 0.5f);
}

TEST(Render, TransparentKeepsAlphaInAPng) {
  const Folder folder;
  ASSERT_EQ(run_sateen(tiny({"--transparent", "-o", "a.png"}), {folder.path}).code, 0);
  const sateen::Image image = sateen::read_image(folder / "a.png");
  ASSERT_EQ(image.channels, 4);
  EXPECT_EQ(image.at(0, 0)[3], 0.0f);
  EXPECT_EQ(image.at(32, 18)[3], 1.0f);
}

TEST(Render, ALightMadeBrighterLooksBrighterUnderAutomaticExposure) {
  const Folder folder;
  ASSERT_EQ(run_sateen(tiny({"-o", "a.png"}), {folder.path}).code, 0);
  ASSERT_EQ(run_sateen(tiny({"-o", "b.png", "--env-exposure", "1"}), {folder.path}).code, 0);
  EXPECT_GT(mean_of(sateen::read_image(folder / "b.png")), 1.05 * mean_of(sateen::read_image(folder / "a.png")));
}

TEST(Render, ADryRunWritesNothingAndSaysWhatItWould) {
  const Folder folder;
  const Finished run = run_sateen(tiny({"--dry-run", "-o", "a.png", "-o", "new/b.exr"}), {folder.path});
  EXPECT_EQ(run.code, 0);
  EXPECT_NE(run.out.find("would write a.png\nwould write new/b.exr\n"), std::string::npos) << run.out;
  EXPECT_EQ(files_in(folder), 0u);
}

TEST(Render, JsonStandsAloneOnStandardOutputAndEqualsTheStatsFile) {
  const Folder folder;
  for (const char* progress : {"json", "alf"}) {
    auto words = tiny({"--json", "-o", "a.png", "--stats", "stats.json"});
    words.insert(words.end(), {"--progress", progress});
    const Finished run = run_sateen(words, {folder.path});
    EXPECT_EQ(run.code, 0);
    EXPECT_TRUE(is_json(run.out)) << run.out;
    EXPECT_EQ(run.out, read_text(folder / "stats.json"));
    EXPECT_NE(run.out.find("\"exit_code\": 0"), std::string::npos);
  }
  EXPECT_TRUE(is_json(run_sateen(tiny({"--json", "--dry-run"}), {folder.path}).out));
}

TEST(Render, QuietSaysNothing) {
  const Folder folder;
  const Finished run = run_sateen(
      {"render", "-q", "-m", "swatch", "--level", "0", "-r", "32", "18", "-s", "1", "-o", "a.png"}, {folder.path});
  EXPECT_EQ(run.code, 0);
  EXPECT_EQ(run.out + run.err, "");
}

TEST(Render, PercentNeverGoesBackAndReachesAHundredLast) {
  const Folder folder;
  for (const char* style : {"alf", "openjd", "json", "auto"}) {
    auto words = tiny({"-s", "32", "-r", "128", "72", "-o", "a.png"});
    words.insert(words.end(), {"--progress", style});
    const Finished run = run_sateen(words, {folder.path});
    ASSERT_EQ(run.code, 0);
    const bool farm = style[0] == 'a' && style[1] == 'l';
    const std::string& said = farm || style[0] == 'o' ? run.out : run.err;
    double last = -1;
    int count = 0;
    for (size_t at = 0, end = 0; at < said.size(); at = end + 1) {
      end = std::min(said.find('\n', at), said.size());
      const std::string line = said.substr(at, end - at);
      const bool ours = style[0] == 'a'
                            ? line.find(farm ? "ALF_PROGRESS " : " %") != std::string::npos
                            : line.find("percent") != std::string::npos || line.find("openjd_progress") == 0;
      const size_t digit = line.find_first_of("0123456789");
      if (!ours || digit == std::string::npos) continue;
      const double percent = std::stod(line.substr(digit));
      EXPECT_GE(percent, last) << line;
      last = percent;
      ++count;
    }
    EXPECT_EQ(last, 100) << style << "\n" << said;
    EXPECT_GE(count, 2) << style;
  }
}

TEST(Render, AnErrorOutOfReachInTheTimeEndsWithFourAndWhole) {
  const Folder folder;
  const Finished run = run_sateen({"render", "-m", "swatch", "--level", "0", "-r", "64", "36", "--error", "1e-5",
                                   "--time", "0.5s", "--progress", "none", "-o", "a.png"},
                                  {folder.path});
  EXPECT_EQ(run.code, 4);
  EXPECT_NE(run.out.find("stopped by time (0.5 s) before the error fell to 1e-05"), std::string::npos) << run.out;
  EXPECT_EQ(sateen::read_image(folder / "a.png").width, 64);
}

TEST(Render, AnErrorInReachStopsThereAndEndsWithZero) {
  const Folder folder;
  const Finished run = run_sateen({"render", "-m", "swatch", "--level", "0", "-r", "32", "18", "--error", "0.5",
                                   "--progress", "none", "-o", "a.png"},
                                  {folder.path});
  EXPECT_EQ(run.code, 0);
  EXPECT_NE(run.out.find("stopped at the asked error, 0.5"), std::string::npos) << run.out;
}

TEST(Render, ASignalStopsWithinTwoSecondsAndWritesWhatIsThere) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const Folder folder;
    Start start(folder.path, signal);
    const Finished run =
        run_sateen({"render",     "-m",   "swatch", "--level", "0",     "-r", "240", "135",   "-s",      "100000",
                    "--progress", "json", "-o",     "a.exr",   "--aov", "N",  "-o",  "a.png", "--stats", "s.json"},
                   start);
    EXPECT_EQ(run.code, 128 + signal);
    // 2 s are promised on a machine of one's own; a machine with other work may take a little longer.
    EXPECT_LT(run.seconds_after_signal, 6);
    EXPECT_NE(run.out.find("stopped by a signal"), std::string::npos) << run.out;
    EXPECT_EQ(text_of(sateen::read_attributes(folder / "a.exr"), "stopped_by"), "interrupted");
    EXPECT_EQ(sateen::read_image(folder / "a.png").width, 240);
    EXPECT_EQ(run.err.find("\"percent\": 100"), std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(folder / "a.exr.checkpoint"));
    EXPECT_EQ(files_in(folder), 4u);
  }
}

TEST(Render, GoesOnFromACheckpointToTheBitsOfARenderThatNeverStopped) {
  const Folder folder;
  const Start here{folder.path};
  const auto pixels = [&](const char* name) { return sateen::read_image(folder / name).pixels; };
  ASSERT_EQ(run_sateen(tiny({"-s", "64", "--adaptive", "-o", "whole.exr"}), here).code, 0);
  ASSERT_EQ(run_sateen(tiny({"-s", "40", "--adaptive", "-o", "a.exr", "--checkpoint", "a.checkpoint"}), here).code,
            0);
  const Finished on = run_sateen(tiny({"-s", "64", "-t", "1", "-o", "b.exr", "--resume", "a.checkpoint"}), here);
  ASSERT_EQ(on.code, 0) << on.err;
  EXPECT_NE(on.out.find("goes on at 40 samples"), std::string::npos) << on.out;
  EXPECT_EQ(pixels("b.exr"), pixels("whole.exr"));
  EXPECT_NE(pixels("a.exr"), pixels("whole.exr"));

  const Finished other =
      run_sateen(tiny({"-l", "emerald_satin", "--seed", "2", "-o", "b.exr", "--resume", "a.checkpoint"}), here);
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("look is champagne_silk_satin"), std::string::npos) << other.err;
  EXPECT_NE(other.err.find("seed is 1 there and 2 here"), std::string::npos) << other.err;
  std::string damaged = read_text(folder / "a.checkpoint");
  damaged[damaged.size() / 2] = char(damaged[damaged.size() / 2] + 1);
  write_text(folder / "bad.checkpoint", damaged);
  EXPECT_EQ(run_sateen(tiny({"-o", "b.exr", "--resume", "bad.checkpoint"}), here).code, 3);
  write_text(folder / "bad.checkpoint", damaged.substr(0, damaged.size() / 3));
  EXPECT_EQ(run_sateen(tiny({"-o", "b.exr", "--resume", "bad.checkpoint"}), here).code, 3);
  EXPECT_EQ(run_sateen(tiny({"-o", "b.exr", "--resume", "a.exr"}), here).code, 3);
}

TEST(Render, APictureThatGoesOnIsToldOfMoreBouncesOnlyWhereAnErrorAsksForThem) {
  const Folder folder;
  const Start here{folder.path};
  const auto drape = [](std::vector<std::string> more) {
    std::vector<std::string> words{"render", "-m", "drape", "--level", "0", "-r", "48", "27", "--candidates", "2"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  const std::string told = "calls for more than";
  ASSERT_EQ(run_sateen(drape({"-s", "4", "--bounces", "0", "-o", "a.png", "--checkpoint", "direct"}), here).code, 0);
  ASSERT_EQ(run_sateen(drape({"-s", "4", "--error", "0.3", "-o", "a.png", "--checkpoint", "planned"}), here).code,
            4);  // coarser than asked
  const auto goes_on = [&](const char* checkpoint, std::vector<std::string> more) {
    more.insert(more.end(), {"-s", "8", "-o", "b.png", "--resume", checkpoint});
    return run_sateen(drape(more), here).err;
  };
  EXPECT_EQ(goes_on("direct", {"--bounces", "0"}).find(told), std::string::npos);
  EXPECT_EQ(goes_on("direct", {"--bounces", "0", "--error", "0.01"}).find(told), std::string::npos)
      << "asked by hand";
  EXPECT_EQ(goes_on("planned", {}).find(told), std::string::npos);
  EXPECT_NE(goes_on("planned", {"--error", "0.002"}).find(told), std::string::npos);
}

TEST(Render, APictureThatWentOnSaysWhoDecidedAsOneThatNeverStopped) {
  const Folder folder;
  const Start here{folder.path};
  const auto said = [&](const char* name, const char* attribute) {
    return text_of(sateen::read_attributes(folder / name), attribute);
  };
  const auto dupioni = [](std::vector<std::string> more) {
    more.insert(more.begin(), {"-l", "dupioni"});
    return tiny(more);
  };
  ASSERT_EQ(run_sateen(dupioni({"-s", "8", "-o", "whole.exr"}), here).code, 0);
  ASSERT_EQ(run_sateen(dupioni({"-s", "4", "-o", "a.exr", "--checkpoint", "a.checkpoint"}), here).code, 0);
  ASSERT_EQ(run_sateen(dupioni({"-s", "8", "-o", "b.exr", "--resume", "a.checkpoint"}), here).code, 0);
  EXPECT_NE(said("whole.exr", "plan").find("\"pilot\""), std::string::npos);
  EXPECT_EQ(said("b.exr", "plan"), said("whole.exr", "plan"));
  EXPECT_EQ(said("b.exr", "candidates_reason"), said("whole.exr", "candidates_reason"));
  // What was decided otherwise by hand is another picture.
  const Finished other = run_sateen(dupioni({"-o", "c.exr", "--bounces", "7", "--resume", "a.checkpoint"}), here);
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("bounces is"), std::string::npos) << other.err;
  const Finished gaps = run_sateen(dupioni({"-o", "c.exr", "--effects", "+gaps", "--resume", "a.checkpoint"}), here);
  EXPECT_EQ(gaps.code, 2);
  EXPECT_NE(gaps.err.find("effects is"), std::string::npos) << gaps.err;

  ASSERT_EQ(
      run_sateen(dupioni({"-s", "4", "--samples-from", "4", "-o", "c.exr", "--checkpoint", "c.checkpoint"}), here)
          .code,
      0);
  ASSERT_EQ(run_sateen({"merge", "a.checkpoint", "c.checkpoint", "-o", "both.exr"}, here).code, 0);
  EXPECT_EQ(said("both.exr", "plan"), said("whole.exr", "plan"));
}

TEST(Render, SigUsr1WritesThePictureSoFarAndGoesOn) {
  const Folder folder;
  Start start(folder.path, SIGUSR1);
  const Finished run = run_sateen({"render", "-m", "swatch", "--level", "0", "-r", "120", "68", "-s", "400",
                                   "--progress", "json", "-o", "a.exr", "--aov", "none"},
                                  start);
  EXPECT_EQ(run.code, 0) << run.err;
  size_t writes = 0;
  for (size_t at = 0; (at = run.out.find("wrote a.exr", at)) != std::string::npos; ++at) ++writes;
  EXPECT_EQ(writes, 2u) << run.out;
  EXPECT_EQ(whole_of(sateen::read_attributes(folder / "a.exr"), "spp"), 400);
  EXPECT_EQ(files_in(folder), 1u);
}

TEST(Merge, JoinsRangesOfSamplesToTheBitsOfOneRender) {
  const Folder folder;
  const Start here{folder.path};
  const auto part = [&](const char* first, const char* count, const char* name) {
    return run_sateen(tiny({"-s", count, "--samples-from", first, "-o", "p.png", "--aov", "error,samples",
                            "--checkpoint", name}),
                      here)
        .code;
  };
  ASSERT_EQ(part("0", "20", "a"), 0);
  ASSERT_EQ(part("20", "12", "b"), 0);
  ASSERT_EQ(part("32", "7", "c"), 0);
  ASSERT_EQ(part("16", "8", "over"), 0);
  ASSERT_EQ(run_sateen(tiny({"-s", "39", "-o", "whole.exr", "--aov", "error,samples"}), here).code, 0);
  const Finished merged = run_sateen({"merge", "c", "a", "b", "-o", "sum.exr", "-o", "sum.png"}, here);
  ASSERT_EQ(merged.code, 0) << merged.err;
  EXPECT_EQ(sateen::read_image(folder / "sum.exr").pixels, sateen::read_image(folder / "whole.exr").pixels);
  EXPECT_EQ(whole_of(sateen::read_attributes(folder / "sum.exr"), "spp"), 39);
  EXPECT_EQ(sateen::read_attributes(folder / "sum.exr"), sateen::read_attributes(folder / "whole.exr"));
  EXPECT_TRUE(read_text(folder / "sum.exr") == read_text(folder / "whole.exr"));
  const Finished overlap = run_sateen({"merge", "a", "over", "-o", "sum.exr"}, here);
  EXPECT_EQ(overlap.code, 2);
  EXPECT_NE(overlap.err.find("samples 16 to 19"), std::string::npos) << overlap.err;
  const Finished gap = run_sateen({"merge", "a", "c", "-o", "sum.exr"}, here);
  EXPECT_EQ(gap.code, 2);
  EXPECT_NE(gap.err.find("samples 20 to 31 are in none"), std::string::npos) << gap.err;
  EXPECT_EQ(run_sateen(tiny({"--samples-from", "3", "-o", "p.png"}), here).code, 2);
}

TEST(Render, AReaderThatGoesAwayDoesNotCostThePicture) {
  const Folder folder;
  Start start;
  start.folder = folder.path;
  start.close_output = true;
  EXPECT_EQ(run_sateen(tiny({"-o", "a.png"}), start).code, 0);
  EXPECT_EQ(sateen::read_image(folder / "a.png").width, 64);
}

TEST(Render, AFileThatCannotBeWrittenEndsWithOneAndSaysWhy) {
  const Folder folder;
  std::filesystem::create_directory(folder.path / "a.png");
  const Finished run = run_sateen(tiny({"-o", "a.png"}), {folder.path});
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(run.err, "error: a.png cannot be written (it is there and is no regular file); nothing was rendered\n");
}

}  // namespace sateen_test
