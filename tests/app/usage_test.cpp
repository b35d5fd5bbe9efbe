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

TEST(Usage, ASwitchWithAValueOfItsOwnSaysThatItWantsNone) {
  for (const std::string flag : {"--adaptive", "--no-adaptive", "--help"})
    for (const std::string value : {"draft", "2", "99999999999999999999", "-9223372036854775808"})
      expect_refused(run_sateen({"render", "--dry-run", flag + "=" + value}), 2,
                     "error: " + flag + " is " + value + ", expected no value, or true or false\n" + render_usage);
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
  expect_refused(
      run_sateen({"render", "--res", "96"}), 2,
      "error: --res is 96, expected two numbers: a width and a height\n  help: --res 640 360, --res 640x360 or "
      "--res 640,360\n" +
          render_usage);
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

namespace {
/// Whether the words are understood: a window outside of the picture of 96 by 54 is then all that is wrong.
void expect_understood(std::vector<std::string> words) {
  words.insert(words.begin(), "render");
  for (const char* word : {"--crop", "0", "0", "97", "54"}) words.push_back(word);
  expect_refused(run_sateen(words), 2,
                 "error: --crop ends at 97 54, expected at most 96 54, the size of the picture\n");
}
}  // namespace

TEST(Usage, SizesAreUnderstoodInTheFormsThatPeopleType) {
  for (const std::vector<std::string>& size : std::vector<std::vector<std::string>>{{"-r", "96", "54"},
                                                                                    {"-r", "96x54"},
                                                                                    {"-r", "96,54"},
                                                                                    {"--res", "96", "x", "54"},
                                                                                    {"--res=96X54"},
                                                                                    {"-r96*54"},
                                                                                    {"-res", "96, 54"},
                                                                                    {"-r", "1", "2", "-r", "96x54"}})
    expect_understood(size);
}

TEST(Usage, TimesAndSharesAreUnderstoodInTheFormsThatPeopleType) {
  for (const char* time : {"90s", "1min", "1h30m", "2 min", "1.5 hours", "1h 30min"})
    expect_understood({"-r", "96x54", "--time", time});
  expect_understood({"-r", "96x54", "--time", "2", "min", "--error", "2%"});
  expect_understood({"-r", "96x54", "--time=90", "sec", "-error", "2 %"});
  expect_refused(
      run_sateen({"render", "--time", "2", "--error", "2%%"}), 2,
      "error: --error is 2%%, expected a number from 1e-06 to 100, or a percentage such as 2%\n" + render_usage);
  expect_refused(run_sateen({"render", "--time", "1x"}), 2,
                 "error: --time is 1x, expected a time such as 30, 30s, 2m or 1h30m\n" + render_usage);
  EXPECT_NE(run_sateen({"render", "--spp", "5%"}).err.find("--spp is 5%, expected a whole number"),
            std::string::npos);
}

TEST(Usage, ALongFlagWithOneDashIsUnderstood) {
  const Finished run = run_sateen({"look", "resolve", "-set", "weft.coverage=25%", "linen_plain", "-json"});
  EXPECT_EQ(run.code, 0);
  EXPECT_TRUE(is_json(run.out));
  EXPECT_NE(run.out.find("\"0.25\""), std::string::npos) << run.out;
  EXPECT_NE(run_sateen({"render", "-look", "no_such_look"}).err.find("there is no look called no_such_look"),
            std::string::npos);
}

TEST(Usage, AWrongPathNamesTheNearestFieldsFirst) {
  const auto help = [](const std::string& path) {
    const std::string text = run_sateen({"look", "resolve", "linen_plain", "--set", path + "=1"}).err;
    const size_t at = text.find("help: ");
    return at == std::string::npos ? text : text.substr(at + 6);
  };
  EXPECT_EQ(help("warp.gama_s"), "did you mean warp.gamma_s_deg?\n");
  EXPECT_EQ(help("gamma_s"), "did you mean warp.gamma_s_deg or weft.gamma_s_deg?\n");
  EXPECT_EQ(help("wrap.eta"), "did you mean warp.eta?\n");
  EXPECT_EQ(help("draft"), "did you mean weave.draft?\n");
  EXPECT_EQ(help("weft.colour"), "did you mean weft.color?\n");
  EXPECT_NE(help("zzzzzzzz").find("sateen look schema --fields lists all"), std::string::npos) << help("zzzzzzzz");
}

TEST(Usage, EveryMissingFileEndsWithThree) {
  const Folder folder;
  write_text(folder / "texture.json", R"({"warp": {"k_d": {"texture": "no.png"}}})");
  write_text(folder / "draft.json", R"({"weave": {"draft": "no.wif"}})");
  write_text(folder / "parent.json", R"({"inherits": "./no.json"})");
  write_text(folder / "back.json", R"({"back": "./no.json"})");
  write_text(folder / "pattern.json", R"({"pattern": {"mask": 0.5, "look": "./no.json"}})");
  const std::vector<std::vector<std::string>> all{{"render", "--look", "./no.json"},
                                                  {"render", "--look", "no_such_look"},
                                                  {"render", "--look", "./texture.json"},
                                                  {"render", "--look", "./draft.json"},
                                                  {"render", "--look", "./parent.json"},
                                                  {"render", "--look", "./back.json"},
                                                  {"render", "--look", "./pattern.json"},
                                                  {"render", "--set", "back=./no.json"},
                                                  {"render", "--set", "weave.draft=no.wif"},
                                                  {"render", "--mesh", "no.obj"},
                                                  {"render", "--mesh", "no_such_shape"},
                                                  {"render", "--env", "no.exr"},
                                                  {"render", "--env", "no_such_light"},
                                                  {"render", "--ocio", "no.ocio"},
                                                  {"render", "--resume", "no.checkpoint"},
                                                  {"turntable", "--look", "./no.json"},
                                                  {"plan", "--mesh", "no.obj"},
                                                  {"cost", "--env", "no.exr"},
                                                  {"study", "--looks", "./no.json"},
                                                  {"study", "--envs", "no_such_light"},
                                                  {"merge", "no.checkpoint", "nor.checkpoint", "-o", "a.exr"},
                                                  {"look", "resolve", "./no.json"},
                                                  {"look", "check", "./texture.json"},
                                                  {"look", "diff", "linen_plain", "./no.json"},
                                                  {"lobe", "./no.json"},
                                                  {"lobe", "linen_plain", "--pairs", "no.json"},
                                                  {"env", "inspect", "no.exr"},
                                                  {"env", "make", "no.json", "-o", "a.exr"},
                                                  {"check", "no.obj"},
                                                  {"check", "./draft.json"}};
  for (const auto& words : all) {
    std::string line;
    for (const std::string& word : words) line += word + " ";
    const Finished run = run_sateen(words, folder.path);
    EXPECT_EQ(run.code, 3) << line << "\n" << run.out << run.err;
  }
}

}  // namespace sateen_test
