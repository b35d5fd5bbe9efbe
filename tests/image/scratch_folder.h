#pragma once
#include <cstdlib>
#include <filesystem>
#include <string>

namespace sateen_test {

/// A folder of its own for one test, gone with it.
struct ScratchFolder {
  std::filesystem::path path;

  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "sateen-test-XXXXXX").string();
    path = mkdtemp(name.data());
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
};

}  // namespace sateen_test
