#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <map>
#include <random>
#include <thread>

#include "image/file.h"
#include "program.h"

namespace sateen_test {

// Ends at instants that nobody chose: what is there afterwards is whole, and goes on to the same bytes.
namespace {

namespace fs = std::filesystem;

bool long_tests() {
  return std::getenv("SATEEN_LONG_TESTS") != nullptr;
}

std::vector<std::string> still(std::vector<std::string> more) {
  std::vector<std::string> words = tiny(
      {"--level",      "0", "-s",    "256",  "-t", "1",     "--effects",    "none", "--bounces",          "0",
       "--candidates", "2", "--aov", "none", "-o", "a.exr", "--checkpoint", "c",    "--checkpoint-every", "0.05"});
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

const std::vector<std::string> orbit{"turntable",    "-m", "swatch",    "--level",    "0",          "--env",
                                     "overcast",     "-r", "48",        "27",         "-s",         "64",
                                     "-t",           "1",  "--effects", "none",       "--bounces",  "0",
                                     "--candidates", "2",  "--aov",     "none",       "--progress", "none",
                                     "-n",           "4",  "-o",        "t.####.exr", "-o",         "t.####.png"};

std::map<std::string, std::string> pictures(const Folder& folder) {
  std::map<std::string, std::string> all;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.path)) {
    const std::string extension = entry.path().extension().string(), name = entry.path().filename().string();
    if (name[0] != '.' && (extension == ".exr" || extension == ".png")) all[name] = read_text(entry.path());
  }
  return all;
}

int leftovers(const Folder& folder) {
  int count = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.path))
    count += entry.path().filename().string()[0] == '.';
  return count;
}

void expect_whole(const Folder& folder) {
  for (const auto& [name, bytes] : pictures(folder))
    EXPECT_NO_THROW(sateen::read_image(folder / name)) << name << " is torn";
}

double duration_of(const std::vector<std::string>& words, const Folder& folder,
                   std::map<std::string, std::string>& all) {
  const auto begun = std::chrono::steady_clock::now();
  EXPECT_EQ(run_sateen(words, {folder.path}).code, 0);
  all = pictures(folder);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

}  // namespace

TEST(Kills, OfARenderWithACheckpointAreGoneOnFromToTheSameBytes) {
  std::mt19937 random(1);
  std::map<std::string, std::string> meant;
  double seconds = 0;
  {
    const Folder folder;
    seconds = duration_of(still({}), folder, meant);
  }
  int resumed = 0;
  for (int i = 0; i < (long_tests() ? 50 : 3); ++i) {
    const Folder folder;
    Start start;
    start.folder = folder.path;
    start.signal = SIGKILL;
    start.signal_seconds = seconds * std::uniform_real_distribution(0.2, 1.0)(random);
    run_sateen(still({}), start);
    expect_whole(folder);
    const bool there = fs::exists(folder / "c");
    resumed += there;
    const Finished on = run_sateen(there ? still({"--resume", "c"}) : still({}), {folder.path});
    EXPECT_EQ(on.code, 0) << on.err;
    EXPECT_TRUE(pictures(folder) == meant) << "killed after " << start.signal_seconds << " s";
    EXPECT_EQ(leftovers(folder), 0);
  }
  if (long_tests()) {
    EXPECT_GT(resumed, 25);
  }
}

TEST(Kills, OfATurntableAreGoneOnFromToTheSameBytes) {
  std::mt19937 random(2);
  std::map<std::string, std::string> meant;
  double seconds = 0;
  {
    const Folder folder;
    seconds = duration_of(orbit, folder, meant);
  }
  ASSERT_EQ(meant.size(), 8u);
  for (int i = 0; i < (long_tests() ? 50 : 3); ++i) {
    const Folder folder;
    Start start;
    start.folder = folder.path;
    start.signal = SIGKILL;
    start.signal_seconds = seconds * std::uniform_real_distribution(0.1, 1.0)(random);
    run_sateen(orbit, start);
    expect_whole(folder);
    EXPECT_EQ(run_sateen(orbit, {folder.path}).code, 0);
    EXPECT_TRUE(pictures(folder) == meant) << "killed after " << start.signal_seconds << " s";
    EXPECT_EQ(leftovers(folder), 0);
  }
}

TEST(Kills, SignalsAtAnyInstantLeaveWholeFilesAndTheirCode) {
  std::mt19937 random(3);
  for (int i = 0; i < (long_tests() ? 60 : 4); ++i) {
    const Folder folder;
    Start start;
    start.folder = folder.path;
    start.signal = std::array{SIGINT, SIGTERM, SIGHUP, SIGUSR1}[size_t(i % 4)];
    start.signal_seconds = std::uniform_real_distribution(0.02, 1.0)(random);
    const Finished run = run_sateen(still({}), start);
    SCOPED_TRACE(testing::Message() << "signal " << start.signal << " after " << start.signal_seconds << " s");
    // Before the program has said what it does with a signal, it is what the system does.
    EXPECT_TRUE(run.code == 0 || run.code == 128 + start.signal) << run.code << "\n" << run.err;
    expect_whole(folder);
    EXPECT_EQ(leftovers(folder), 0);
    EXPECT_TRUE(run.code != 0 || fs::exists(folder / "a.exr"));
  }
}

TEST(Kills, TwoWorkersInOneFolderMakeTheFramesOfOne) {
  std::map<std::string, std::string> meant;
  {
    const Folder folder;
    duration_of(orbit, folder, meant);
  }
  for (int i = 0; i < (long_tests() ? 10 : 1); ++i) {
    const Folder folder;
    std::vector<std::string> backwards = orbit;
    backwards.insert(backwards.end(), {"--frames", "4,3,2,1"});
    Finished other;
    std::thread worker([&] { other = run_sateen(i % 2 ? orbit : backwards, {folder.path}); });
    const Finished one = run_sateen(orbit, {folder.path});
    worker.join();
    EXPECT_EQ(one.code, 0) << one.err;
    EXPECT_EQ(other.code, 0) << other.err;
    EXPECT_TRUE(pictures(folder) == meant);
    EXPECT_EQ(leftovers(folder), 0);
  }
}

}  // namespace sateen_test
