#include <gtest/gtest.h>

#include <regex>

#include "base/memory.h"
#include "program.h"

namespace sateen_test {

namespace {

/// Bytes in "1.2 GB" or "350 MB" behind some words.
double bytes_after(const std::string& text, const std::string& before, const std::string& behind) {
  std::smatch m;
  const std::regex shape(before + R"(([0-9.]+) (GB|MB))" + behind);
  if (!std::regex_search(text, m, shape)) return -1;
  return std::stod(m[1]) * (m[2] == "GB" ? 1e9 : 1e6);
}

std::vector<std::string> large(std::vector<std::string> more) {
  std::vector<std::string> words{"render", "-m",           "swatch",   "--level",
                                 "0",      "--env",        "overcast", "--effects",
                                 "none",   "--bounces",    "0",        "--candidates",
                                 "2",      "--table-size", "0.125",    "-s",
                                 "1",      "--progress",   "none",     "-v"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

}  // namespace

TEST(Memory, WhatIsForeseenIsWhatIsTaken) {
  const std::vector<std::vector<std::string>> settings{
      {"-r", "64", "36", "-o", "a.exr"},
      {"-r", "64", "36", "-o", "a.png"},
      {"-r", "700", "500", "-o", "a.exr", "--aov", "none"},
      {"-r", "700", "500", "-o", "a.exr", "-o", "a.png", "--checkpoint", "c"},
  };
  for (const auto& each : settings) {
    const Folder folder;
    std::vector<std::string> words = large(each);
    words.insert(words.end(), {"--stats", "s.json"});
    const Finished run = run_sateen(words, {folder.path});
    ASSERT_EQ(run.code, 0) << run.err;
    const double foreseen = bytes_after(run.err, "at most so far, ", " foreseen");
    std::smatch m;
    const std::string stats = read_text(folder / "s.json");
    ASSERT_TRUE(std::regex_search(stats, m, std::regex(R"re("peak_memory_bytes":\s*(\d+))re"))) << stats;
    const double peak = std::stod(m[1]);
    EXPECT_NEAR(foreseen / peak, 1, 0.2) << "foreseen " << foreseen << ", peak " << peak << "\n" << run.err;
  }
}

// The sanitizers' addresses are no measure.
#if !defined(__SANITIZE_ADDRESS__)
TEST(Memory, ADryRunTakesNoneOfThePicturesAndSaysThatItWouldNotFit) {
  const Folder folder;
  const ResourceLimit limit(RLIMIT_AS, 1'000'000'000);
  const Finished run =
      run_sateen(large({"-r", "6000", "6000", "-t", "1", "-o", "a.exr", "--dry-run"}), {folder.path});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("this machine would refuse it: --res 6000 6000 takes "), std::string::npos) << run.err;
}

TEST(Memory, AStackThatIsTooSmallIsRaisedWhereThatIsAllowedAndRefusedElsewhere) {
  const Folder folder;
  const auto render_below = [&](const std::string& limit) {
    Start start(folder.path);
    start.program = "/bin/sh";
    std::vector<std::string> words{"-c", "ulimit " + limit + " && exec \"$@\"", "sh", SATEEN_PROGRAM};
    const std::vector<std::string> render = tiny({"-o", "a.png"});
    words.insert(words.end(), render.begin(), render.end());
    return run_sateen(words, start);
  };
  const Finished raised = render_below("-S -s 64");
  EXPECT_EQ(raised.code, 0) << raised.err;
  const Finished refused = render_below("-s 64");
  EXPECT_EQ(refused.code, 1);
  EXPECT_EQ(refused.err, "error: ulimit -s allows 64 kB of stack, expected at least 512\n  help: ulimit -s 8192\n");
}

TEST(Memory, CheckpointsThatDoNotFitAreNotReadToBeMerged) {
  const Folder folder;
  for (const char* name : {"a", "b"}) {
    write_text(folder / name, "");
    std::filesystem::resize_file(folder / name, 4'000'000'000);  // sparse
  }
  const ResourceLimit limit(RLIMIT_AS, 2'000'000'000);
  const Finished run = run_sateen({"merge", "a", "b", "-o", "a.png"}, {folder.path});
  EXPECT_EQ(run.code, 2) << run.err;
  EXPECT_NE(run.err.find("error: to join two checkpoints takes 8.0 GB, and ulimit -v allows 2.0 GB"),
            std::string::npos)
      << run.err;
}

TEST(Memory, APictureThatDoesNotFitIsRefusedBeforeItIsRenderedAndOneThatFitsIsWritten) {
  const Folder folder;
  Finished run;
  {
    const ResourceLimit limit(RLIMIT_AS, 1'000'000'000);
    run = run_sateen(large({"-r", "2000", "2000", "-t", "1", "-o", "a.exr", "--checkpoint", "c"}), {folder.path});
  }
  EXPECT_EQ(run.code, 2) << run.err;
  EXPECT_NE(run.err.find("error: --res 2000 2000 takes "), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("ulimit -v allows 1.0 GB"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("--aov none takes "), std::string::npos) << run.err;
  EXPECT_EQ(run.out.find("wrote"), std::string::npos);
  // What it says would fit does.
  std::smatch m;
  ASSERT_TRUE(std::regex_search(run.err, m, std::regex(R"(--res (\d+) (\d+) fits)"))) << run.err;
  if (!std::getenv("SATEEN_LONG_TESTS")) return;
  const ResourceLimit limit(RLIMIT_AS, 1'000'000'000);
  run = run_sateen(large({"-r", m[1], m[2], "-t", "1", "-o", "a.exr", "--checkpoint", "c"}), {folder.path});
  EXPECT_EQ(run.code, 0) << run.err;
}
#endif

}  // namespace sateen_test
