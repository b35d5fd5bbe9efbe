#include "base/files.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <stdexcept>

#include "base/error.h"
#include "base/file_identity.h"
#include "base/memory.h"

namespace sateen {
namespace {

namespace fs = std::filesystem;

class Files : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::path(SATEEN_BINARY_DIR) / "test-files" / testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  void put(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  std::string get(const std::string& name) {
    std::ifstream in(folder_ / name);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::vector<std::string> names() {
    std::vector<std::string> all;
    for (const auto& entry : fs::directory_iterator(folder_)) all.push_back(entry.path().filename());
    std::sort(all.begin(), all.end());
    return all;
  }

  fs::path folder_;
};

template <class Error>
std::string message_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST_F(Files, WriteReplacesAFileAndLeavesNothingElse) {
  put("a.txt", "old");
  write_text_whole(folder_ / "a.txt", "new");
  EXPECT_EQ(get("a.txt"), "new");
  EXPECT_EQ(names(), std::vector<std::string>{"a.txt"});
}

TEST_F(Files, WriteMakesTheFoldersThatAreMissing) {
  write_text_whole(folder_ / "deep/er/a.txt", "text");
  EXPECT_EQ(get("deep/er/a.txt"), "text");
}

TEST_F(Files, TheTemporaryHasTheExtensionAndTheFolderOfTheFile) {
  fs::path seen;
  write_file_whole(folder_ / "picture.exr", [&](const fs::path& temporary) {
    seen = temporary;
    EXPECT_FALSE(fs::exists(folder_ / "picture.exr"));
    std::ofstream(temporary) << "x";
  });
  EXPECT_EQ(seen.extension(), ".exr");
  EXPECT_EQ(seen.parent_path(), folder_);
  EXPECT_NE(seen.filename(), "picture.exr");
}

TEST_F(Files, AFailingWriterLeavesTheOldFileAndNoTemporary) {
  put("a.png", "good");
  const std::string message = message_of<OperationError>([&] {
    write_file_whole(folder_ / "a.png", [](const fs::path& temporary) {
      std::ofstream(temporary) << "half";
      throw std::runtime_error("No space left on device");
    });
  });
  EXPECT_EQ(message, (folder_ / "a.png").string() + ": not written: No space left on device");
  EXPECT_EQ(get("a.png"), "good");
  EXPECT_EQ(names(), std::vector<std::string>{"a.png"});
}

TEST_F(Files, AFailingVerifierLeavesTheOldFileAndNoTemporary) {
  put("a.png", "good");
  const std::string message = message_of<OperationError>([&] {
    write_file_whole(
        folder_ / "a.png", [](const fs::path& temporary) { std::ofstream(temporary) << "bad"; },
        [](const fs::path& temporary) {
          EXPECT_TRUE(fs::exists(temporary));
          throw std::runtime_error("read back differently");
        });
  });
  EXPECT_NE(message.find("read back differently"), std::string::npos);
  EXPECT_EQ(get("a.png"), "good");
  EXPECT_EQ(names(), std::vector<std::string>{"a.png"});
}

TEST_F(Files, AnInputErrorOfTheWriterIsPassedOnAsItIs) {
  const std::string message = message_of<InputError>(
      [&] { write_file_whole(folder_ / "a.png", [](const fs::path&) { throw InputError("wrong channels"); }); });
  EXPECT_EQ(message, "error: wrong channels");
  EXPECT_TRUE(names().empty());
}

TEST_F(Files, AWriterThatRemovesItsTemporaryIsAnErrorAndTheOldFileStays) {
  put("a.txt", "good");
  EXPECT_THROW(write_file_whole(folder_ / "a.txt", [](const fs::path& temporary) { fs::remove(temporary); }),
               OperationError);
  EXPECT_EQ(get("a.txt"), "good");
}

TEST_F(Files, AFolderInTheWayIsNamed) {
  fs::create_directories(folder_ / "a.png");
  const std::string message = message_of<OperationError>([&] { write_text_whole(folder_ / "a.png", "x"); });
  EXPECT_EQ(message, (folder_ / "a.png").string() + ": not written: exists and is not a regular file");
}

TEST_F(Files, AFileWhereAFolderIsNeededIsNamed) {
  put("b", "file");
  const std::string message = message_of<OperationError>([&] { write_text_whole(folder_ / "b/a.png", "x"); });
  EXPECT_NE(message.find((folder_ / "b/a.png").string() + ": not written: "), std::string::npos) << message;
  EXPECT_EQ(get("b"), "file");
}

TEST_F(Files, AFolderThatMayNotBeWrittenIsNamedAndStaysAsItIs) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  put("a.png", "good");
  ::chmod(folder_.c_str(), 0555);
  const std::string message = message_of<OperationError>([&] { write_text_whole(folder_ / "a.png", "x"); });
  ::chmod(folder_.c_str(), 0755);
  EXPECT_EQ(message, (folder_ / "a.png").string() + ": not written: cannot create a file here: Permission denied");
  EXPECT_EQ(get("a.png"), "good");
}

TEST_F(Files, AFileSystemThatTakesNoFilesIsNamed) {
  // Not even root may create files here.
  if (!fs::exists("/proc/self")) GTEST_SKIP() << "no /proc";
  const std::string message = message_of<OperationError>([&] { write_text_whole("/proc/a.png", "x"); });
  EXPECT_EQ(message.find("/proc/a.png: not written: cannot create a file here: "), 0u) << message;
}

TEST_F(Files, AFullDiskIsReportedAndTheOldFileStays) {
  // /dev/full takes every open and refuses every byte.
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  put("a.txt", "good");
  const std::string message = message_of<OperationError>([&] {
    write_file_whole(folder_ / "a.txt", [](const fs::path&) {
      std::FILE* full = std::fopen("/dev/full", "w");
      std::fputs("text", full);
      if (std::fclose(full) != 0) throw std::runtime_error(std::strerror(errno));
    });
  });
  EXPECT_NE(message.find("No space left on device"), std::string::npos);
  EXPECT_EQ(get("a.txt"), "good");
}

TEST_F(Files, ReadGivesTheBytesAsTheyAre) {
  const std::string text("a\r\n\0b\xff", 6);
  put("a.txt", text);
  EXPECT_EQ(read_text_file(folder_ / "a.txt", 6), text);
  put("empty", "");
  EXPECT_EQ(read_text_file(folder_ / "empty", 0), "");
}

TEST_F(Files, ReadRefusesWhatIsMissingTooLargeOrNoFile) {
  put("a.txt", "1234567");
  const auto reading = [&](const fs::path& path) {
    try {
      read_text_file(path, 6);
    } catch (const InputError& error) {
      EXPECT_EQ(error.kind, InputError::Kind::unreadable);
      return error.diagnostics.at(0).message;
    }
    return std::string("nothing was thrown");
  };
  EXPECT_EQ(reading(folder_ / "a.txt"), (folder_ / "a.txt").string() + ": is 7 bytes, expected at most 6");
  EXPECT_EQ(reading(folder_ / "b.txt"), (folder_ / "b.txt").string() + ": no such file");
  EXPECT_EQ(reading(folder_), folder_.string() + ": is a folder, expected a file");
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(reading(folder_ / "pipe"), (folder_ / "pipe").string() + ": is not a regular file");
}

pid_t dead_process() {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  int status = 0;
  ::waitpid(child, &status, 0);
  return child;
}

TEST_F(Files, WhatDeadWritersLeftOfTheSameFileIsSweptAndNothingElse) {
  const std::string dead = std::to_string(dead_process()), alive = std::to_string(::getppid());
  const std::vector<std::string> stay{".a." + alive + "-0.png", ".b." + dead + "-0.png", ".a." + dead + "-0.exr",
                                      ".a." + dead + "-0x.png", ".a." + dead + ".png",   ".a.-" + dead + "-0.png",
                                      "a." + dead + "-0.png",   ".a." + dead + "-7.png", ".a.0-0.png"};
  for (const std::string& name : stay) put(name, "");
  put(".a." + dead + "-0.png", "");
  put(".a." + dead + "-12.png", "");
  // Another machine's or container's: its process is not seen here, but its lock is.
  const int locked = ::open((folder_ / (".a." + dead + "-7.png")).c_str(), O_RDWR);
  ASSERT_EQ(::flock(locked, LOCK_EX), 0);
  write_text_whole(folder_ / "a.png", "text");
  ::close(locked);
  std::vector<std::string> expected = stay;
  expected.push_back("a.png");
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(names(), expected);
}

TEST_F(Files, WritingGoesThroughLinksAndKeepsModes) {
  fs::create_directory(folder_ / "far");
  fs::create_symlink("far/b", folder_ / "one");
  fs::create_symlink("one", folder_ / "two");
  write_text_whole(folder_ / "two", "first");
  EXPECT_EQ(get("far/b"), "first");
  ::chmod((folder_ / "far/b").c_str(), 0604);
  write_text_whole(folder_ / "two", "second");
  EXPECT_EQ(get("far/b"), "second");
  EXPECT_TRUE(fs::is_symlink(folder_ / "one") && fs::is_symlink(folder_ / "two"));
  struct stat status {};
  ASSERT_EQ(::stat((folder_ / "far/b").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0604u);
  fs::create_symlink("ring", folder_ / "ring");
  EXPECT_THROW(write_text_whole(folder_ / "ring", "x"), OperationError);
}

TEST_F(Files, ANameAsLongAsNamesMayBeCanBeWritten) {
  const std::string name = std::string(251, 'n') + ".txt";
  write_text_whole(folder_ / name, "text");
  EXPECT_EQ(names(), std::vector<std::string>{name});
}

TEST_F(Files, AreTheSameByWhateverNameTheyAreCalled) {
  put("a", "");
  put("b", "");
  fs::create_directory(folder_ / "sub");
  fs::create_symlink("../a", folder_ / "sub/link");
  fs::create_hard_link(folder_ / "a", folder_ / "hard");
  fs::create_symlink("new", folder_ / "dangling");
  EXPECT_TRUE(same_file(folder_ / "a", folder_ / "sub/link"));
  EXPECT_TRUE(same_file(folder_ / "a", folder_ / "hard"));
  EXPECT_TRUE(same_file(folder_ / "a", folder_ / "sub/.././a"));
  EXPECT_TRUE(same_file(folder_ / "new", folder_ / "dangling"));
  EXPECT_TRUE(same_file(folder_ / "new", folder_ / "sub/../new"));
  EXPECT_TRUE(same_file(folder_ / "none/new", folder_ / "none/../none/./new"));
  EXPECT_FALSE(same_file(folder_ / "a", folder_ / "b"));
  EXPECT_FALSE(same_file(folder_ / "a", folder_ / "new"));
  EXPECT_FALSE(same_file(folder_ / "new", folder_ / "newer"));
}

TEST_F(Files, ThatWereReadAreKnown) {
  put("read.txt", "text");
  put("not.txt", "text");
  read_text_file(folder_ / "read.txt", 100);
  const std::vector<fs::path> all = files_read();
  EXPECT_EQ(std::count(all.begin(), all.end(), folder_ / "read.txt"), 1);
  EXPECT_EQ(std::count(all.begin(), all.end(), folder_ / "not.txt"), 0);
}

TEST(Memory, RoomIsWhatALimitLeavesOver) {
  const MemoryRoom before = memory_room();
  EXPECT_GT(before.bytes, 0);
  EXPECT_LE(before.bytes, memory_limit());
  rlimit old{};
  getrlimit(RLIMIT_DATA, &old);
  rlimit limit = old;
  const std::int64_t more = 50'000'000;
  limit.rlim_cur = rlim_t(memory_use().data + more);
  setrlimit(RLIMIT_DATA, &limit);
  const MemoryRoom room = memory_room();
  setrlimit(RLIMIT_DATA, &old);
  EXPECT_NEAR(double(room.bytes), double(more), 2e6);
  EXPECT_NE(room.limit.find("ulimit -d"), std::string::npos) << room.limit;
}

TEST(DataFolder, IsWhatTheEnvironmentSays) {
  const char* const before = std::getenv("SATEEN_HOME");
  const std::string kept = before ? before : "";
  ::setenv("SATEEN_HOME", "/some/where", 1);
  EXPECT_EQ(data_folder(), "/some/where");
  before ? ::setenv("SATEEN_HOME", kept.c_str(), 1) : ::unsetenv("SATEEN_HOME");
}

TEST(HashOfBytes, IsFnv1a) {
  // Test values of the FNV reference.
  EXPECT_EQ(Hash().hex(), "cbf29ce484222325");
  EXPECT_EQ(Hash().add("a").hex(), "af63dc4c8601ec8c");
  EXPECT_EQ(Hash().add("foobar").hex(), "85944171f73967e8");
}

TEST(HashOfBytes, ContinuesWhereItStopped) {
  EXPECT_EQ(Hash().add("foo").add("bar").value, Hash().add("foobar").value);
  const unsigned char zero = 0;
  EXPECT_NE(Hash().add_bytes(&zero, 1).value, Hash().value);
  EXPECT_EQ(Hash{0x1}.hex(), "0000000000000001");
}

}  // namespace
}  // namespace sateen
