#include <fmt/format.h>

#include "look/describe.h"
#include "look_text.h"

namespace sateen {
namespace {

TEST(Inherit, ShowsTheCircleOfParents) {
  use_source_tree();
  const ScratchFolder scratch;
  const std::string a = scratch.write("a.json", "{\"inherits\": \"b\"}");
  const std::string b = scratch.write("b.json", "{\n\"inherits\": \"./sub/c.json\"}");
  const std::string c = scratch.write("sub/c.json", "{\"inherits\": \"../a.json\"}");
  EXPECT_EQ(error_of([&] { read_look(a); }),
            scratch.file("./sub/c.json") +
                ":1:14: error: inherits in a circle: a -> b -> c -> a\n    1 | {\"inherits\": \"../a.json\"}\n"
                "      |              ^^^^^^^^^^^");
  const std::string self = scratch.write("self.json", "{\"inherits\": \"self\"}");
  EXPECT_NE(error_of([&] { read_look(self); }).find("inherits in a circle: self -> self"), std::string::npos);
}

TEST(Inherit, RefusesAChainWithoutEnd) {
  use_source_tree();
  const ScratchFolder scratch;
  for (int i = 0; i < 40; ++i)
    scratch.write(fmt::format("l{}.json", i), fmt::format("{{\"inherits\": \"l{}\"}}", i + 1));
  EXPECT_NE(error_of([&] { read_look(scratch.file("l0.json")); }).find("has more than 32 parents"),
            std::string::npos);
  scratch.write("l20.json", "{}");
  EXPECT_EQ(read_look(scratch.file("l0.json")).name, "l0");
}

TEST(Inherit, ReportsTheFaultsOfTheParentBehindItsOwn) {
  use_source_tree();
  const ScratchFolder scratch;
  scratch.write("parent.json", "{\"warp\": {\"eta\": 9}}");
  const std::string child = scratch.write("child.json", "{\"inherits\": \"parent\", \"warp\": {\"k_d\": 9}}");
  const std::string message = error_of([&] { read_look(child); });
  const size_t own = message.find("child.json:1:40: error: k_d is 9"),
               parents = message.find("parent.json:1:18: error: eta is 9");
  ASSERT_NE(own, std::string::npos) << message;
  ASSERT_NE(parents, std::string::npos) << message;
  EXPECT_LT(own, parents);
}

TEST(Inherit, ReplacesFieldByFieldButNotTheTitle) {
  use_source_tree();
  const Look child = parse_look("{\"inherits\": \"velvet\", \"warp\": {\"eta\": 1.6}}", "mine.json");
  const Look parent = read_look("velvet");
  EXPECT_EQ(child.title, "");
  EXPECT_EQ(child.description, "");
  EXPECT_EQ(child.source, parent.source);
  EXPECT_EQ(child.warp.eta, 1.6f);
  EXPECT_EQ(child.warp.offsets_deg, parent.warp.offsets_deg);
  EXPECT_EQ(child.weft.A.value, parent.weft.A.value);
  const std::vector<FieldDifference> differences = diff_looks(parent, child);
  ASSERT_EQ(differences.size(), 1u);
  EXPECT_EQ(differences[0].path, "warp.eta");
  EXPECT_EQ(differences[0].a, "1.46");
  EXPECT_EQ(differences[0].b, "1.6");
}

TEST(Inherit, LetsColorDropAnInheritedAAndAAnInheritedColor) {
  use_source_tree();
  const ScratchFolder scratch;
  scratch.write("raw.json", "{\"warp\": {\"A\": [1, 2, 3]}, \"weft\": {\"A\": [4, 5, 6]}}");
  scratch.write("dyed.json", "{\"inherits\": \"raw\", \"warp\": {\"color\": [0.5, 0.25, 0.125]}}");
  scratch.write("again.json", "{\"inherits\": \"dyed\", \"warp\": {\"A\": [7, 8, 9]}}");
  const Look dyed = read_look(scratch.file("dyed.json")), again = read_look(scratch.file("again.json"));
  ASSERT_TRUE(dyed.warp.color);
  EXPECT_EQ(dyed.warp.color->value, Color(0.5f, 0.25f, 0.125f));
  EXPECT_EQ(dyed.warp.A.value, ThreadFamily().A.value);
  EXPECT_FALSE(dyed.weft.color);
  EXPECT_EQ(dyed.weft.A.value, Color(4, 5, 6));
  EXPECT_FALSE(again.warp.color);
  EXPECT_EQ(again.warp.A.value, Color(7, 8, 9));
}

TEST(Inherit, GivesTheLooksColorToFamiliesThatNameNoneInThatFile) {
  use_source_tree();
  const ScratchFolder scratch;
  scratch.write("p.json", "{\"warp\": {\"A\": [1, 1, 1]}, \"weft\": {\"color\": [0.5, 0.5, 0.5]}}");
  scratch.write("all.json", "{\"inherits\": \"p\", \"color\": [0.25, 0.25, 0.25]}");
  scratch.write("one.json", "{\"inherits\": \"p\", \"color\": [0.25, 0.25, 0.25], \"weft\": {\"A\": [2, 2, 2]}}");
  const Look all = read_look(scratch.file("all.json")), one = read_look(scratch.file("one.json"));
  ASSERT_TRUE(all.warp.color && all.weft.color && one.warp.color);
  EXPECT_EQ(all.warp.color->value, Color(0.25f));
  EXPECT_EQ(all.weft.color->value, Color(0.25f));
  EXPECT_EQ(one.warp.color->value, Color(0.25f));
  EXPECT_FALSE(one.weft.color);
  EXPECT_EQ(one.weft.A.value, Color(2));
}

TEST(Inherit, KeepsColoursInTheSpaceOfTheFileThatGaveThem) {
  use_source_tree();
  const ScratchFolder scratch;
  scratch.write("p.json", "{\"color_space\": \"lin_rec709\", \"color\": [0.5, 0.5, 0.5]}");
  scratch.write("c.json",
                "{\"inherits\": \"p\", \"color_space\": \"acescg\", \"weft\": {\"color\": [0.1, 0.2, 0.3]}}");
  const Look look = read_look(scratch.file("c.json"));
  EXPECT_EQ(look.color_space, "acescg");
  EXPECT_EQ(look.warp.color->space, "lin_rec709");
  EXPECT_EQ(look.weft.color->space, "");
  const Look written = parse_look(write_look(look), look.file);
  EXPECT_EQ(all_values(written), all_values(look));
  EXPECT_EQ(look_hash(written), look_hash(look));
}

TEST(Inherit, TellsTheOriginOfEveryValue) {
  use_source_tree();
  const ScratchFolder scratch;
  scratch.write("p.json", "{\n\"title\": \"P\",\n\"warp\": {\n\"eta\": 1.5,\n\"k_d\": 0.2\n}\n}");
  const std::string file =
      scratch.write("c.json", "{\n\"inherits\": \"p\",\n\"color\": [0.5, 0.5, 0.5],\n\"warp\": {\"k_d\": 0.4}}");
  const ResolvedLook resolved = resolve_look(file, {"weft.eta=2", "masking_width_deg=15"});
  const auto origin = [&](const std::string& path) {
    for (const FieldOrigin& value : resolved.values)
      if (value.path == path) return value.value + " " + value.origin;
    return std::string("none");
  };
  EXPECT_EQ(origin("title"), "\"\" default");
  EXPECT_EQ(origin("warp.eta"), "1.5 " + scratch.file("p.json") + ":4");
  EXPECT_EQ(origin("warp.k_d"), "0.4 " + file + ":4");
  EXPECT_EQ(origin("warp.color"), "[0.5, 0.5, 0.5] " + file + ":3");
  EXPECT_EQ(origin("weft.color"), "[0.5, 0.5, 0.5] " + file + ":3");
  EXPECT_EQ(origin("warp.A"), "none");
  EXPECT_EQ(origin("weft.eta"), "2 --set");
  EXPECT_EQ(origin("masking_width_deg"), "15 --set");
  EXPECT_EQ(origin("weft.coverage"), "0.5 default");
  EXPECT_EQ(resolved.files, (std::vector<std::string>{file, scratch.file("p.json")}));
}

TEST(Inherit, ChecksThatTheBackExistsAndKeepsItsPathWhole) {
  use_source_tree();
  const ScratchFolder scratch;
  EXPECT_EQ(error_in("{\"back\": \"velvt\"}"),
            "silk.json:1:10: error: back is velvt, but there is no such look\n    1 | {\"back\": \"velvt\"}\n"
            "      |          ^^^^^^^\n  help: did you mean velvet?");
  scratch.write("sub/back.json", "{\"title\": \"B\", \"warp\": {}}");
  scratch.write("p/p.json", "{\"back\": \"../sub/back.json\"}");
  const std::string file = scratch.write("c.json", "{\"inherits\": \"p/p.json\"}");
  const Look look = read_look(file);
  EXPECT_EQ(look.back, scratch.file("sub/back.json"));
  EXPECT_EQ(read_back(look).title, "B");
  EXPECT_EQ(all_values(parse_look(write_look(look), look.file)), all_values(look));
}

}  // namespace
}  // namespace sateen
