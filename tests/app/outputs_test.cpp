#include <gtest/gtest.h>
#include <sys/stat.h>

#include <csignal>
#include <map>

#include "image/file.h"
#include "program.h"

namespace sateen_test {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> plain(std::vector<std::string> more) {
  std::vector<std::string> words{"--effects", "none", "--bounces", "0", "--candidates", "2"};
  words.insert(words.end(), more.begin(), more.end());
  return tiny(words);
}

std::string stopped_by(const fs::path& path) {
  const auto attributes = sateen::read_attributes(path);
  const auto found = attributes.find("sateen:stopped_by");
  return found == attributes.end() ? "" : std::get<std::string>(found->second);
}

int files_in(const Folder& folder) {
  return int(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator()));
}

}  // namespace

TEST(Outputs, AFileThatGrowsTooLargeIsAFailureThatCostsNoOther) {
  const Folder folder;
  const std::vector<std::string> words = plain({"-o", "large.exr", "-o", "small.png", "--stats", "s.json"});
  ASSERT_EQ(run_sateen(words, {folder.path}).code, 0);
  const std::string before = read_text(folder / "large.exr");
  fs::remove(folder / "small.png");
  Finished run;
  {
    const ResourceLimit limit(RLIMIT_FSIZE, before.size() / 2);
    ASSERT_LT(8 * 1024u, before.size() / 2);
    run = run_sateen(words, {folder.path});
  }
  EXPECT_EQ(run.code, 1) << "SIGXFSZ would have been 153";
  EXPECT_NE(run.err.find("error: large.exr: not written: File too large"), std::string::npos) << run.err;
  EXPECT_NE(run.out.find("wrote small.png"), std::string::npos) << run.out;
  EXPECT_NE(read_text(folder / "s.json").find("\"exit_code\": 1"), std::string::npos);
  EXPECT_NE(read_text(folder / "s.json").find("large.exr: not written"), std::string::npos);
  EXPECT_TRUE(read_text(folder / "large.exr") == before);
  EXPECT_EQ(files_in(folder), 3);
}

TEST(Outputs, EveryKindOfFileThatGrowsTooLargeIsToldInTheSystemsWords) {
  const Folder folder;
  std::vector<std::string> words = plain({"-r", "200", "150"});
  const std::vector<std::string> kinds{"png", "jpg", "tif", "exr"};
  for (const std::string& kind : kinds) words.insert(words.end(), {"-o", "a." + kind});
  Finished run;
  {
    const ResourceLimit limit(RLIMIT_FSIZE, 2'000);
    run = run_sateen(words, {folder.path});
  }
  EXPECT_EQ(run.code, 1) << run.err;
  for (const std::string& kind : kinds)
    EXPECT_NE(run.err.find("error: a." + kind + ": not written: File too large\n"), std::string::npos) << run.err;
  EXPECT_EQ(files_in(folder), 0);
}

TEST(Outputs, ASignalsCodeStaysWhereAnOutputFails) {
  const Folder folder;
  Start start(folder.path, SIGINT);
  const ResourceLimit limit(RLIMIT_FSIZE, 4'000);  // below the header alone: the signal may come before any light
  const Finished run = run_sateen(
      {"render",       "-m",   "swatch",       "--level", "0",         "-r", "60",         "34",   "-s", "100000",
       "--effects",    "none", "--candidates", "2",       "--bounces", "0",  "--progress", "json", "-o", "a.exr",
       "--checkpoint", "c"},
      start);
  EXPECT_EQ(run.code, 130) << run.err;
  EXPECT_NE(run.err.find("a.exr: not written"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("c: not written"), std::string::npos) << run.err;
  EXPECT_EQ(run.out.find("--resume"), std::string::npos) << run.out;
}

TEST(Outputs, AHangupEndsLikeATerminationUnlessItIsIgnored) {
  const Folder folder;
  Start start(folder.path, SIGHUP);
  std::vector<std::string> words{"render",     "-m",        "swatch", "--level",      "0", "-r",        "60",
                                 "34",         "--effects", "none",   "--candidates", "2", "--bounces", "0",
                                 "--progress", "json",      "--aov",  "none"};
  std::vector<std::string> endless = words, short_one = words;
  endless.insert(endless.end(), {"-s", "1000000", "-o", "a.exr"});
  const Finished run = run_sateen(endless, start);
  EXPECT_EQ(run.code, 129) << run.err;
  EXPECT_EQ(stopped_by(folder / "a.exr"), "interrupted");
  EXPECT_TRUE(fs::exists(folder / "a.exr.checkpoint"));

  const auto before = std::signal(SIGHUP, SIG_IGN);  // as nohup does; a program inherits it
  short_one.insert(short_one.end(), {"-s", "64", "-o", "b.exr"});
  const Finished under_nohup = run_sateen(short_one, start);
  std::signal(SIGHUP, before);
  EXPECT_EQ(under_nohup.code, 0) << under_nohup.err;
  EXPECT_EQ(stopped_by(folder / "b.exr"), "samples");
}

TEST(Outputs, ASignalThatComesAgainCostsNothing) {
  const Folder folder;
  Start start(folder.path, SIGTERM);
  start.signal_times = 20;
  const Finished run =
      run_sateen({"render", "-m",        "swatch",       "--level",   "0", "-r",         "600",  "340", "-s",
                  "100000", "--effects", "none",         "--bounces", "0", "--progress", "json", "-o",  "a.exr",
                  "-o",     "a.png",     "--checkpoint", "c"},
                 start);
  EXPECT_EQ(run.code, 143) << run.err;
  for (const char* name : {"a.exr", "a.png", "c"}) EXPECT_TRUE(fs::exists(folder / name)) << name;
}

TEST(Outputs, APartialPictureDoesNotTakeThePlaceOfAFinishedOne) {
  const Folder folder;
  const auto render = [&](const char* samples, int signal) {
    Start start(folder.path, signal);
    return run_sateen({"render", "-m",        "swatch", "--level",      "0",  "-r",        "48", "27",         "-s",
                       samples,  "--effects", "none",   "--candidates", "2",  "--bounces", "0",  "--progress", "json",
                       "--aov",  "none",      "-o",     "a.exr",        "-o", "a.png"},
                      start);
  };
  ASSERT_EQ(render("1000000", SIGINT).code, 130);
  EXPECT_EQ(stopped_by(folder / "a.exr"), "interrupted");
  EXPECT_FALSE(fs::exists(folder / "a.partial.exr"));
  ASSERT_EQ(render("4", 0).code, 0) << "over a partial one";
  const std::string exr = read_text(folder / "a.exr"), png = read_text(folder / "a.png");
  EXPECT_EQ(stopped_by(folder / "a.exr"), "samples");
  const Finished stopped = render("1000000", SIGTERM);
  EXPECT_EQ(stopped.code, 143);
  EXPECT_NE(stopped.out.find("a.exr holds a finished picture and stays; the one so far goes to a.partial.exr"),
            std::string::npos)
      << stopped.out;
  EXPECT_EQ(read_text(folder / "a.exr"), exr);
  EXPECT_EQ(read_text(folder / "a.png"), png);
  EXPECT_EQ(stopped_by(folder / "a.partial.exr"), "interrupted");
  EXPECT_EQ(stopped_by(folder / "a.partial.png"), "interrupted");
}

TEST(Outputs, NoFileIsWrittenTwiceOrOverOneThatIsRead) {
  const Folder folder;
  fs::copy(fs::path(SATEEN_SOURCE_DIR) / "looks" / "velvet.json", folder.path / "parent.json");
  write_text(folder / "mine.json", R"({"inherits": "parent.json"})");
  write_text(folder / "mesh.obj",
             "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
  ASSERT_EQ(run_sateen(plain({"-o", "map.exr", "--checkpoint", "old"}), {folder.path}).code, 0);
  fs::create_symlink("map.exr", folder.path / "link.exr");
  fs::create_hard_link(folder / "mine.json", folder / "hard.json");
  fs::create_symlink("nothing.png", folder.path / "dangling.png");
  fs::create_directory(folder / "sub");
  struct Case {
    std::vector<std::string> flags;
    std::string message;
  };
  const std::string here = folder.path.string();
  const std::vector<Case> cases{
      {{"-o", "a.exr", "-o", "./a.exr"}, "./a.exr is given twice: as --output a.exr and as --output"},
      {{"-o", "a.exr", "-o", "sub/../a.exr"}, "given twice"},
      {{"-o", "a.exr", "-o", here + "/a.exr"}, "given twice"},
      {{"-o", "dangling.png", "-o", "nothing.png"}, "given twice"},
      {{"-o", "a.exr", "--checkpoint", "a.exr"}, "a.exr is given twice: as --output and as --checkpoint"},
      {{"-o", "a.exr", "--stats", "a.exr"}, "as --output and as --stats"},
      {{"-o", "a.exr", "--checkpoint", "q", "--stats", "q"}, "q is given twice: as --checkpoint and as --stats"},
      {{"-o", "a.exr", "-l", "mine.json", "--checkpoint", "mine.json"}, "--checkpoint mine.json is also the look"},
      {{"-o", "a.exr", "-l", "mine.json", "--stats", "hard.json"}, "that is read (mine.json)"},
      {{"-o", "a.exr", "-l", "mine.json", "--stats", "parent.json"}, "--stats parent.json is also the look"},
      {{"-o", "link.exr", "-e", "map.exr"}, "--output link.exr is also the map or texture that is read (map.exr)"},
      {{"-o", "a.exr", "-m", "mesh.obj", "--checkpoint", "mesh.obj"}, "is also the mesh that is read"},
      {{"-o", "a.exr", "--resume", "old", "--stats", "old"}, "--stats old is also the checkpoint that is read"},
  };
  std::map<std::string, std::string> before;
  for (const char* name : {"parent.json", "mine.json", "mesh.obj", "map.exr", "old"})
    before[name] = read_text(folder / name);
  for (const Case& each : cases) {
    const Finished run = run_sateen(plain(each.flags), {folder.path});
    EXPECT_EQ(run.code, 2) << each.message << "\n" << run.err;
    EXPECT_NE(run.err.find(each.message), std::string::npos) << each.message << "\n" << run.err;
  }
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"merge", "old", "old", "-o", "x.png", "--checkpoint", "old"},
           {"lobe", "mine.json", "-o", "mine.json", "--pairs", "parent.json"},
           {"turntable", "-n", "2", "-o", "t.####.png", "--sheet", "t.0002.png"},
           {"cost", "-l", "mine.json", "-o", "sub", "-e", "map.exr", "-m", "sub/index.html"},
       })
    EXPECT_EQ(run_sateen(words, {folder.path}).code, 2) << words[0];
  for (const auto& [name, text] : before) EXPECT_EQ(read_text(folder / name), text) << name;
  // A checkpoint goes on in its own file.
  EXPECT_EQ(
      run_sateen(plain({"-o", "a.exr", "-s", "8", "--resume", "old", "--checkpoint", "old"}), {folder.path}).code, 0);
}

TEST(Outputs, LinksStayLinksAndModesAreKept) {
  const Folder folder;
  fs::create_directory(folder / "far");
  fs::create_symlink("far/real.png", folder.path / "a.png");
  ASSERT_EQ(run_sateen(plain({"-o", "a.png"}), {folder.path}).code, 0);
  EXPECT_TRUE(fs::is_symlink(folder / "a.png"));
  EXPECT_EQ(sateen::read_image(folder / "far/real.png").width, 64);
  chmod((folder / "far/real.png").c_str(), 0640);
  ASSERT_EQ(run_sateen(plain({"-o", "a.png", "-s", "8"}), {folder.path}).code, 0);
  struct stat status {};
  ASSERT_EQ(stat((folder / "far/real.png").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0640u);
}

TEST(Outputs, EqualRendersGiveEqualBytesUnderAnyNameOnAnyThreadsAndHoweverTheyCameAbout) {
  const Folder folder;
  const Start here{folder.path};
  const auto bytes = [&](const std::string& name) { return read_text(folder / name); };
  ASSERT_EQ(run_sateen(plain({"-s", "32", "-t", "1", "-o", "a.exr", "-o", "a.png"}), here).code, 0);
  ASSERT_EQ(run_sateen(plain({"-s", "32", "-t", "2", "-o", "b.exr", "-o", "b.png", "--stats", "b.json"}), here).code,
            0);
  ASSERT_EQ(run_sateen(plain({"-s", "16", "-o", "half.png", "--checkpoint", "c"}), here).code, 0);
  // The first words decide what stands in the header; later ones win.
  ASSERT_EQ(run_sateen(plain({"-s", "32", "--resume", "c", "-o", "c.exr", "-o", "c.png"}), here).code, 0);
  for (const char* other : {"b", "c"})
    for (const char* kind : {".exr", ".png"})
      EXPECT_TRUE(bytes(std::string("a") + kind) == bytes(std::string(other) + kind)) << other << kind;
  EXPECT_EQ(sateen::read_attributes(folder / "a.exr").count("sateen:seconds"), 0u);
  EXPECT_NE(bytes("b.json").find("\"cpu_seconds\""), std::string::npos);
  ASSERT_EQ(run_sateen(plain({"-s", "32", "--timings", "-o", "d.exr"}), here).code, 0);
  EXPECT_EQ(sateen::read_attributes(folder / "d.exr").count("sateen:cpu_seconds"), 1u);
}

}  // namespace sateen_test
