#pragma once
#include <string>
#include <vector>

// The rules of the house, checked on text: rooms include downwards only, an outside library has one place, no file
// grows past 400 lines.

namespace sateen_test {

struct SourceFile {
  std::string path;  ///< from the project's root: "lib/scene/camera.h", "app/main.cpp"
  std::string text;
};

/// An outside library: what its headers' names begin with, and the only files that may include them. A place that
/// ends in '/' is a folder.
struct OutsideLibrary {
  std::string name;
  std::vector<std::string> prefixes;
  std::vector<std::string> places;
};

/// Rooms from the ground floor up, in the order of the sateen_room() calls in lib/CMakeLists.txt.
std::vector<std::string> rooms_in_order(const std::string& cmake_text);

/// The libraries of the project and their places.
const std::vector<OutsideLibrary>& outside_libraries();

inline constexpr int most_lines = 400;

/// One sentence for each breach, with file and line, what was found and what is expected.
std::vector<std::string> breaches(const std::vector<SourceFile>& files, const std::vector<std::string>& rooms);

}  // namespace sateen_test
