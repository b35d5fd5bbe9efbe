#include "look/read.h"

#include <fmt/format.h>

#include "base/parallel.h"
#include "look/describe.h"
#include "look_text.h"

namespace sateen {
namespace {

TEST(ReadLook, SaysWhatIsOutOfRangeAndWhatWasMeant) {
  EXPECT_EQ(error_in("{\n    \"warp\": { \"gamma_s_deg\": 170 }\n}"),
            "silk.json:2:30: error: gamma_s_deg is 170, expected 0.5 to 90\n"
            "    2 |     \"warp\": { \"gamma_s_deg\": 170 }\n"
            "      |                              ^^^\n"
            "  help: did you mean 17?");
  EXPECT_EQ(error_in("{\"weft\": {\"coverage\": 25}}"),
            "silk.json:1:23: error: coverage is 25, expected 0 to 1\n"
            "    1 | {\"weft\": {\"coverage\": 25}}\n"
            "      |                       ^^\n"
            "  help: did you mean 0.25?");
  EXPECT_EQ(error_in("{\"masking_width_deg\": 0.35}"),
            "silk.json:1:23: error: masking_width_deg is 0.35, expected 5 to 60\n"
            "    1 | {\"masking_width_deg\": 0.35}\n"
            "      |                       ^^^^\n"
            "  help: did you mean 20.1? (0.35 radians)");
  EXPECT_EQ(error_in("{\"warp\": {\"eta\": 4e9}}"),
            "silk.json:1:18: error: eta is 4e9, expected 1 to 3\n"
            "    1 | {\"warp\": {\"eta\": 4e9}}\n"
            "      |                  ^^^");
  EXPECT_EQ(error_in("{\"warp\": {\"offsets_deg\": [-20, 100], \"lengths\": [-1]}}"),
            "silk.json:1:32: error: offsets_deg[1] is 100, expected -90 to 90\n"
            "    1 | {\"warp\": {\"offsets_deg\": [-20, 100], \"lengths\": [-1]}}\n"
            "      |                                ^^^\n"
            "  help: did you mean 10?\n"
            "silk.json:1:50: error: lengths[0] is -1, expected 0 to 1000\n"
            "    1 | {\"warp\": {\"offsets_deg\": [-20, 100], \"lengths\": [-1]}}\n"
            "      |                                                  ^^\n"
            "  help: did you mean 1?");
}

TEST(ReadLook, NamesTheNearestKeyOrTheLevelWhereItBelongs) {
  const std::pair<const char*, const char*> cases[] = {
      {"{\"warp\": {\"gama_s_deg\": 3}}",
       "silk.json:1:11: error: unknown key gama_s_deg\n    1 | {\"warp\": {\"gama_s_deg\": 3}}\n"
       "      |           ^^^^^^^^^^^^\n  help: did you mean gamma_s_deg?"},
      {"{\"warp\": {\"gamma_s\": 3}}",
       "silk.json:1:11: error: unknown key gamma_s\n    1 | {\"warp\": {\"gamma_s\": 3}}\n"
       "      |           ^^^^^^^^^\n  help: did you mean gamma_s_deg?"},
      {"{\"eta\": 1.5}",
       "silk.json:1:2: error: unknown key eta\n    1 | {\"eta\": 1.5}\n      |  ^^^^^\n"
       "  help: it belongs inside \"warp\" or \"weft\""},
      {"{\"warp\": {\"masking_width_deg\": 20}}",
       "silk.json:1:11: error: unknown key masking_width_deg\n    1 | {\"warp\": {\"masking_width_deg\": 20}}\n"
       "      |           ^^^^^^^^^^^^^^^^^^^\n  help: it belongs at the top level"},
      {"{\"colour\": [0, 0, 0]}",
       "silk.json:1:2: error: unknown key colour\n    1 | {\"colour\": [0, 0, 0]}\n      |  ^^^^^^^^\n"
       "  help: did you mean color?"},
      {"{\"zzzzzzzz\": 0}",
       "silk.json:1:2: error: unknown key zzzzzzzz\n    1 | {\"zzzzzzzz\": 0}\n      |  ^^^^^^^^^^\n"
       "  help: known: title, description, source, color_space, color, masking_width_deg, warp_angle_deg, back, "
       "inherits, pattern, warp, weft, weave"},
      {"{\"a\": [1, 1, 1]}",
       "silk.json:1:2: error: unknown key a\n    1 | {\"a\": [1, 1, 1]}\n      |  ^^^\n"
       "  help: did you mean A, inside \"warp\" or \"weft\"?"},
      {"{\"warp\": {\"bakc\": \"velvet\"}}",
       "silk.json:1:11: error: unknown key bakc\n    1 | {\"warp\": {\"bakc\": \"velvet\"}}\n      |           "
       "^^^^^^\n"
       "  help: did you mean back, at the top level?"},
      {"{\"warp\": {\"inherits\": \"velvet\"}}",
       "silk.json:1:11: error: unknown key inherits\n    1 | {\"warp\": {\"inherits\": \"velvet\"}}\n"
       "      |           ^^^^^^^^^^\n  help: it belongs at the top level"},
  };
  for (const auto& [text, expected] : cases) EXPECT_EQ(error_in(text), expected) << text;
}

TEST(ReadLook, SaysWhichKindOfValueItExpected) {
  const std::pair<const char*, const char*> cases[] = {
      {"{\"warp\": {\"eta\": \"1.5\"}}", "eta is the text \"1.5\", expected a number from 1 to 3"},
      {"{\"warp\": {\"eta\": null}}", "eta is null, expected a number from 1 to 3"},
      {"{\"warp\": {\"eta\": true}}", "eta is true, expected a number from 1 to 3"},
      {"{\"warp\": {\"eta\": [1]}}", "eta is a list of 1, expected a number from 1 to 3"},
      {"{\"warp\": {\"eta\": {}}}", "eta is an object, expected a number from 1 to 3"},
      {"{\"warp\": [1]}", "warp holds no fields, expected an object { ... }"},
      {"{\"title\": 5}", "title is 5, expected a text"},
      {"{\"color_space\": \"\"}", "color_space is the text \"\", expected a name"},
      {"{\"back\": []}", "back is a list of 0, expected the name of a look"},
      {"{\"inherits\": 5}", "inherits is no name, expected the name or path of one look"},
      {"{\"inherits\": [\"velvet\", \"linen_plain\"]}", "inherits is no name, expected the name or path of one look"},
      {"{\"warp\": {\"offsets_deg\": 5}}", "offsets_deg is 5, expected a list of 2 to 64 numbers"},
      {"{\"warp\": {\"offsets_deg\": [5]}}", "offsets_deg is a list of 1, expected a list of 2 to 64 numbers"},
      {"{\"warp\": {\"offsets_deg\": [5, \"x\"]}}",
       "offsets_deg[1] is the text \"x\", expected a number from -90 to 90"},
      {"{\"warp\": {\"lengths\": []}}", "lengths is a list of 0, expected a list of 1 to 63 numbers"},
      {"{\"color\": \"red\"}", "color is the text \"red\", expected three numbers [red, green, blue]"},
      {"{\"color\": [1, 1]}", "color is a list of 2, expected three numbers [red, green, blue]"},
      {"{\"color\": {\"space\": \"x\"}}",
       "color has no \"value\", expected {\"value\": [red, green, blue], \"space\": ...}"},
      {"{\"color\": {\"value\": [0, 0, 0], \"space\": 1}}",
       "space of color is 1, expected the name of a colour space"},
      {"{\"color\": {\"value\": [0, 0, 0], \"spice\": 1}}", "unknown key spice in color"},
      {"{\"color\": [0, 200, 0]}", "green of color is 200, expected 0 to 1"},
      {"{\"warp\": {\"A\": [0, 0, -1]}}", "blue of A is -1, expected 0 to 100"},
      {"[]", "a look is an object, expected { at the beginning"},
      {"7", "a look is an object, expected { at the beginning"},
  };
  for (const auto& [text, expected] : cases) {
    const std::string message = error_in(text);
    EXPECT_NE(message.find(std::string("error: ") + expected + "\n"), std::string::npos) << text << "\n" << message;
  }
  EXPECT_NE(error_in("{\"color\": [0, 200, 0]}").find("help: colours go from 0 to 1, not to 100 or 255"),
            std::string::npos);
}

TEST(ReadLook, ReportsAllFaultsOfAFileInTheirOrder) {
  const std::string text =
      "{\n"
      "  \"titel\": \"Silk\",\n"
      "  \"warp\": {\n"
      "    \"eta\": 0.5,\n"
      "    \"eta\": 1.5,\n"
      "    \"k_d\": \"x\"\n"
      "  },\n"
      "  \"inherits\": \"velvt\"\n"
      "}\n";
  EXPECT_EQ(error_in(text),
            "silk.json:2:3: error: unknown key titel\n"
            "    2 |   \"titel\": \"Silk\",\n"
            "      |   ^^^^^^^\n"
            "  help: did you mean title?\n"
            "silk.json:4:12: error: eta is 0.5, expected 1 to 3\n"
            "    4 |     \"eta\": 0.5,\n"
            "      |            ^^^\n"
            "silk.json:5:5: error: eta is given twice, first at 4:5\n"
            "    5 |     \"eta\": 1.5,\n"
            "      |     ^^^^^\n"
            "silk.json:6:12: error: k_d is the text \"x\", expected a number from 0 to 1\n"
            "    6 |     \"k_d\": \"x\"\n"
            "      |            ^^^\n"
            "silk.json:8:15: error: inherits from velvt, but there is no such look\n"
            "    8 |   \"inherits\": \"velvt\"\n"
            "      |               ^^^^^^^\n"
            "  help: did you mean velvet?");
}

TEST(ReadLook, PrintsTwentyFaultsAndCountsTheRest) {
  std::string text = "{";
  for (int i = 0; i < 25; ++i) text += fmt::format("{}\"x{}\": 0", i ? "," : "", i);
  const std::string message = error_in(text + "}");
  EXPECT_NE(message.find("\n... and 5 more"), std::string::npos) << message;
}

TEST(ReadLook, ChecksLengthsAgainstOffsetsAndCoverageAgainstTheArea) {
  EXPECT_EQ(error_in("{\"warp\": {\"offsets_deg\": [-20, 0, 20], \"lengths\": [1]}}"),
            "silk.json:1:51: error: warp has 1 lengths, expected 2 for its 3 offsets\n"
            "    1 | {\"warp\": {\"offsets_deg\": [-20, 0, 20], \"lengths\": [1]}}\n"
            "      |                                                   ^^^\n"
            "  help: one length for each piece between neighbouring offsets");
  EXPECT_EQ(error_in("{\"inherits\": \"linen_plain\", \"weft\": {\"offsets_deg\": [-20, 0, 20]}}"),
            "silk.json:1:53: error: weft has 1 lengths, expected 2 for its 3 offsets\n"
            "    1 | {\"inherits\": \"linen_plain\", \"weft\": {\"offsets_deg\": [-20, 0, 20]}}\n"
            "      |                                                     ^^^^^^^^^^^^\n"
            "  help: one length for each piece between neighbouring offsets");
  EXPECT_EQ(error_in("{\"warp\": {\"offsets_deg\": [0, 9, 0], \"lengths\": [0, 0]}}"),
            "silk.json:1:48: error: the lengths of warp are all below 0.001, expected one above\n"
            "    1 | {\"warp\": {\"offsets_deg\": [0, 9, 0], \"lengths\": [0, 0]}}\n"
            "      |                                                ^^^^^^");
  EXPECT_EQ(error_in("{\"warp\": {\"coverage\": 0.7}, \"weft\": {\"coverage\": 0.4}}"),
            "silk.json:1:50: error: the coverage of warp (0.7) and weft (0.4) adds up to 1.1, expected 0.001 to 1\n"
            "    1 | {\"warp\": {\"coverage\": 0.7}, \"weft\": {\"coverage\": 0.4}}\n"
            "      |                                                  ^^^");
  EXPECT_NE(error_in("{\"warp\": {\"coverage\": 0}, \"weft\": {\"coverage\": 0}}").find("adds up to 0, expected"),
            std::string::npos);
  EXPECT_EQ(error_in("{\"warp\": {\"coverage\": 0.9}, \"weft\": {\"coverage\": 0.1}}"), "(no error)");
  EXPECT_EQ(error_in("{\"warp\": {\"coverage\": 0.86}, \"weft\": {\"coverage\": 0.14}}"), "(no error)");
}

TEST(ReadLook, AllowsColorOrAButNotBothInOneFamilyOfOneFile) {
  EXPECT_EQ(error_in("{\"warp\": {\"color\": [0.5, 0.5, 0.5],\n \"A\": [1, 1, 1]}}"),
            "silk.json:2:2: error: warp gives both color and A, expected one of them\n"
            "    2 |  \"A\": [1, 1, 1]}}\n"
            "      |  ^^^\n"
            "  help: A is solved from color; drop A, or drop color to keep the raw scale");
  EXPECT_EQ(error_in("{\"warp\": {\"color\": [0.5, 0.5, 0.5]}, \"weft\": {\"A\": [1, 1, 1]}}"), "(no error)");
}

TEST(ReadLook, AcceptsCommentsASchemaAByteOrderMarkAndCrLf) {
  use_source_tree();
  const Look look = parse_look(
      "\xef\xbb\xbf// silk\r\n{ /* one */ \"$schema\": \"look.schema.json\",\r\n \"warp\": { \"eta\": 15e-1 } }\r\n",
      "a/b.json");
  EXPECT_EQ(look.warp.eta, 1.5f);
  EXPECT_EQ(look.name, "b");
  EXPECT_EQ(look.file, "a/b.json");
}

TEST(ReadLook, RoundsNumbersOnceAndDropsTheSignOfZero) {
  use_source_tree();
  // Just above the middle of two floats: by way of double it would fall onto the middle and round down.
  const Look look =
      parse_look("{\"warp\": {\"k_d\": 0.500000029802322387695312500000000001, \"coverage\": -0}}", "a.json");
  EXPECT_EQ(look.warp.k_d, std::nextafter(0.5f, 1.0f));
  EXPECT_FALSE(std::signbit(look.warp.coverage));
  EXPECT_EQ(parse_look("{\"warp\": {\"k_d\": 1e-60}}", "a.json").warp.k_d, 0);
}

TEST(ReadLook, SurvivesAFileOfMillionsOfBytes) {
  const double before = cpu_seconds();
  std::string text = "{";
  for (int i = 0; text.size() + 20 < (8u << 20); ++i) text += fmt::format("{}\"{}\":0", i ? "," : "", i);
  const std::string message = error_in(text + "}");
  EXPECT_NE(message.find("more than 500000 values"), std::string::npos);
  text = "{";
  for (int i = 0; i < 400000; ++i) text += fmt::format("{}\"{}\":0", i ? ",\n" : "", i);
  EXPECT_NE(error_in(text + "}").find("... and 980 more"), std::string::npos);
  EXPECT_LT(cpu_seconds() - before, 4);
}

TEST(ReadLook, SaysThatALookIsMissingAndNamesTheNearest) {
  use_source_tree();
  try {
    read_look("silk_shott");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.kind, InputError::Kind::unreadable);
    EXPECT_STREQ(error.what(), "error: there is no look called silk_shott\n  help: did you mean silk_shot?");
  }
  EXPECT_EQ(error_of([] { read_look("no/such/velvt.json"); }),
            "error: no/such/velvt.json: no such file\n  help: did you mean velvet?");
  EXPECT_EQ(error_of([] { read_look("crepe"); }),
            "error: there is no look called crepe\n  help: did you mean silk_crepe_de_chine?");
  EXPECT_EQ(error_of([] { read_look(SATEEN_SOURCE_DIR "/looks"); }),
            "error: " SATEEN_SOURCE_DIR "/looks: is a folder, expected a file");
  EXPECT_NE(error_of([] { read_look(""); }), "(no error)");
  EXPECT_NE(error_of([] { read_look(std::string("velvet\0", 7)); }), "(no error)");
  EXPECT_NE(error_of([] { read_look(std::string(5000, 'x')); }), "(no error)");
}

TEST(ReadLook, SearchesExtraFoldersThenTheEnvironmentThenItsOwnLooks) {
  use_source_tree();
  const ScratchFolder scratch;
  scratch.write("show/looks/velvet.json", "{\"title\": \"of the show\"}");
  scratch.write("shot/velvet.json", "{\"title\": \"of the shot\", \"warp\": {}}");
  scratch.write("shot/other.json", "{\"rows\": []}");
  EXPECT_EQ(read_look("velvet").title, "Velvet, near black");
  setenv("SATEEN_PATH", (":" + scratch.file("nowhere") + "::" + scratch.file("show")).c_str(), 1);
  EXPECT_EQ(read_look("velvet").title, "of the show");
  EXPECT_EQ(read_look("velvet.json").title, "of the show");
  EXPECT_EQ(read_look("velvet", {}, {scratch.path() / "shot"}).title, "of the shot");
  EXPECT_EQ(read_look(scratch.file("shot/velvet.json")).title, "of the shot");
  EXPECT_EQ(read_look(scratch.file("shot/velvet")).title, "of the shot");
  const std::vector<LookEntry> all = list_looks({scratch.path() / "shot"});
  use_source_tree();
  int velvets = 0;
  for (const LookEntry& entry : all) {
    EXPECT_NE(entry.name, "other");
    if (entry.name != "velvet") continue;
    ++velvets;
    EXPECT_EQ(entry.path, scratch.file("shot/velvet.json"));
  }
  EXPECT_EQ(velvets, 1);
  EXPECT_TRUE(std::is_sorted(all.begin(), all.end(), [](auto& a, auto& b) { return a.name < b.name; }));
}

}  // namespace
}  // namespace sateen
