#pragma once
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/error.h"
#include "look/field_values.h"
#include "look/fields.h"
#include "look/read.h"

namespace sateen {

/// Looks are searched in the source tree, wherever the test program stands.
inline void use_source_tree() {
  setenv("SATEEN_HOME", SATEEN_SOURCE_DIR, 1);
  unsetenv("SATEEN_PATH");
}

/// The whole text of the InputError that `call` throws, or a note that it threw none.
template <class Call>
std::string error_of(Call&& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "(no error)";
}

inline std::string error_in(const std::string& text) {
  use_source_tree();
  return error_of([&] { parse_look(text, "silk.json"); });
}

/// Every field of two looks, as text that tells floats apart bit by bit.
inline std::string all_values(const Look& look) {
  std::string text;
  for (const Field& field : fields()) text += field.path + " = " + field_text(look, field) + "\n";
  return text;
}

inline std::vector<std::filesystem::path> shipped_looks() {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(SATEEN_SOURCE_DIR "/looks"))
    if (entry.path().extension() == ".json") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

/// A folder of its own that goes away with the test.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "sateen-look-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no scratch folder");
    path_ = name;
  }
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  std::string file(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << text;
    return file(name);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace sateen
