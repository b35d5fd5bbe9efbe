#include <gtest/gtest.h>

#include "image/file.h"
#include "program.h"

namespace sateen_test {

namespace {
void expect_refused(const std::vector<std::string>& flags, const std::string& says) {
  const Folder folder;
  std::vector<std::string> words = tiny({"-o", "a.png"});
  words.insert(words.end(), flags.begin(), flags.end());
  const Finished run = run_sateen(words, {folder.path});
  EXPECT_EQ(run.code, 2) << run.err;
  EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
}
}  // namespace

TEST(StageFlags, RenderEveryEffect) {
  const Folder folder;
  std::vector<float> plain;
  const std::vector<std::vector<std::string>> effects{
      {},
      {"--ground", "floor"},
      {"--ground", "catcher"},
      {"--ground", "cyclorama", "--ground-color", "0.2,0.3,0.4"},
      {"--ground", "floor", "--ground-height", "-1"},
      {"--f-stop", "0.2", "--focus", "auto", "--blades", "5", "--metres-per-unit", "0.01"},
      {"--f-stop", "0.2", "--focus", "3"},
      {"--shutter", "30"},
      {"--backdrop", "blurred"},
      {"--backdrop", "blurred:60"},
      {"--backdrop", "environment"},
      {"--backdrop", "0.1,0.2,0.3"},
      {"--references", "-r", "128", "96"}};
  for (const auto& effect : effects) {
    std::vector<std::string> words = tiny({"-o", "a.png", "--mesh", "drape", "--strict", "--bounces", "1"});
    words.insert(words.end(), effect.begin(), effect.end());
    const Finished run = run_sateen(words, {folder.path});
    const std::string name = effect.empty() ? "plain" : effect.back();
    ASSERT_EQ(run.code, 0) << name << run.err;
    const sateen::Image image = sateen::read_image(folder / "a.png");
    if (effect.empty())
      plain = image.pixels;
    else
      EXPECT_NE(image.pixels, plain) << name;
  }
}

TEST(StageFlags, WantWhatTheyArePartOf) {
  expect_refused({"--ground-height", "1"}, "--ground-height wants --ground");
  expect_refused({"--focus", "2"}, "--focus wants --f-stop");
  expect_refused({"--f-stop", "2", "--focus", "near"}, "expected auto or a distance in metres");
  expect_refused({"--ground", "flor"}, "did you mean floor?");
  expect_refused({"--ground", "floor", "--ground-color", "0.4,0.4"}, "expected three numbers");
  expect_refused({"--ground", "floor", "--ground-color", "0.4,0.4,1.5"}, "1.5");
  expect_refused({"--backdrop", "blured"}, "did you mean blurred?");
  expect_refused({"--backdrop", "blurred:0"}, "2 to 180");
  expect_refused({"--references"}, "at least 96");
}

TEST(StageFlags, AnotherStageIsAnotherPictureForACheckpoint) {
  const Folder folder;
  ASSERT_EQ(run_sateen(tiny({"-o", "a.png", "--checkpoint", "c", "--ground", "floor"}), {folder.path}).code, 0);
  for (const std::vector<std::string>& flags :
       std::vector<std::vector<std::string>>{{}, {"--ground", "catcher"}, {"--ground", "floor", "--shutter", "5"}}) {
    std::vector<std::string> words = tiny({"-o", "a.png", "--resume", "c", "-s", "8"});
    words.insert(words.end(), flags.begin(), flags.end());
    const Finished run = run_sateen(words, {folder.path});
    EXPECT_EQ(run.code, 2);
    EXPECT_NE(run.err.find("is of another picture"), std::string::npos) << run.err;
  }
  EXPECT_EQ(run_sateen(tiny({"-o", "a.png", "--resume", "c", "-s", "8", "--ground", "floor"}), {folder.path}).code,
            0);
}

TEST(StageFlags, ReferencesAreMeasured) {
  const Folder folder;
  const Finished run =
      run_sateen(tiny({"-o", "a.png", "--stats", "s.json", "--references", "-r", "160", "120"}), {folder.path});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("grey ball of 18 %"), std::string::npos) << run.out;
  const std::string stats = read_text(folder / "s.json");
  ASSERT_TRUE(is_json(stats));
  for (const char* name : {"\"references\"", "\"grey_ball\"", "\"brightest\"", "\"neutral 5\"", "\"code\""})
    EXPECT_NE(stats.find(name), std::string::npos) << name;
}

TEST(StageFlags, ATurntableBlursItsTurn) {
  const Folder folder;
  const std::vector<std::string> words{"turntable", "-m", "swatch", "--level",    "0",          "--env", "overcast",
                                       "-r",        "48", "27",     "-s",         "4",          "-n",    "4",
                                       "--frames",  "2",  "-o",     "t.####.png", "--progress", "none"};
  const auto frame = [&](std::vector<std::string> more) {
    std::vector<std::string> all = words;
    all.insert(all.end(), more.begin(), more.end());
    EXPECT_EQ(run_sateen(all, {folder.path}).code, 0);
    return sateen::read_image(folder / "t.0002.png").pixels;
  };
  const auto still = frame({}), blurred = frame({"--motion-blur", "0.5"});
  EXPECT_NE(still, blurred);
  EXPECT_NE(frame({"--motion-blur", "0.5", "--turn", "camera"}), blurred);
  EXPECT_EQ(frame({"--redo"}), still);
  std::vector<std::string> light = words;
  light.insert(light.end(), {"--motion-blur", "0.5", "--turn", "light"});
  EXPECT_EQ(run_sateen(light, {folder.path}).code, 2);
}

}  // namespace sateen_test
