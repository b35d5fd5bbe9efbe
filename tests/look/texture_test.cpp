#include <algorithm>

#include "look/describe.h"
#include "look_text.h"

namespace sateen {
namespace {

std::string error_at(const ScratchFolder& folder, const std::string& text) {
  return error_of([&] { parse_look(text, folder.file("silk.json")); });
}

TEST(TextureValue, IsReadAndWrittenBackTheSame) {
  use_source_tree();
  const ScratchFolder folder;
  folder.write("maps/a.png", "a");
  const std::string text =
      R"({"color": {"texture": "maps/a.png", "space": "srgb_texture", "scale": 0.8, "offset": 0.1, "repeat": [4, 2.5]},
          "warp": {"k_d": {"texture": "maps/a.png", "wrap": "mirror"}},
          "weft": {"k_d": {"texture": "maps/a.png", "repeat_cm": [12, 7.5]}},
          "warp_angle_deg": {"texture": "maps/a.png", "scale": 360}})";
  const Look look = parse_look(text, folder.file("silk.json"));
  ASSERT_EQ(look.textures.size(), 5u);
  EXPECT_EQ(look.textures.at("weft.k_d").repeat_cm[1], 7.5f);
  EXPECT_FALSE(is_sized(look.textures.at("warp.k_d")));
  EXPECT_EQ(field_text(look, *find_field("weft.k_d")), R"({"texture": "maps/a.png", "repeat_cm": [12, 7.5]})");
  const TextureValue& color = look.textures.at("weft.color");
  EXPECT_EQ(color.path, folder.file("maps/a.png"));
  EXPECT_EQ(color.space, "srgb_texture");
  EXPECT_EQ(color.scale, 0.8f);
  EXPECT_EQ(color.offset, 0.1f);
  EXPECT_EQ(color.repeat[1], 2.5f);
  EXPECT_EQ(color.origin, folder.file("silk.json") + ":1");
  EXPECT_EQ(look.textures.at("warp.k_d").wrap, TextureWrap::mirror);
  EXPECT_EQ(field_text(look, *find_field("warp.k_d")), R"({"texture": "maps/a.png", "wrap": "mirror"})");
  EXPECT_EQ(field_text(look, *find_field("warp.A")), "");
  const Look again = parse_look(write_look(look), folder.file("silk.json"));
  EXPECT_EQ(all_values(again), all_values(look));
}

TEST(TextureValue, GivesWayToAValueAndTakesItsPlace) {
  use_source_tree();
  const ScratchFolder folder;
  folder.write("a.png", "a");
  folder.write("parent.json",
               R"({"color": {"texture": "a.png", "space": "srgb_texture"}, "warp": {"k_d": {"texture": "a.png"}}})");
  const auto child = [&](const std::string& members) {
    return parse_look("{\"inherits\": \"parent.json\"" + members + "}", folder.file("child.json"));
  };
  EXPECT_EQ(child("").textures.size(), 3u);
  const Look plain = child(R"(, "color": [0.5, 0.5, 0.5], "warp": {"k_d": 0.7})");
  EXPECT_TRUE(plain.textures.empty());
  EXPECT_EQ(plain.warp.k_d, 0.7f);
  const Look raw = child(R"(, "warp": {"A": [0.1, 0.1, 0.1]})");
  EXPECT_FALSE(raw.textures.contains("warp.color"));
  EXPECT_TRUE(raw.textures.contains("weft.color"));
  // A family that says its own colour keeps it beside the shorthand.
  const Look both =
      child(R"(, "color": [0.5, 0.5, 0.5], "weft": {"color": {"texture": "a.png", "space": "acescg"}})");
  EXPECT_EQ(both.textures.at("weft.color").space, "acescg");
  EXPECT_FALSE(both.textures.contains("warp.color"));
  Look set = plain;
  apply_override(set, "weft.eta={\"texture\": \"a.png\", \"offset\": 1}");
  EXPECT_EQ(set.textures.at("weft.eta").origin, "--set weft.eta");
  apply_override(set, "weft.eta=1.5");
  EXPECT_TRUE(set.textures.empty());
}

TEST(TextureValue, CountsInTheHashByWhatTheFileHolds) {
  use_source_tree();
  const ScratchFolder folder;
  folder.write("a.png", "one");
  folder.write("b.png", "one");
  folder.write("c.png", "other");
  const auto hash = [&](const std::string& name, const std::string& more = "") {
    return look_hash(
        parse_look("{\"warp\": {\"k_d\": {\"texture\": \"" + name + "\"" + more + "}}}", folder.file("silk.json")));
  };
  EXPECT_EQ(hash("a.png"), hash("b.png"));
  EXPECT_NE(hash("a.png"), hash("c.png"));
  EXPECT_NE(hash("a.png"), hash("a.png", ", \"scale\": 0.5"));
  EXPECT_NE(hash("a.png"), hash("a.png", ", \"repeat_cm\": [8, 8]"));
  EXPECT_NE(hash("a.png"), look_hash(parse_look("{}", folder.file("silk.json"))));
}

TEST(TextureValue, SaysWhatIsWrongAndWhere) {
  use_source_tree();
  const ScratchFolder folder;
  folder.write("print.png", "a");
  folder.write("u.1001.png", "a");
  folder.write("folder/x", "a");
  const std::pair<const char*, const char*> cases[] = {
      {R"({"warp": {"k_d": {"texture": "prnt.png"}}})", "did you mean print.png?"},
      {R"({"warp": {"k_d": {"texture": "folder"}}})", "is not a regular file"},
      {R"({"warp": {"k_d": {"texture": "v.<UDIM>.png"}}})", "of any number"},
      {R"({"warp": {"k_d": {"texture": ""}}})", "expected the path of a picture"},
      {R"({"warp": {"k_d": {"texture": "print.png", "space": "acescg"}}})", "numbers are taken as they are"},
      {R"({"color": {"texture": "print.png"}})", "add \"space\": \"srgb_texture\""},
      {R"({"warp": {"lengths": {"texture": "print.png"}}})", "lengths cannot be a texture"},
      {R"({"warp": {"k_d": {"texture": "print.png", "scal": 2}}})", "did you mean scale?"},
      {R"({"warp": {"k_d": {"texture": "print.png", "wrap": "reapeat"}}})", "did you mean repeat?"},
      {R"({"warp": {"k_d": {"texture": "print.png", "repeat": [0, 1]}}})", "expected a number from 0.001 to 10000"},
      {R"({"warp": {"k_d": {"texture": "print.png", "repeat": 3}}})", "expected [along u, along v]"},
      {R"({"warp": {"k_d": {"texture": "u.<UDIM>.png", "repeat": [2, 2]}}})", "expected one of them"},
      {R"({"warp": {"k_d": {"texture": "u.<UDIM>.png", "repeat_cm": [2, 2]}}})", "expected one of them"},
      {R"({"warp": {"k_d": {"texture": "print.png", "repeat": [1, 1], "repeat_cm": [8, 8]}}})",
       "repeat and repeat_cm, expected one of them"},
      {R"({"warp": {"k_d": {"texture": "print.png", "repeat_cm": [0, 8]}}})",
       "expected a number from 0.001 to 100000"},
      {R"({"warp": {"k_d": {"texture": "print.png", "repeat_cm": 8}}})", "centimetres along u"},
      {R"({"warp": {"k_d": {"texture": "print.png", "repaet_cm": [8, 8]}}})", "did you mean repeat_cm?"},
      {R"({"pattern": {"mask": 0.5}})", "no look to weave in"},
      {R"({"pattern": {"mask": 0.5, "look": "no_such_look"}})", "there is no such look"},
      {R"({"mask": 0.5})", "it belongs inside \"pattern\""}};
  for (const auto& [text, expected] : cases) {
    const std::string error = error_at(folder, text);
    EXPECT_NE(error.find(expected), std::string::npos) << text << "\n" << error;
    EXPECT_NE(error.find("silk.json:1:"), std::string::npos) << error;
  }
  EXPECT_EQ(error_at(folder, R"({"warp": {"k_d": {"texture": "u.<UDIM>.png"}}})"), "(no error)");
}

}  // namespace
}  // namespace sateen
