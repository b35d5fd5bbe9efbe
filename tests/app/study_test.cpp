#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>

#include "image/file.h"
#include "program.h"

namespace sateen_test {

namespace {
const std::string study_usage =
    "usage: sateen study [--quick] [--looks NAMES] [--envs MAPS] [--mesh FILE] [-o FOLDER] [flags]\n";
const std::string cost_usage = "usage: sateen cost [--look NAME] [--mesh FILE] [--env MAP] [-o FOLDER] [flags]\n";

void expect_refused(const std::vector<std::string>& words, int code, const std::string& message) {
  const Finished run = run_sateen(words);
  EXPECT_EQ(run.code, code);
  EXPECT_EQ(run.err, message);
  EXPECT_EQ(run.out, "");
}

bool has(const std::string& text, const std::string& word) {
  return text.find(word) != std::string::npos;
}

// Every address of a page that stands alone is one of data.
void expect_alone(const std::string& html) {
  EXPECT_EQ(html.rfind("<!doctype html>", 0), 0u);
  EXPECT_TRUE(has(html, "</html>"));
  for (const char* word : {"http:", "https:", "src=\"/", "src=\"pictures", "@import", "<link"})
    EXPECT_FALSE(has(html, word)) << word;
}
}  // namespace

TEST(StudyCommand, WritesTablesPlotsAndAPageThatStandsAlone) {
  const Folder folder;
  const Finished run = run_sateen({"study", "-m", "swatch", "--looks", "linen_plain", "--envs", "white", "-r", "32",
                                   "18", "--seeds", "2", "-s", "16", "-o", "out"},
                                  {folder.path});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_TRUE(has(run.out, "auto over uniform, equal CPU time, geometric mean of 1 scene")) << run.out;
  EXPECT_TRUE(has(run.out, "table over uniform, 16 samples each, linen_plain in constant white light")) << run.out;
  const std::string csv = read_text(folder / "out/study.csv");
  EXPECT_EQ(csv.rfind("look,light,bounces,strategy,samples,seed,cpu_seconds,mse,relative_mse\n", 0), 0u);
  for (const char* strategy : {",uniform,", ",talk,", ",table,", ",mis,", ",mis-talk,", ",resampled,", ",2,uniform,"})
    EXPECT_TRUE(has(csv, strategy)) << strategy;
  EXPECT_TRUE(is_json(read_text(folder / "out/study.json")));
  for (const char* plot : {"equal_time", "samples_linen_plain_direct", "samples_linen_plain_bounces"}) {
    EXPECT_EQ(sateen::read_image(folder / (std::string("out/") + plot + ".png")).width, 1800);
    EXPECT_TRUE(has(read_text(folder / (std::string("out/") + plot + ".svg")), "</svg>"));
  }
  const std::string html = read_text(folder / "out/index.html");
  expect_alone(html);
  EXPECT_TRUE(has(html, "class=\"slider\"") && has(html, "data:image/jpeg;base64,") &&
              has(html, "data:image/png;base64,"));
  EXPECT_TRUE(has(html, "equal CPU time") && has(html, "equal number of samples"));
}

TEST(StudyCommand, ASignalWritesTheScenesThatAreFinished) {
  const Folder folder;
  Start start(folder.path);
  start.signal = SIGINT;
  start.signal_after = "linen_plain, white";
  const Finished run = run_sateen({"study", "-m", "swatch", "--looks", "linen_plain", "--envs", "white,overcast",
                                   "-r", "64", "36", "-s", "64", "-o", "out"},
                                  start);
  EXPECT_EQ(run.code, 130) << run.err;
  EXPECT_LT(run.seconds_after_signal, 5);
  EXPECT_EQ(read_text(folder / "out/study.txt").rfind("INTERRUPTED", 0), 0u);
  EXPECT_TRUE(has(read_text(folder / "out/index.html"), "INTERRUPTED"));
}

TEST(StudyCommand, WrongFlagsAreToldBeforeAnythingIsRendered) {
  expect_refused({"study", "--seeds", "1"}, 2,
                 "error: --seeds is 1, expected a whole number from 2 to 100\n" + study_usage);
  expect_refused({"study", "--quik"}, 2,
                 "error: there is no flag --quik\n  help: did you mean --quick?\n" + study_usage);
  expect_refused({"study", "--looks", "velvet,,linen"}, 2,
                 "error: --looks has an empty name in velvet,,linen\n" + study_usage);
  expect_refused({"study", "--looks", "velvet,emrald_satin"}, 3,
                 "error: there is no look called emrald_satin\n  help: did you mean emerald_satin?\n");
  expect_refused({"study", "--time", "soon"}, 2,
                 "error: --time is soon, expected a time such as 30, 30s, 2m or 1h30m\n" + study_usage);
  EXPECT_TRUE(has(run_sateen({"study", "--envs", "white,overcst"}).err, "did you mean overcast?"));
}

TEST(CostCommand, WritesThePriceListAndAPageThatStandsAlone) {
  const Folder folder;
  const Finished run = run_sateen({"cost", "-m", "swatch", "-l", "linen_plain", "-e", "overcast", "--level", "0",
                                   "-r", "40", "24", "-s", "16", "-o", "out", "--json"},
                                  {folder.path});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_TRUE(is_json(run.out));
  EXPECT_EQ(run.out, read_text(folder / "out/cost.json"));
  for (const char* quality : {"\"draft\"", "\"preview\"", "\"final\"", "\"flags\": \"--spp "})
    EXPECT_TRUE(has(run.out, quality)) << quality;
  const std::string text = read_text(folder / "out/cost.txt");
  for (const char* part :
       {"Error against time", "Price of bounces", "Price of quadrature", "Price of table size", "Price of map size",
        "Price of filter", "Price of strategy", "Price of candidates", "Price of subdivision level", "Recommended"})
    EXPECT_TRUE(has(text, part)) << part;
  EXPECT_TRUE(has(read_text(folder / "out/cost.csv"), "part,setting,samples,"));
  for (const char* plot : {"out/error_time.png", "out/prices.png"})
    EXPECT_EQ(sateen::read_image(folder / plot).width, 1800);
  const std::string html = read_text(folder / "out/index.html");
  expect_alone(html);
  EXPECT_TRUE(has(html, "class=\"slider\"") && has(html, "Recommended settings"));
}

TEST(CostCommand, FlagsThatMakeNoSenseForAPriceListAreRefused) {
  expect_refused({"cost", "--error", "0.01"}, 2,
                 "error: --error is not for sateen cost, which finds out what errors and times there are\n"
                 "  help: --spp sets how far it looks\n");
  expect_refused({"cost", "-s", "8"}, 2, "error: --spp is 8, expected 16 or more: a curve wants points\n");
  expect_refused({"cost", "-o", "list.png"}, 2,
                 "error: --output list.png looks like a file, and a price list is a folder\n"
                 "  help: name it without an extension, such as out/cost\n");
  expect_refused({"cost", "--lok", "x"}, 2,
                 "error: there is no flag --lok\n  help: did you mean --look?\n" + cost_usage);
}

}  // namespace sateen_test
