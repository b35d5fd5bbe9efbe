#include "look/describe.h"

#include "look/json.h"
#include "look_text.h"

namespace sateen {
namespace {

TEST(WriteLook, RoundTripsEveryShippedLook) {
  use_source_tree();
  for (const auto& path : shipped_looks()) {
    const Look look = read_look(path.string());
    const Look again = parse_look(write_look(look), look.file);
    EXPECT_EQ(all_values(again), all_values(look)) << path;
    EXPECT_EQ(again.name, look.name);
    EXPECT_EQ(look_hash(again), look_hash(look)) << path;
    EXPECT_EQ(write_look(again), write_look(look)) << path;
  }
}

TEST(WriteLook, RoundTripsRandomLooksBitByBit) {
  use_source_tree();
  std::uint64_t state = 1;
  const auto random = [&](double low, double high) {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    const double u = double(state >> 11) * 0x1p-53;
    return float(std::min(high, std::max(low, low + u * (high - low))));
  };
  for (int i = 0; i < 2000; ++i) {
    Look look;
    look.file = "random.json";
    look.name = "random";
    look.title = "\"quoted\" \\ \n\t\x01 \xe2\x82\xac";
    look.masking_width_deg = random(5, 60);
    look.warp_angle_deg = random(-180, 180);
    look.weave = {{"x..", ".x.", "..x"}, random(0.5, 500), random(0.5, 500), random(0, 0.4), random(0, 1), {}};
    for (ThreadFamily* family : {&look.warp, &look.weft}) {
      family->eta = random(1, 3);
      family->k_d = random(0, 1) * 1e-30f;
      family->gamma_s_deg = random(0.5, 90);
      family->gamma_v_deg = random(0.5, 180);
      family->coverage = random(0.1, 0.5);
      family->A.value = Color(random(0, 100), random(0, 1), random(0, 1e-6));
      if (i % 3 == 0)
        family->color = ColorValue{Color(random(0, 1), random(0, 1), random(0, 1)), i % 2 ? "acescg" : ""};
      if (family->color) family->A = ThreadFamily().A;
      family->offsets_deg = {random(-90, 90), random(-90, 90), random(-90, 90)};
      family->lengths = {random(0.01, 1000), 0};
    }
    const Look again = parse_look(write_look(look), look.file);
    ASSERT_EQ(all_values(again), all_values(look)) << write_look(look);
    ASSERT_EQ(again.warp.k_d, look.warp.k_d);
    ASSERT_EQ(again.warp.A.value, look.warp.A.value);
    ASSERT_EQ(again.weft.offsets_deg, look.weft.offsets_deg);
  }
}

TEST(LookHash, DoesNotSeeCommentsOrderNamesOrRemarks) {
  use_source_tree();
  const Look a =
      parse_look("{\"title\": \"A\", \"warp\": {\"eta\": 1.5, \"k_d\": 0.2}, \"masking_width_deg\": 18}", "a.json");
  const Look b = parse_look(
      "// b\n{\"masking_width_deg\": 1.8e1, \"source\": \"me\", \"warp\": {\"k_d\": 0.20, \"eta\": 15e-1}, \"weft\": "
      "{}}",
      "b.json");
  EXPECT_EQ(look_hash(a), look_hash(b));
  EXPECT_EQ(look_hash(a).size(), 16u);
  EXPECT_TRUE(diff_looks(a, b).empty());
  const Look named =
      parse_look("{\"warp\": {\"color\": {\"value\": [1, 0, 0], \"space\": \"lin_rec709\"}}}", "c.json");
  const Look meant = parse_look("{\"warp\": {\"color\": [1, 0, 0]}}", "d.json");
  EXPECT_EQ(look_hash(named), look_hash(meant));
  EXPECT_TRUE(diff_looks(named, meant).empty());
}

TEST(LookHash, SeesEveryFieldThatChangesTheCloth) {
  use_source_tree();
  const Look look;
  int seen = 0;
  for (const Field& field : fields()) {
    if (field.is_shorthand()) continue;
    Look changed = look;
    visit_member(changed, field, [](auto& member) {
      using Member = std::decay_t<decltype(member)>;
      if constexpr (std::is_same_v<Member, std::string>)
        member += "x";
      else if constexpr (std::is_same_v<Member, float>)
        member = std::nextafter(member, 1000.0f);
      else if constexpr (std::is_same_v<Member, ColorValue>)
        member.value.z = std::nextafter(member.value.z, 1.0f);
      else if constexpr (std::is_same_v<Member, std::optional<ColorValue>>)
        member = ColorValue();
      else if constexpr (std::is_same_v<Member, std::vector<std::string>>)
        member = {"plain"};
      else
        member.back() = std::nextafter(member.back(), 1000.0f);
    });
    EXPECT_EQ(look_hash(changed) != look_hash(look), field.appearance) << field.path;
    EXPECT_EQ(diff_looks(look, changed).empty(), !field.appearance) << field.path;
    ++seen;
  }
  EXPECT_EQ(seen, 32);
}

TEST(LookHash, TellsAllShippedLooksApart) {
  use_source_tree();
  std::map<std::string, std::string> seen;
  for (const auto& path : shipped_looks()) {
    const auto [other, is_new] = seen.emplace(look_hash(read_look(path.string())), path.string());
    EXPECT_TRUE(is_new) << path << " and " << other->second;
  }
}

TEST(DiffLooks, ShowsAnAOnOneSideAndAColorOnTheOther) {
  use_source_tree();
  const Look a = read_look("linen_plain");
  const std::vector<FieldDifference> differences = diff_looks(a, read_look("linen_plain", {"warp.color=.5,.5,.5"}));
  ASSERT_EQ(differences.size(), 2u);
  EXPECT_EQ(differences[0].path, "warp.A");
  EXPECT_EQ(differences[0].a, "[0.06, 0.24, 0.3]");
  EXPECT_EQ(differences[0].b, "");
  EXPECT_EQ(differences[1].path, "warp.color");
  EXPECT_EQ(differences[1].a, "");
  EXPECT_EQ(differences[1].b, "[0.5, 0.5, 0.5]");
}

TEST(LookSchema, HoldsEveryFieldWithItsRangeAndDefault) {
  const JsonDocument schema = parse_json(look_schema(), "schema.json");
  EXPECT_EQ(schema.root.find("$schema")->text, "https://json-schema.org/draft/2020-12/schema");
  const JsonValue* top = schema.root.find("properties");
  const JsonValue* family = schema.root.find("$defs")->find("family")->find("properties");
  const JsonValue* pattern = schema.root.find("$defs")->find("pattern")->find("properties");
  const JsonValue* weave = top->find("weave")->find("properties");
  size_t found = 0;
  for (const Field& field : fields()) {
    const JsonValue* level = field.family              ? family
                             : field.group.empty()     ? top
                             : field.group == "weave" ? weave
                                                       : pattern;
    const JsonValue* property = level->find(field.key);
    ASSERT_TRUE(property) << field.path;
    EXPECT_NE(property->find("description")->text.find(field.help), std::string::npos);
    const std::string initial = field_text(Look(), field);
    EXPECT_EQ(property->find("default") != nullptr, !initial.empty()) << field.path;
    if (field.kind == FieldKind::number) {
      const JsonValue* number = field.mappable ? &property->find("anyOf")->items[0] : property;
      EXPECT_EQ(number->find("minimum")->number, field.low);
      EXPECT_EQ(number->find("maximum")->number, field.high);
      EXPECT_EQ(property->find("default")->text, initial);
    }
    found += field.group != "weft";
  }
  // And $schema, inherits, pattern, warp, weft, weave.
  EXPECT_EQ(top->items.size() + family->items.size() + pattern->items.size() + weave->items.size(), found + 6);
  EXPECT_FALSE(schema.root.find("additionalProperties")->boolean);
}

TEST(LookFieldHelp, HasALineForEveryField) {
  const std::string help = look_field_help();
  for (const Field& field : fields())
    EXPECT_NE(help.find("\n" + field.path + " "), field.path == "title" ? 0 : std::string::npos) << field.path;
  EXPECT_NE(help.find("(0.5 to 90 degrees, default 12)"), std::string::npos) << help;
}

TEST(Fields, HaveTheDefaultsOfTheStructInsideTheirRanges) {
  use_source_tree();
  const Look look;
  EXPECT_EQ(error_of([&] { parse_look(write_look(look), ""); }), "(no error)");
  EXPECT_EQ(all_values(parse_look("{}", "")), all_values(look));
}

}  // namespace
}  // namespace sateen
