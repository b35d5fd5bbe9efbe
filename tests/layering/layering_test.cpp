#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "layering/rules.h"

namespace sateen_test {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<SourceFile> project_files() {
  const fs::path root = SATEEN_SOURCE_DIR;
  std::vector<SourceFile> files;
  for (const char* folder : {"lib", "app"})
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension();
      if (!entry.is_regular_file() || (extension != ".h" && extension != ".cpp")) continue;
      files.push_back({fs::relative(entry.path(), root).generic_string(), text_of(entry.path())});
    }
  std::sort(files.begin(), files.end(), [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  return files;
}

TEST(Layering, RoomsIncludeDownwardsAndOutsideLibrariesStayInTheirPlaces) {
  const std::vector<std::string> rooms = rooms_in_order(text_of(SATEEN_SOURCE_DIR "/lib/CMakeLists.txt"));
  ASSERT_EQ(rooms.front(), "base");
  ASSERT_EQ(rooms.back(), "study");
  ASSERT_EQ(rooms.size(), 13u);
  const std::vector<SourceFile> files = project_files();
  ASSERT_GT(files.size(), 100u);
  for (const std::string& breach : breaches(files, rooms)) ADD_FAILURE() << breach;
}

TEST(Layering, EveryPlaceOfALibraryIsThere) {
  for (const OutsideLibrary& library : outside_libraries())
    for (const std::string& place : library.places)
      EXPECT_TRUE(fs::exists(fs::path(SATEEN_SOURCE_DIR) / place)) << library.name << ": " << place;
}

// The rules themselves, on made files.

const std::vector<std::string> house{"base", "math", "scene", "render"};

std::vector<std::string> breaches_of(std::vector<SourceFile> files) {
  for (const char* path : {"lib/base/error.h", "lib/math/frame.h", "lib/scene/scene.h", "lib/render/render.h"})
    files.push_back({path, ""});
  return breaches(files, house);
}

TEST(LayeringRules, AllowOwnRoomAndRoomsBelow) {
  EXPECT_TRUE(
      breaches_of({{"lib/scene/a.cpp",
                    "#include \"scene/scene.h\"\n#include <vector>\n#include <sys/stat.h>\n"
                    "#include \"base/error.h\"\n#include <fmt/format.h>\n"},
                   {"app/main.cpp", "#include \"render/render.h\"\n#include \"run.h\"\n#include <CLI/App.hpp>\n"},
                   {"app/run.h", ""}})
          .empty());
}

TEST(LayeringRules, RefuseARoomAboveWithItsLine) {
  const auto found = breaches_of({{"lib/math/a.h", "#pragma once\n  #  include \"scene/scene.h\"\n"}});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0],
            "lib/math/a.h:2: includes \"scene/scene.h\", but scene is above math: a file includes its own room "
            "and rooms below it (base, math, scene, render)");
}

TEST(LayeringRules, RefuseTheProgramAndFilesThatAreNotThere) {
  EXPECT_EQ(breaches_of({{"lib/math/a.h", "#include \"app/run.h\"\n"}, {"app/run.h", ""}}).size(), 1u);
  EXPECT_EQ(breaches_of({{"lib/math/a.h", "#include \"frame.h\"\n"}}).size(), 1u);
  EXPECT_EQ(breaches_of({{"app/main.cpp", "#include \"frame.h\"\n"}}).size(), 1u);
}

TEST(LayeringRules, RefuseALibraryOutOfItsPlace) {
  const auto found = breaches_of({{"lib/scene/camera.cpp", "#include <embree3/rtcore.h>\n"}});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0],
            "lib/scene/camera.cpp:1: includes <embree3/rtcore.h>, but Embree stays in lib/scene/ray_tracer.cpp: "
            "call what that place offers instead");
  EXPECT_TRUE(breaches_of({{"lib/scene/ray_tracer.cpp", "#include <embree3/rtcore.h>\n"}}).empty());
  for (const char* header : {"opensubdiv/far/error.h", "OpenColorIO/OpenColorIO.h", "OpenImageIO/imageio.h",
                             "OpenEXR/ImfHeader.h", "ImfHeader.h", "nlohmann/json.hpp", "CLI/App.hpp", "tbb/tbb.h",
                             "oneapi/tbb/parallel_for.h", "Imath/ImathVec.h", "Imath/half.h"})
    EXPECT_EQ(breaches_of({{"lib/render/a.cpp", std::string("#include <") + header + ">\n"}}).size(), 1u) << header;
}

TEST(LayeringRules, RefuseALibraryWithoutAPlace) {
  const auto found = breaches_of({{"lib/base/a.cpp", "#include <boost/regex.hpp>\n"}});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].find("a library without a place"), std::string::npos);
}

TEST(LayeringRules, RefuseAFolderThatIsNoRoomAndAFileThatIsTooLong) {
  EXPECT_EQ(breaches_of({{"lib/utils/a.h", ""}}).size(), 1u);
  EXPECT_EQ(breaches_of({{"lib/math/a.h", std::string(401, '\n')}}).size(), 1u);
  EXPECT_TRUE(breaches_of({{"lib/math/a.h", std::string(400, '\n')}}).empty());
}

TEST(LayeringRules, NameACircle) {
  const auto found =
      breaches_of({{"lib/math/a.h", "#include \"base/error.h\"\n"}, {"lib/base/a.h", "#include \"math/frame.h\"\n"}});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[1], "rooms include one another in a circle: base -> math -> base");
}

TEST(LayeringRules, IncludesInCommentsAndStringsOfOtherLinesDoNotCount) {
  EXPECT_TRUE(
      breaches_of({{"lib/math/a.h", "// #include \"scene/scene.h\"\nconst char* a = \"#include <embree3/a.h>\";\n"}})
          .empty());
}

}  // namespace
}  // namespace sateen_test
