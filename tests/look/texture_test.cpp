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

TEST(TextureValue, NamesALayerOfItsFileWhichCountsInTheHash) {
  use_source_tree();
  const ScratchFolder folder;
  folder.write("a.exr", "a");
  const auto read = [&](const std::string& more) {
    return parse_look("{\"warp\": {\"k_d\": {\"texture\": \"a.exr\"" + more + "}}}", folder.file("silk.json"));
  };
  const Look look = read(R"(, "layer": "wear.amount")");
  EXPECT_EQ(look.textures.at("warp.k_d").layer, "wear.amount");
  EXPECT_EQ(field_text(look, *find_field("warp.k_d")), R"({"texture": "a.exr", "layer": "wear.amount"})");
  EXPECT_EQ(all_values(parse_look(write_look(look), folder.file("silk.json"))), all_values(look));
  EXPECT_NE(look_hash(look), look_hash(read("")));
  const std::string faulty = R"({"warp": {"k_d": {"texture": "a.exr", "layer": 3}}})";
  EXPECT_NE(error_at(folder, faulty).find("layer of k_d is no text"), std::string::npos);
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

TEST(TextureValue, KeepsWhatLiesUnderItThroughInheritingWritingAndHashing) {
  use_source_tree();
  const ScratchFolder folder;
  folder.write("a.png", "a");
  folder.write("parent.json", R"({"color": [0.2, 0.5, 0.4], "warp": {"k_d": 0.7}, "weft": {"A": [0.1, 0.2, 0.3]}})");
  const std::string color = R"("color": {"texture": "a.png", "space": "srgb_texture"})";
  const auto read = [&](const std::string& members) {
    return parse_look("{" + members + "}", folder.file("c.json"));
  };
  const Look child = read(R"("inherits": "parent.json", )" + color +
                          R"(, "warp": {"k_d": {"texture": "a.png"}, "eta": {"texture": "a.png"}})");
  EXPECT_EQ(child.warp.color.value().value.y, 0.5f);
  EXPECT_FALSE(child.weft.color);
  EXPECT_EQ(child.weft.A.value.z, 0.3f);
  EXPECT_EQ(child.warp.k_d, 0.7f);
  const auto text = [](const Look& look, const char* path) { return field_text(look, *find_field(path)); };
  EXPECT_EQ(text(child, "warp.k_d"), R"({"texture": "a.png", "under": 0.7})");
  EXPECT_EQ(text(child, "warp.eta"), R"({"texture": "a.png"})") << "the default needs no word";
  for (const auto& [path, key] : {std::pair("warp.color", "\"under\": "), {"weft.color", "\"under_A\": "}})
    EXPECT_NE(text(child, path).find(key), std::string::npos) << text(child, path);
  // Without its parent it is the same cloth, in value and hash.
  const Look again = parse_look(write_look(child), folder.file("c.json"));
  EXPECT_EQ(all_values(again), all_values(child));
  EXPECT_EQ(look_hash(again), look_hash(child));
  EXPECT_EQ(again.weft.A.value.z, 0.3f);
  EXPECT_NE(look_hash(child),
            look_hash(read(color + R"(, "warp": {"k_d": {"texture": "a.png"}, "eta": {"texture": "a.png"}})")));
  // A raw scale over a colour.
  const Look raw = read(R"("inherits": "parent.json", "warp": {"A": {"texture": "a.png", "space": "acescg"}})");
  EXPECT_NE(text(raw, "warp.A").find("under_color"), std::string::npos) << text(raw, "warp.A");
  EXPECT_EQ(text(raw, "warp.color"), "");
  EXPECT_EQ(all_values(parse_look(write_look(raw), folder.file("c.json"))), all_values(raw));
  // Said in one file, and by --set.
  const Look said = read(
      R"("color": {"texture": "a.png", "space": "acescg", "under": [0.1, 0.2, 0.3]}, "warp": {"k_d": {"texture": "a.png", "under": 0.9}})");
  EXPECT_EQ(said.weft.color.value().value.x, 0.1f);
  EXPECT_EQ(said.warp.k_d, 0.9f);
  Look set = said;
  apply_override(set, "warp.k_d=0.25");
  EXPECT_FALSE(set.textures.contains("warp.k_d"));
  EXPECT_EQ(set.warp.k_d, 0.25f);
  apply_override(set, "warp.k_d={\"texture\": \"a.png\"}");
  EXPECT_EQ(set.warp.k_d, 0.25f);
  // The colour of both lies under the texture of one.
  const std::string one = R"("color": [0.3, 0.4, 0.5], "warp": {"color": {"texture": "a.png", "space": "acescg")";
  EXPECT_EQ(read(one + "}}").warp.color.value().value.y, 0.4f);
  EXPECT_EQ(read(one + R"(, "under": [0.6, 0.6, 0.6]}})").warp.color.value().value.y, 0.6f);
  EXPECT_TRUE(read(one + "}}").textures.contains("warp.color"));
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
      {R"({"warp": {"k_d": {"texture": "print.png", "under": 7}}})", "under of the texture of k_d"},
      {R"({"warp": {"k_d": {"texture": "print.png", "under_A": 0.7}}})", "did you mean under?"},
      {R"({"warp": {"k_d": {"texture": "print.png", "under": {"texture": "print.png"}}}})", "expected a plain value"},
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
