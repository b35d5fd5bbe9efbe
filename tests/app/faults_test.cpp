#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>
#include <regex>
#include <sstream>

#include "program.h"

namespace sateen_test {

// Faults of the operating system, put by strace into the one call that is meant, and seen there in its log.
namespace {

namespace fs = std::filesystem;

std::optional<std::string> find_strace() {
  for (const char* path : {"/usr/bin/strace", "/usr/local/bin/strace", "/bin/strace"})
    if (fs::exists(path)) return path;
  return std::nullopt;
}

/// Calls that write a file, in the order in which it meets them.
const std::string calls = "openat,write,pwrite64,fsync,close,rename";

struct Traced {
  Finished run;
  std::vector<std::string> log;
};

Traced trace(const std::string& strace, const Folder& folder, std::vector<std::string> words,
             const std::string& inject = {}) {
  std::vector<std::string> line{"-f", "-y", "-s", "0", "-o", folder / "trace.log", "-e", "trace=" + calls};
  if (!inject.empty()) line.insert(line.end(), {"-e", "inject=" + inject});
  line.push_back(SATEEN_PROGRAM);
  line.insert(line.end(), words.begin(), words.end());
  Start start;
  start.folder = folder.path;
  start.program = strace;
  Traced traced{run_sateen(line, start), {}};
  std::istringstream log(read_text(folder / "trace.log"));
  for (std::string text; std::getline(log, text);) traced.log.push_back(text);
  fs::remove(folder / "trace.log");
  return traced;
}

/// One call of a log: its name, and the how manieth of that name in its thread it is.
struct Call {
  std::string name;
  int number = 0;
};

/// The last call of one of `names` on a file whose name `on` finds; of openat the one that makes it.
std::optional<Call> last_call(const std::vector<std::string>& log, const std::vector<std::string>& names,
                              const std::regex& on) {
  std::map<std::pair<std::string, std::string>, int> counts;
  std::optional<Call> found;
  static const std::regex shape(R"(^(\d+)\s+(\w+)\((.*)$)");
  for (const std::string& line : log) {
    std::smatch m;
    if (!std::regex_match(line, m, shape)) continue;
    const int number = ++counts[{m[1], m[2]}];
    if (std::find(names.begin(), names.end(), m[2]) == names.end() || !std::regex_search(line, on)) continue;
    if (m[2] == "openat" && line.find("O_CREAT") == std::string::npos) continue;
    found = Call{m[2], number};
  }
  return found;
}

const std::vector<std::string> written{"a.exr", "a.png", "a.checkpoint", "a.json"};

std::vector<std::string> job(const char* samples) {
  return tiny({"-t",        "1",     "-s",           samples, "--effects",    "none",
               "--bounces", "0",     "--candidates", "2",     "--aov",        "N",
               "-o",        "a.exr", "-o",           "a.png", "--checkpoint", "a.checkpoint",
               "--stats",   "a.json"});
}

std::regex temporary_of(const std::string& file) {
  const size_t point = file.find('.');
  return std::regex("\\." + file.substr(0, point) + "\\.\\d+-\\d+\\" + file.substr(point) + "\\b");
}

using Files = std::map<std::string, std::string>;

Files files_of(const Folder& folder) {
  Files all;
  for (const std::string& name : written) all[name] = read_text(folder / name);
  return all;
}

/// What is there before, and what two runs without a fault make of it: their calls and their files.
struct Clean {
  Files before, meant;
  std::vector<std::string> log;
};

const Clean& clean_run(const std::string& strace) {
  static const Clean clean = [&] {
    Clean made;
    const Folder folder;
    EXPECT_EQ(trace(strace, folder, job("4")).run.code, 0);
    made.before = files_of(folder);
    Traced traced = trace(strace, folder, job("8"));
    EXPECT_EQ(traced.run.code, 0) << traced.run.err;
    made.meant = files_of(folder);
    made.log = std::move(traced.log);
    return made;
  }();
  return clean;
}

/// What a fault of that kind in the call of that name on one of the files does to all four.
void expect_nothing_lost(const std::string& strace, const std::string& file, const std::vector<std::string>& names,
                         const std::string& fault) {
  SCOPED_TRACE(file + " " + names[0] + " " + fault);
  const Folder folder;
  const auto& [before, meant, log] = clean_run(strace);
  for (const auto& [name, bytes] : before) write_text(folder / name, bytes);
  const std::regex on = temporary_of(file);
  std::optional<Call> call = last_call(log, names, on);
  ASSERT_TRUE(call) << "no such call on this file";
  for (int attempt = 0; attempt < 3; ++attempt) {
    const Traced faulty =
        trace(strace, folder, job("8"), call->name + ":" + fault + ":when=" + std::to_string(call->number));
    bool confirmed = false;
    for (const std::string& line : faulty.log)
      confirmed |= line.find("(INJECTED)") != std::string::npos && std::regex_search(line, on);
    if (!confirmed) {
      // Something else called once more or once less; the log says where the call is now.
      for (const std::string& name : written) write_text(folder / name, before.at(name));
      call = last_call(faulty.log, names, on);
      ASSERT_TRUE(call);
      continue;
    }
    const std::string now = read_text(folder / file);
    const bool timed = file == "a.checkpoint" || file == "a.json";  // times in them differ from run to run
    const bool is_new = timed ? now != before.at(file) : now == meant.at(file);
    if (faulty.run.code == 0) {
      EXPECT_TRUE(is_new) << "exit 0 and not the file that was meant";
    } else {
      EXPECT_EQ(faulty.run.code, 1) << faulty.run.err;
      EXPECT_TRUE(now == before.at(file)) << "the old file is lost";
      EXPECT_NE(faulty.run.err.find(file + ": not written"), std::string::npos) << faulty.run.err;
    }
    for (const char* other : {"a.exr", "a.png"}) {
      if (other == file) continue;
      EXPECT_TRUE(read_text(folder / other) == meant.at(other)) << other << " was not written";
    }
    if (file == "a.checkpoint") {
      // Old or new, it can be gone on with.
      const Finished next = run_sateen(tiny({"-s", "16", "--effects", "none", "--bounces", "0", "--candidates", "2",
                                             "--aov", "N", "-o", "b.png", "--resume", "a.checkpoint"}),
                                       {folder.path});
      EXPECT_EQ(next.code, 0) << next.err;
    } else {
      EXPECT_TRUE(read_text(folder / "a.checkpoint") != before.at("a.checkpoint"));
    }
    for (const fs::directory_entry& entry : fs::directory_iterator(folder.path))
      EXPECT_NE(entry.path().filename().string()[0], '.') << entry.path() << " was left behind";
    return;
  }
  FAIL() << "the fault did not meet the call that was meant";
}

/// Why no fault can be injected here; empty where one can.
std::string hindrance() {
  const auto strace = find_strace();
  if (!strace) return "there is no strace here";
  const Folder folder;
  const Traced traced = trace(*strace, folder, {"--version"});
  return traced.run.code == 0 && !traced.log.empty() ? "" : "strace cannot trace here: " + traced.run.err;
}

const std::vector<std::string> writes{"write", "pwrite64"};

}  // namespace

TEST(Faults, OfTheSystemNeverEndWithZeroAndABadFileAndKeepTheOldOne) {
  if (const std::string why = hindrance(); !why.empty()) GTEST_SKIP() << why;
  const std::string strace = *find_strace();
  expect_nothing_lost(strace, "a.exr", writes, "error=ENOSPC");
  expect_nothing_lost(strace, "a.png", writes, "error=EIO");
  expect_nothing_lost(strace, "a.checkpoint", {"fsync"}, "error=EDQUOT");
  expect_nothing_lost(strace, "a.json", {"rename"}, "error=EROFS");
  expect_nothing_lost(strace, "a.checkpoint", writes, "retval=1");
  expect_nothing_lost(strace, "a.exr", {"close"}, "error=EINTR");
}

class FaultsOn : public testing::TestWithParam<std::string> {};

TEST_P(FaultsOn, ThisFileAreOfEveryKindInEveryCall) {
  if (!std::getenv("SATEEN_LONG_TESTS")) GTEST_SKIP() << "SATEEN_LONG_TESTS is not set: 31 runs under strace";
  if (const std::string why = hindrance(); !why.empty()) GTEST_SKIP() << why;
  const std::string strace = *find_strace(), file = GetParam();
  for (const auto& names : {std::vector<std::string>{"openat"}, writes, {"fsync"}, {"close"}, {"rename"}})
    for (const char* error : {"ENOSPC", "EIO", "EDQUOT", "EROFS", "EACCES", "EINTR"})
      expect_nothing_lost(strace, file, names, std::string("error=") + error);
  expect_nothing_lost(strace, file, writes, "retval=1");  // says that less was written, and lies about that
}

INSTANTIATE_TEST_SUITE_P(All, FaultsOn, testing::ValuesIn(written),
                         [](const auto& each) { return each.param.substr(2); });

}  // namespace sateen_test
