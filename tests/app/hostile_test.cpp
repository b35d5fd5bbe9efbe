// Hostile inputs with the whole of what the program answers, and what that may cost. After a message was changed:
//     SATEEN_UPDATE_GOLDEN=1 build/bin/test_app --gtest_filter='Hostile*' && git diff tests/app/hostile
#include <gtest/gtest.h>

#include <algorithm>

#include "hostile_case.h"
#include "program.h"

namespace sateen_test {

namespace fs = std::filesystem;

namespace {

constexpr double most_cpu_seconds = 1, most_mib = 256;

std::vector<fs::path> case_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path(SATEEN_SOURCE_DIR) / "tests/app/hostile"))
    if (entry.path().extension() == ".txt") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::string with_names(std::string text, const fs::path& folder) {
  for (const auto& [path, name] :
       {std::pair(folder.string(), "$FOLDER"), std::pair(std::string(SATEEN_SOURCE_DIR), "$SOURCE")})
    for (size_t at = 0; (at = text.find(path, at)) != std::string::npos;) text.replace(at, path.size(), name);
  return text;
}

// What sanitizers add to time and memory is not the program's.
bool costs_count() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return false;
#else
  return true;
#endif
}

bool terminal_would_obey(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') || c == 0x7f;
  });
}

}  // namespace

TEST(Hostile, EveryInputIsAnsweredAsRecordedForLittleTimeAndMemory) {
  const bool update = std::getenv("SATEEN_UPDATE_GOLDEN") != nullptr;
  const std::vector<fs::path> files = case_files();
  EXPECT_GE(files.size(), 80u);
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.filename().string());
    HostileCase golden = read_hostile_case(file);
    const Folder folder;
    for (const auto& [name, contents] : golden.files) {
      fs::create_directories(fs::path(folder / name).parent_path());
      write_text(folder / name, contents);
    }
    const Finished run = run_sateen(golden.run, folder.path);
    const std::string out = with_names(run.out, folder.path), err = with_names(run.err, folder.path);
    EXPECT_FALSE(terminal_would_obey(out + err));
    EXPECT_LT(run.code, 6);  // no signal, no abort
    if (costs_count()) {
      EXPECT_LT(run.cpu_seconds, most_cpu_seconds);
      EXPECT_LT(run.peak_mib, most_mib);
    }
    if (update) {
      golden.exit_code = run.code;
      golden.out = out;
      golden.err = err;
      write_text(file, write_hostile_case(golden));
      continue;
    }
    EXPECT_EQ(run.code, golden.exit_code);
    EXPECT_EQ(out, golden.out);
    EXPECT_EQ(err, golden.err);
  }
}

TEST(Hostile, NoControlCharacterOfAnyKindOfFileReachesTheTerminal) {
  const Folder folder;
  const std::string clear = "\x1b[2J";
  write_text(folder / ("a" + clear + ".obj"),
             "g " + clear + "\nusemtl " + clear + "\nv 0 0 0\nf 1 2 " + clear + "\n");
  write_text(folder / ("a" + clear + ".hdr"), "#?RADIANCE\nFORMAT=" + clear + "\n\n-Y 2 +X 4\n");
  write_text(
      folder / "a.ocio",
      "ocio_profile_version: 2\n\"un\\e[2Jknown\": 3\nroles: {default: \"raw\\e[2J\", scene_linear: \"raw\\e[2J\"}\n"
      "displays: {\"d\\e[2J\": [!<View> {name: v, colorspace: \"raw\\e[2J\"}]}\n"
      "colorspaces: [!<ColorSpace> {name: \"raw\\e[2J\"}]\n");
  write_text(folder / "a.json", "{\"title\": \"\\u001b[2J\\u009b\", \"back\": \"\\u001b[2J\"}");
  write_text(folder / "a.wif", "[WIF]\n[WEAVING]\nRising Shed=" + clear + "\n");
  const std::vector<std::vector<std::string>> all{{"check", "a" + clear + ".obj"},
                                                  {"env", "inspect", "a" + clear + ".hdr"},
                                                  {"render", "--ocio", "a.ocio", "--display", clear},
                                                  {"look", "check", "./a.json"},
                                                  {"look", "resolve", "linen_plain", "--set", "weave.draft=a.wif"},
                                                  {"render", "--mesh", clear, "--env", clear, "-o", clear + ".png"},
                                                  {"merge", clear, clear, "-o", "a.exr"},
                                                  {clear}};
  for (const auto& words : all) {
    const Finished run = run_sateen(words, folder.path);
    EXPECT_NE(run.code, 0);
    EXPECT_FALSE(terminal_would_obey(run.out + run.err)) << words[0];
    EXPECT_NE((run.out + run.err).find("\\x1b[2J"), std::string::npos) << words[0] << "\n" << run.err;
  }
}

}  // namespace sateen_test
