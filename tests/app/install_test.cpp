#include <gtest/gtest.h>

#include <cstdlib>

#include "image/file.h"
#include "program.h"

namespace sateen_test {

namespace {
int shell(const std::string& line) {
  return std::system((line + " >/dev/null 2>&1").c_str());
}
}  // namespace

TEST(Install, AnInstalledProgramWorksFromAnotherFolderWithItsOwnLooksAndMaps) {
  const Folder folder;
  const std::string prefix = folder / "prefix";
  ASSERT_EQ(shell(std::string(SATEEN_CMAKE) + " --install " + SATEEN_BINARY_DIR + " --prefix " + prefix), 0);
  // Moved, so that nothing can be found at the place where it was installed.
  std::filesystem::rename(prefix, folder / "moved");
  std::filesystem::create_directory(folder.path / "work");
  Start start(folder / "work");
  start.program = folder / "moved/bin/sateen";
  start.environment = {"SATEEN_HOME="};
  auto words = tiny({"--look", "emerald_satin", "--env", "overcast", "-o", "a.png", "-o", "a.exr", "--aov", "none"});
  const Finished run = run_sateen(words, start);
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(sateen::read_image(folder / "work/a.png").width, 64);
  const Finished maps = run_sateen({"env", "list"}, start);
  EXPECT_NE(maps.out.find("moved/share/sateen/envmaps/overcast.exr"), std::string::npos) << maps.out;
  for (const char* file : {"bin/sateen", "include/sateen/render/render.h", "share/sateen/looks/silk_shot.json",
                           "lib/sateen/sateen_oiio.so"})
    EXPECT_TRUE(std::filesystem::exists(folder.path / "moved" / file)) << file;
}

TEST(Install, TheLibraryIsFoundAndLinkedByAnotherProject) {
  if (!std::getenv("SATEEN_LONG_TESTS")) GTEST_SKIP() << "long: set SATEEN_LONG_TESTS";
  const Folder folder;
  ASSERT_EQ(shell(std::string(SATEEN_CMAKE) + " --install " + SATEEN_BINARY_DIR + " --prefix " + (folder / "prefix")),
            0);
  write_text(folder / "CMakeLists.txt",
             "cmake_minimum_required(VERSION 3.25)\nproject(user CXX)\nfind_package(sateen 0.1 REQUIRED)\n"
             "add_executable(user user.cpp)\ntarget_link_libraries(user sateen::sateen)\n");
  write_text(
      folder / "user.cpp",
      "#include \"mesh/shapes.h\"\n#include \"mesh/subdivide.h\"\n"
      "int main() { return sateen::subdivide(sateen::built_in_shape(\"swatch\"), 1).quads.empty() ? 1 : 0; }\n");
  const std::string configure = std::string(SATEEN_CMAKE) + " -S " + folder.path.string() + " -B " +
                                (folder / "build") + " -DCMAKE_PREFIX_PATH=" + (folder / "prefix") +
                                " -DCMAKE_CXX_COMPILER=" + SATEEN_COMPILER;
  ASSERT_EQ(shell(configure), 0);
  ASSERT_EQ(shell(std::string(SATEEN_CMAKE) + " --build " + (folder / "build")), 0);
  EXPECT_EQ(shell(folder / "build/user"), 0);
}

}  // namespace sateen_test
