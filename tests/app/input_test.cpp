#include <gtest/gtest.h>

#include "program.h"

namespace sateen_test {

namespace {
const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

Finished render_mesh(const Folder& folder, const std::string& text) {
  write_text(folder / "cloth.obj", text);
  return run_sateen(tiny({"--mesh", folder / "cloth.obj", "-o", folder / "a.png"}));
}

/// A Radiance map of so many pixels, all of these four bytes.
void write_map(const std::string& path, int width, int height, const std::string& rgbe) {
  std::string text =
      "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " + std::to_string(width) + "\n";
  for (int i = 0; i < width * height; ++i) text += rgbe;
  write_text(path, text);
}
}  // namespace

TEST(WrongMesh, AMissingFileIsAnsweredWithTheNearestOfItsFolder) {
  const Folder folder;
  write_text(folder / "dress.obj", triangle);
  const Finished run = run_sateen({"render", "--mesh", folder / "drees.obj"});
  EXPECT_EQ(run.code, 3);
  EXPECT_EQ(run.err, "error: " + folder / "drees.obj" + ": no such file\n  help: did you mean " +
                         folder / "dress.obj" + "?\n");
}

TEST(WrongMesh, AFileFarFromAnyNameIsAnsweredWithTheBuiltInShapes) {
  const Folder folder;
  const Finished run = run_sateen({"render", "--mesh", folder / "coat.obj"});
  EXPECT_EQ(run.code, 3);
  EXPECT_NE(run.err.find("help: known: swatch, sphere, drape, skirt (or the path of an OBJ)"), std::string::npos)
      << run.err;
}

TEST(WrongMesh, AFileWithoutFacesSaysWhatAMeshIs) {
  const Finished run = render_mesh(Folder(), "hello\n");
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("holds no face, expected at least one\n  help: meshes are OBJ text"), std::string::npos)
      << run.err;
}

TEST(WrongMesh, FacesWithoutAreaAreRefusedAndNotRenderedAsAnEmptyPicture) {
  for (const char* text : {"v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"}) {
    const Folder folder;
    const Finished run = render_mesh(folder, text);
    EXPECT_EQ(run.code, 2);
    const size_t verdict = run.err.find("its only face has no area: nothing of it can be seen\n  help: ");
    ASSERT_NE(verdict, std::string::npos) << run.err;
    // The check before says the same.
    const Finished check = run_sateen({"check", folder / "cloth.obj"});
    EXPECT_EQ(check.code, 2);
    EXPECT_NE(check.out.find("cloth.obj: not usable\n"), std::string::npos) << check.out;
    EXPECT_NE(check.err.find(run.err.substr(verdict)), std::string::npos) << check.err;
  }
}

TEST(WrongMesh, ADistanceThatFloatsCannotHoldIsWarnedOf) {
  const Finished far = render_mesh(Folder(), "v 1e6 0 0\nv 1000001 0 0\nv 1e6 1 0\nf 1 2 3\n");
  EXPECT_EQ(far.code, 0);
  EXPECT_NE(far.err.find("times its own size from the origin"), std::string::npos) << far.err;
  EXPECT_EQ(render_mesh(Folder(), triangle).err.find("from the origin"), std::string::npos);
}

TEST(WrongMap, WhatIsDoubtfulInItIsSaidBeforeThePicture) {
  const Folder folder;
  const auto render = [&] { return run_sateen(tiny({"--env", folder / "map.hdr", "-o", folder / "a.png"})); };
  write_map(folder / "map.hdr", 4, 2, std::string(4, '\0'));
  const Finished black = render();
  EXPECT_EQ(black.code, 0);
  EXPECT_NE(black.err.find("map.hdr: it is black: nothing will be lit"), std::string::npos) << black.err;
  write_map(folder / "map.hdr", 8, 8, "\x80\x80\x80\x81");
  EXPECT_NE(render().err.find("map.hdr: it is 8 x 8, and a lat-long map is twice as wide as high"),
            std::string::npos);
  write_map(folder / "map.hdr", 8, 4, "\x80\x80\x80\x81");
  EXPECT_EQ(render().err.find("map.hdr: it is"), std::string::npos);
}

TEST(WrongMap, AFolderIsNamedAsOne) {
  const Folder folder;
  const Finished run = run_sateen({"render", "--env", folder.path.string()});
  EXPECT_EQ(run.code, 3);
  EXPECT_NE(run.err.find("is a folder, expected an HDR map"), std::string::npos) << run.err;
}

TEST(WrongOutput, WhatCannotBeWrittenIsFoundBeforeRendering) {
  const Folder folder;
  for (const char* flag : {"--stats", "--checkpoint"}) {
    const Finished run = run_sateen(tiny({"-o", folder / "a.png", flag, folder.path.string()}));
    EXPECT_EQ(run.code, 1) << flag;
    EXPECT_NE(run.err.find("nothing was rendered"), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "a.png")) << flag;
  }
}

TEST(WrongOutput, APictureThatDoesNotFitIntoMemoryIsRefused) {
  const Folder folder;
  const Finished run =
      run_sateen({"render", "-r", "32768", "32768", "-s", "1", "-o", folder / "a.exr"});  // 400 GB of sums
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("error: --res 32768 32768 takes "), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("help: --aov none takes "), std::string::npos) << run.err;
  EXPECT_NE(run.err.find(" fits\n"), std::string::npos) << run.err;
}

TEST(WrongFlags, ContradictionsSayWhatToLeaveOut) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"render", "--bounces", "2", "--effects", "-interreflection"},
        {"render", "--effects", "+gaps,-gaps"},
        {"render", "-o", "a.png", "-o", "a.png"}}) {
    const Finished run = run_sateen(words);
    EXPECT_EQ(run.code, 2);
    EXPECT_NE(run.err.find("leave one of them out"), std::string::npos) << run.err;
  }
}

TEST(WrongFlags, AnEffectWithoutItsSignIsAnsweredWithIt) {
  EXPECT_NE(run_sateen({"render", "--effects", "interreflexion"}).err.find("did you mean +interreflection?"),
            std::string::npos);
}

}  // namespace sateen_test
