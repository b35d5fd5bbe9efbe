#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

#include "image/file.h"
#include "program.h"

namespace sateen_test {

namespace {
std::vector<std::string> orbit(std::vector<std::string> more) {
  std::vector<std::string> words{"turntable",  "-m",   "swatch", "--level", "0",  "--env",
                                 "overcast",   "-r",   "48",     "27",      "-s", "4",
                                 "--progress", "none", "-n",     "4",       "-o", "t.####.png"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}
}  // namespace

TEST(TurntableCommand, WritesNumberedFramesThatDifferAndASheet) {
  const Folder folder;
  const Finished run = run_sateen(orbit({"--sheet", "sheet.png"}), {folder.path});
  ASSERT_EQ(run.code, 0) << run.err;
  std::vector<float> last;
  for (int i = 1; i <= 4; ++i) {
    const sateen::Image image = sateen::read_image(folder / ("t.000" + std::to_string(i) + ".png"));
    EXPECT_EQ(image.width, 48);
    EXPECT_NE(image.pixels, last);
    last = image.pixels;
  }
  EXPECT_GT(sateen::read_image(folder / "sheet.png").width, 2 * 48);
}

TEST(TurntableCommand, FinishedFramesAreKeptAndOthersMadeAgain) {
  const Folder folder;
  ASSERT_EQ(run_sateen(orbit({}), {folder.path}).code, 0);
  const auto second_written = std::filesystem::last_write_time(folder / "t.0002.png");
  const std::string third = read_text(folder / "t.0003.png");
  write_text(folder / "t.0003.png", third.substr(0, third.size() / 2));
  std::filesystem::remove(folder / "t.0004.png");
  const Finished again = run_sateen(orbit({}), {folder.path});
  EXPECT_EQ(again.code, 0);
  EXPECT_NE(again.out.find("4 frames, 2 of them finished already"), std::string::npos) << again.out;
  EXPECT_EQ(std::filesystem::last_write_time(folder / "t.0002.png"), second_written);
  EXPECT_EQ(sateen::read_image(folder / "t.0003.png").width, 48);
  EXPECT_TRUE(std::filesystem::exists(folder / "t.0004.png"));
  // Whatever changes the pixels is another job.
  std::vector<std::vector<std::string>> changes{
      {"-s", "8"}, {"--set", "warp.eta=1.5"}, {"--env-rotate", "5"}, {"--redo"}};
  if (std::getenv("SATEEN_LONG_TESTS"))
    changes.insert(changes.end(), {{"--look", "velvet"},
                                   {"--seed", "2"},
                                   {"--turn", "light"},
                                   {"--exposure", "1"},
                                   {"--view", "Un-tone-mapped"},
                                   {"--transparent"},
                                   {"--bounces", "1"},
                                   {"--mesh", "sphere"}});
  for (const std::vector<std::string>& change : changes) {
    auto words = orbit({"--dry-run"});
    words.insert(words.end(), change.begin(), change.end());
    const Finished run = run_sateen(words, {folder.path});
    EXPECT_NE(run.out.find("\n4 frames\n"), std::string::npos) << change[0] << "\n" << run.out;
  }
}

TEST(TurntableCommand, ChosenFramesStandAtTheAnglesOfTheWholeOrbit) {
  const Folder folder;
  ASSERT_EQ(run_sateen(orbit({}), {folder.path}).code, 0);
  const std::vector<float> whole = sateen::read_image(folder / "t.0003.png").pixels;
  const Finished run = run_sateen(orbit({"--frames", "3", "--redo"}), {folder.path});
  ASSERT_EQ(run.code, 0);
  EXPECT_EQ(sateen::read_image(folder / "t.0003.png").pixels, whole);
  const Finished json = run_sateen(orbit({"--frames", "3..4", "--json"}), {folder.path});
  EXPECT_TRUE(is_json(json.out));
  EXPECT_NE(json.out.find("\"angle_deg\": 180"), std::string::npos);
  EXPECT_NE(json.out.find("\"angle_deg\": 270"), std::string::npos);
  EXPECT_NE(json.out.find("\"skipped\": true"), std::string::npos);
}

TEST(TurntableCommand, AnObjectThatTurnsByNothingIsTheCameraThatWalksByNothing) {
  const Folder folder;
  ASSERT_EQ(run_sateen(orbit({"--frames", "1", "-o", "o.exr", "--aov", "none"}), {folder.path}).code, 0);
  ASSERT_EQ(
      run_sateen(orbit({"--frames", "1", "--turn", "camera", "-o", "c.exr", "--aov", "none"}), {folder.path}).code,
      0);
  EXPECT_EQ(sateen::read_image(folder / "o.exr").pixels, sateen::read_image(folder / "c.exr").pixels);
}

TEST(TurntableCommand, ASignalEndsTheOrbitAndTheNextRunFinishesIt) {
  const Folder folder;
  Start start(folder.path, SIGINT);
  const std::vector<std::string> words{"turntable", "-m", "swatch", "--level", "0", "--env", "overcast",
                                       "-r",        "48", "27",     "-n",      "2", "-o",    "t.#.png"};
  auto slow = words;
  slow.insert(slow.end(), {"-s", "1000000", "--progress", "json"});
  EXPECT_EQ(run_sateen(slow, start).code, 130);
  EXPECT_FALSE(std::filesystem::exists(folder / "t.0001.png")) << "somebody may wait for it";
  EXPECT_EQ(sateen::read_image(folder / "t.0001.partial.png").width, 48);
  EXPECT_FALSE(std::filesystem::exists(folder / "t.0002.png"));
  slow.push_back("--dry-run");
  EXPECT_NE(run_sateen(slow, {folder.path}).out.find("\n2 frames\n"), std::string::npos);
}

}  // namespace sateen_test
