#include <gtest/gtest.h>

#include "program.h"

namespace sateen_test {

namespace {
void expect_refused(const Finished& run, int code, const std::string& message) {
  EXPECT_EQ(run.code, code);
  EXPECT_EQ(run.err, message);
  EXPECT_EQ(run.out, "");
}
const std::string render_usage =
    "usage: sateen render [--look NAME] [--mesh FILE] [--env MAP] [-o FILE]... [flags]\n";
}  // namespace

TEST(Usage, AMisspeltFlagIsAnsweredWithTheNearestOne) {
  expect_refused(run_sateen({"render", "--lok", "silk"}), 2,
                 "error: there is no flag --lok\n  help: did you mean --look?\n" + render_usage);
}

TEST(Usage, TheStartOfAFlagIsAnsweredWithTheWholeOne) {
  expect_refused(run_sateen({"render", "--expos=1"}), 2,
                 "error: there is no flag --expos\n  help: did you mean --exposure?\n" + render_usage);
}

TEST(Usage, EveryFaultOfACommandLineIsToldAtOnce) {
  expect_refused(run_sateen({"render", "--spp", "0", "--fov", "wide", "--wat"}), 2,
                 "error: --fov is wide, expected a number from 1 to 150\n"
                 "error: --spp is 0, expected a whole number from 1 to 1073741824\n"
                 "error: there is no flag --wat\n  help: sateen render --help lists the flags\n" +
                     render_usage);
}

TEST(Usage, AMisspeltValueIsAnsweredWithTheNearestOne) {
  expect_refused(run_sateen({"render", "--strategy", "mis-compensate"}), 2,
                 "error: unknown strategy 'mis-compensate'\n  help: did you mean mis-compensated?\n");
  expect_refused(run_sateen({"render", "--progress", "barr"}), 2,
                 "error: --progress is barr\n  help: did you mean bar?\n" + render_usage);
  expect_refused(run_sateen({"render", "--aov", "albedo,norml"}), 2,
                 "error: there is no layer norml\n  help: known: direct, indirect, indirect_1, indirect_2, "
                 "indirect_3, indirect_more, through_gaps, backdrop, surface, volume, warp_surface, "
                 "warp_volume, weft_surface, weft_volume, albedo, N, P, warp, uv, error, samples\n");
}

TEST(Usage, AnUnknownQualityIsAnsweredWithTheNearestOne) {
  expect_refused(run_sateen({"render", "--quality", "fnial"}), 2,
                 "error: there is no quality fnial\n  help: did you mean final?\n");
}

TEST(Usage, AFlagWithoutItsValueSaysWhatItWants) {
  expect_refused(run_sateen({"render", "--look"}), 2, "error: --look wants its value: NAME|FILE\n" + render_usage);
}

TEST(Usage, AMisspeltCommandIsAnsweredWithTheNearestOne) {
  expect_refused(run_sateen({"rendr"}), 2, "error: there is no command sateen rendr\n  help: did you mean render?\n");
  expect_refused(run_sateen({"look", "chek"}), 2,
                 "error: there is no command sateen look chek\n  help: did you mean check?\n");
}

TEST(Usage, AMissingLookNamesTheNearestAndEndsWithThree) {
  expect_refused(run_sateen({"render", "--look", "emrald_satin"}), 3,
                 "error: there is no look called emrald_satin\n  help: did you mean emerald_satin?\n");
}

TEST(Usage, AMissingMeshEndsWithThree) {
  const Finished run = run_sateen({"render", "--mesh", "no/such.obj"});
  EXPECT_EQ(run.code, 3);
  EXPECT_EQ(run.err, "error: no/such.obj: no such file\n  help: there is no folder no\n");
}

TEST(Usage, AMissingMapNamesTheNearestAndEndsWithThree) {
  const Finished run = run_sateen({"render", "--env", "studio_softbox"});
  EXPECT_EQ(run.code, 3);
  EXPECT_NE(run.err.find("did you mean studio_softboxes?"), std::string::npos) << run.err;
}

TEST(Usage, AnUnknownFieldOfTheLookEndsWithTwoAndNamesTheNearest) {
  const Finished run = run_sateen({"render", "--set", "warp.gama_s_deg=4"});
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("warp.gamma_s_deg"), std::string::npos) << run.err;
}

TEST(Usage, AWrongKeyOfALookFileIsToldWithItsPlace) {
  const Folder folder;
  write_text(folder / "mine.json", "{\n  \"warp\": { \"gama_s_deg\": 4 }\n}\n");
  const Finished run = run_sateen({"render", "--look", "mine.json"}, {folder.path});
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(run.err.rfind("mine.json:2:13: error: ", 0), 0u) << run.err;
  EXPECT_NE(run.err.find("did you mean gamma_s_deg?"), std::string::npos) << run.err;
}

TEST(Usage, OutputsThatCannotBeWrittenAreRefusedBeforeAnythingIsRendered) {
  expect_refused(run_sateen({"render", "-o", "a.pgn"}), 2,
                 "error: a.pgn: pictures of kind .pgn are not written\n  help: did you mean png?\n");
  expect_refused(run_sateen({"render", "-o", "picture"}), 2,
                 "error: picture has no extension, which picks the format\n  help: add .png, .exr, .jpg or .tif\n");
  expect_refused(
      run_sateen({"render", "-o", "/proc/nowhere/a.png"}), 1,
      "error: /proc/nowhere/a.png cannot be written (its folder cannot be made: No such file or directory); "
      "nothing was rendered\n");
}

TEST(Usage, ACropOutsideThePictureIsRefused) {
  expect_refused(run_sateen({"render", "-r", "64", "36", "--crop", "0", "0", "65", "36"}), 2,
                 "error: --crop ends at 65 36, expected at most 64 36, the size of the picture\n");
}

TEST(Usage, FlagsOfSeveralValuesSayHowManyTheyWant) {
  expect_refused(run_sateen({"render", "--crop", "1", "2", "3"}), 2,
                 "error: --crop wants 4 values: X0 Y0 X1 Y1\n" + render_usage);
  expect_refused(run_sateen({"render", "--res", "96"}), 2,
                 "error: --res is 96, expected two numbers: a width and a height\n" + render_usage);
}

TEST(Usage, AMisspeltShapeIsAnsweredWithTheNearestOne) {
  expect_refused(run_sateen({"render", "--mesh", "drap"}), 3,
                 "error: there is no mesh called drap\n  help: did you mean drape? (or the path of an OBJ)\n");
}

TEST(Usage, ARangeIntoANameWithoutAPlaceIsRefused) {
  expect_refused(run_sateen({"turntable", "--frames", "1-3", "-o", "turn.png"}), 2,
                 "error: --output turn.png has no place for a frame's number, and there are 3 frames\n"
                 "  help: write it such as turn.####.png\n");
}

TEST(Usage, AnUnknownColourConfigViewAndSpaceAreLoud) {
  EXPECT_EQ(run_sateen({"render", "--ocio", "no.ocio"}).code, 3);
  const Finished view = run_sateen({"render", "--view", "ACES SD"});
  EXPECT_EQ(view.code, 2);
  EXPECT_NE(view.err.find("did you mean ACES SDR?"), std::string::npos) << view.err;
  EXPECT_EQ(run_sateen({"render", "--working", "srgb_texture"}).code, 2);
}

TEST(Usage, EveryCommandHasHelpWithExamples) {
  const std::vector<std::vector<std::string>> commands{
      {"study"},        {"cost"},           {"render"},        {"turntable"},
      {"lobe"},         {"check"},          {"look", "check"}, {"look", "resolve"},
      {"look", "diff"}, {"look", "schema"}, {"env", "make"},   {"env", "inspect"}};
  for (auto words : commands) {
    words.push_back("--help");
    const Finished run = run_sateen(words);
    EXPECT_EQ(run.code, 0);
    EXPECT_EQ(run.err, "");
    EXPECT_NE(run.out.find("Examples\n  sateen " + words[0]), std::string::npos) << run.out;
    words.pop_back();
    words.insert(words.begin(), "help");
    EXPECT_EQ(run_sateen(words).out, run.out);
  }
}

TEST(Usage, NoLineOfHelpIsWiderThanATerminal) {
  for (const std::string command : {"render", "turntable", "lobe", "check", "study", "cost"}) {
    const std::string help = run_sateen({command, "--help"}).out;
    for (size_t at = 0, end = 0; at < help.size(); at = end + 1) {
      end = std::min(help.find('\n', at), help.size());
      EXPECT_LE(end - at, 120u) << help.substr(at, end - at);
    }
  }
}

TEST(Usage, TheOverviewNamesEveryCommandAndExitCode) {
  const Finished run = run_sateen({});
  EXPECT_EQ(run.code, 0);
  for (const char* word : {"render", "turntable", "cost", "study", "look", "lobe", "env", "check", "130, 143"})
    EXPECT_NE(run.out.find(word), std::string::npos) << word;
  EXPECT_EQ(run_sateen({"--help"}).out, run.out);
  EXPECT_EQ(run_sateen({"help"}).out, run.out);
  EXPECT_EQ(run_sateen({"--version"}).out.rfind("sateen ", 0), 0u);
}

TEST(Usage, AReaderThatGoesAwayIsNoError) {
  Start start;
  start.close_output = true;
  const Finished run = run_sateen({"look", "check"}, start);
  EXPECT_EQ(run.code, 0);
  EXPECT_EQ(run.err, "");
}

}  // namespace sateen_test
