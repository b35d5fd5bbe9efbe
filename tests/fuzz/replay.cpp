// Replays the seeds of every fuzz target once, in any build: corpus/<name>/ through <name>_fuzzer.cpp.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "fuzz_targets.h"

namespace {
namespace fs = std::filesystem;
using namespace sateen_test;

const fs::path corpus = SATEEN_SOURCE_DIR "/tests/fuzz/corpus";

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  if (fs::exists(folder))
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
      names.insert(entry.path().filename().string());
  return names;
}

TEST(FuzzCorpus, EveryTargetHasSeedsAndEveryFolderOfSeedsHasATarget) {
  std::set<std::string> targets;
  for (const FuzzTarget& target : fuzz_targets) {
    targets.insert(target.name);
    EXPECT_FALSE(names_in(corpus / target.name).empty()) << target.name << " has no seeds";
  }
  EXPECT_EQ(names_in(corpus), targets);
}

TEST(FuzzCorpus, IsTakenByItsTargetsWithoutAFault) {
  for (const FuzzTarget& target : fuzz_targets) {
    std::string program = target.name;
    char* words[] = {program.data(), nullptr};
    char** argv = words;
    int argc = 1;
    if (target.initialize) {
      ASSERT_EQ(target.initialize(&argc, &argv), 0);
    }
    for (const std::string& name : names_in(corpus / target.name)) {
      const fs::path path = corpus / target.name / name;
      std::ifstream file(path, std::ios::binary);
      const std::string bytes{std::istreambuf_iterator<char>(file), {}};
      ASSERT_TRUE(file) << path;
      SCOPED_TRACE(path.string());
      // A target that finds a fault aborts: the last name printed is its file.
      fprintf(stderr, "%s/%s, %zu bytes\n", target.name, name.c_str(), bytes.size());
      EXPECT_EQ(target.run(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()), 0);
    }
  }
}

}  // namespace
