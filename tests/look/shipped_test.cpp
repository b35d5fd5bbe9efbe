#include <gtest/gtest.h>

#include "base/files.h"
#include "look/json.h"
#include "look_text.h"

namespace sateen {
namespace {

struct Row {
  const char* look;
  bool warp;
  float eta, k_d, gamma_s, gamma_v, coverage;
  double color[3], scale;
  std::vector<float> offsets, lengths;
};

// cloth-model.md section 4, A as the product that the table spells.
const std::vector<Row>& table() {
  static const std::vector<Row> rows{
      {"linen_plain", true, 1.46f, .3f, 12, 24, .33f, {.2, .8, 1}, .3, {-25, 25}, {1}},
      {"linen_plain", false, 1.46f, .3f, 12, 24, .33f, {.2, .8, 1}, .3, {-25, 25}, {1}},
      {"silk_crepe_de_chine", true, 1.345f, .2f, 5, 10, .75f, {1, .95, .05}, .12, {-35, -35, 35, 35}, {1, 1, 1}},
      {"silk_crepe_de_chine", false, 1.345f, .3f, 18, 32, .25f, {1, .95, .05}, .16, {0, 0}, {1}},
      {"polyester_satin_charmeuse",
       true,
       1.539f,
       .1f,
       2.5f,
       5,
       .9f,
       {1, .37, .3},
       .035,
       {-32, -32, -18, 0, 0, 18, 32, 32},
       {1.33f, .66f, 2, 2, 2, .66f, 1.33f}},
      {"polyester_satin_charmeuse", false, 1.539f, .7f, 30, 60, .1f, {1, .37, .3}, .2, {0, 0}, {1}},
      {"polyester_satin_charmeuse_back",
       true,
       1.539f,
       .1f,
       2.5f,
       5,
       .67f,
       {1, .37, .3},
       .035,
       {-30, -30, 30, 30, -5, -5, 5, 5},
       {1.33f, 1.33f, 1.33f, 0, .67f, .67f, .67f}},
      {"polyester_satin_charmeuse_back", false, 1.539f, .7f, 30, 60, .33f, {1, .37, .3}, .2, {0, 0}, {3}},
      {"silk_shot", true, 1.345f, .1f, 4, 8, .86f, {.1, 1, .4}, .2, {-25, -25, 25, 25}, {1.33f, 2.67f, 1.33f}},
      {"silk_shot", false, 1.345f, .1f, 5, 10, .14f, {1, 0, .1}, .6, {0, 0}, {1}},
      {"velvet", true, 1.46f, .1f, 6, 12, .5f, {.05, .02, 0}, .3, {-90, -50}, {1}},
      {"velvet", false, 1.46f, .1f, 6, 12, .5f, {.05, .02, 0}, .3, {-90, -55, 55, 90}, {.5f, 0, .5f}},
      {"velvet_red", true, 1.46f, .1f, 6, 12, .5f, {.75, .02, 0}, .3, {-90, -50}, {1}},
      {"velvet_red", false, 1.46f, .1f, 6, 12, .5f, {.55, .02, 0}, .3, {-90, -55, 55, 90}, {.5f, 0, .5f}},
  };
  return rows;
}

TEST(ShippedLooks, CarryTheNumbersOfTheTable) {
  use_source_tree();
  for (const Row& row : table()) {
    const Look look = read_look(SATEEN_SOURCE_DIR "/looks/" + std::string(row.look) + ".json");
    const ThreadFamily& family = row.warp ? look.warp : look.weft;
    SCOPED_TRACE(row.look);
    EXPECT_EQ(family.eta, row.eta);
    EXPECT_EQ(family.k_d, row.k_d);
    EXPECT_EQ(family.gamma_s_deg, row.gamma_s);
    EXPECT_EQ(family.gamma_v_deg, row.gamma_v);
    EXPECT_EQ(family.coverage, row.coverage);
    EXPECT_FALSE(family.color);
    EXPECT_EQ(family.A.space, "");
    for (int i = 0; i < 3; ++i)
      EXPECT_EQ(family.A.value[i], float(std::round(row.color[i] * row.scale * 1e7) * 1e-7)) << i;
    EXPECT_EQ(family.offsets_deg, row.offsets);
    EXPECT_EQ(family.lengths, row.lengths);
    EXPECT_EQ(look.color_space, "lin_rec709");
    EXPECT_EQ(look.masking_width_deg, 20);
    EXPECT_EQ(look.back,
              std::string(row.look) == "polyester_satin_charmeuse" ? "polyester_satin_charmeuse_back" : "");
  }
}

TEST(ShippedLooks, CoverTheFabricsOfTheReferenceVectors) {
  use_source_tree();
  const std::string path = SATEEN_SOURCE_DIR "/../shared/design/cloth-vectors.json";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "the reference vectors are not beside this checkout";
  const JsonDocument vectors = parse_json(read_text_file(path, json_most_bytes), path);
  std::set<std::string> names;
  for (const JsonValue& row : vectors.root.find("rows")->items) names.insert(row.find("fabric")->text);
  EXPECT_FALSE(names.empty());
  for (const std::string& name : names) EXPECT_EQ(error_of([&] { read_look(name); }), "(no error)");
}

TEST(ShippedLooks, AreAtLeastFifteenAndSayWhatTheyAre) {
  use_source_tree();
  EXPECT_GE(shipped_looks().size(), 15u);
  for (const auto& path : shipped_looks()) {
    const Look look = read_look(path.string());
    EXPECT_FALSE(look.title.empty()) << path;
    EXPECT_FALSE(look.description.empty()) << path;
    EXPECT_FALSE(look.source.empty()) << path;
    if (!look.back.empty()) {
      EXPECT_EQ(read_back(look).name, look.back);
    }
  }
}

}  // namespace
}  // namespace sateen
