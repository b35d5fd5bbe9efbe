#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "fabric/lobe_values.h"
#include "image/file.h"
#include "look/describe.h"
#include "look/json.h"
#include "look/read.h"
#include "program.h"
#include "scene/environment_file.h"

namespace sateen_test {

namespace {
const std::string cloths = std::string(SATEEN_SOURCE_DIR) + "/tests/fabric/data/cloth_vectors.json";

// Rows of one look of the vectors as a pairs file.
std::vector<const sateen::JsonValue*> rows_of(const sateen::JsonDocument& document, const std::string& look) {
  std::vector<const sateen::JsonValue*> rows;
  for (const sateen::JsonValue& row : document.root.find("rows")->items)
    if (row.find("look")->text == look) rows.push_back(&row);
  return rows;
}
std::string list_text(const sateen::JsonValue& list) {
  std::string text;
  for (const sateen::JsonValue& item : list.items) text += (text.empty() ? "" : ", ") + item.text;
  return "[" + text + "]";
}
}  // namespace

TEST(Lobe, ValuesForPairsAreTheBitsOfTheKernelThatRenders) {
  const Folder folder;
  const sateen::JsonDocument document = sateen::parse_json(read_text(cloths), cloths);
  const auto rows = rows_of(document, "polyester_satin_charmeuse");
  ASSERT_EQ(rows.size(), 20u);
  std::string pairs;
  for (const auto* row : rows)
    pairs += (pairs.empty() ? "" : ",\n") + std::string("{\"note\": 1, \"wi\": ") + list_text(*row->find("wi")) +
             ", \"wo\": " + list_text(*row->find("wo")) + "}";
  write_text(folder / "pairs.json", "{\"rows\": [" + pairs + "]}");
  const Finished run =
      run_sateen({"lobe", "polyester_satin_charmeuse", "--pairs", "pairs.json", "-o", "values.json"}, {folder.path});
  ASSERT_EQ(run.code, 0) << run.err;

  sateen::FabricParts parts;
  const sateen::Fabric fabric = sateen::compile_fabric(
      sateen::read_look(std::string(SATEEN_SOURCE_DIR) + "/looks/polyester_satin_charmeuse.json"), sateen::same_space,
      parts);
  const auto expected =
      sateen::lobe_values(fabric, sateen::FabricSampler::table, sateen::read_lobe_pairs(folder / "pairs.json"));
  const sateen::JsonDocument values = sateen::parse_json(read_text(folder / "values.json"), "values.json");
  const auto& items = values.root.find("rows")->items;
  ASSERT_EQ(items.size(), expected.size());
  for (size_t i = 0; i < items.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double f = items[i].find("f")->items[size_t(c)].number;
      EXPECT_EQ(float(f), expected[i].f_cos[c]);
      const double truth = rows[i]->find("f")->items[size_t(c)].number;
      EXPECT_NEAR(f, truth, std::max(2e-3 * truth, 1e-4));
    }
    EXPECT_EQ(float(items[i].find("pdf")->number), expected[i].pdf);
    EXPECT_GT(expected[i].pdf, 0.0f);
  }
}

TEST(Lobe, TheUniformSamplersDensityIsThatOfTheHemisphere) {
  const Folder folder;
  write_text(folder / "p.json",
             "{\"rows\": [{\"wi\": [0, 0.6, 0.8], \"wo\": [0, 0, 1]}, {\"wi\": [0, 0, -1], \"wo\": [0, 0, 1]}]}");
  const Finished run = run_sateen({"lobe", "silk_shot", "--pairs", "p.json", "--sampler", "uniform"}, {folder.path});
  const sateen::JsonDocument values = sateen::parse_json(run.out, "values");
  EXPECT_FLOAT_EQ(float(values.root.find("rows")->items[0].find("pdf")->number), 0.15915494f);
  EXPECT_EQ(values.root.find("rows")->items[1].find("pdf")->number, 0);
  EXPECT_EQ(values.root.find("rows")->items[1].find("f")->items[0].number, 0);
}

TEST(Lobe, EveryBadRowIsToldWithItsPlace) {
  const Folder folder;
  write_text(folder / "p.json",
             "{\"rows\": [\n{\"wi\": [0, 0, 2], \"wo\": [0, 0, 1]},\n{\"wi\": [0, 1], \"wo\": [0, 0, 1]},\n{\"wi\": "
             "[0, 0, 1]},\n7]}\n");
  const Finished run = run_sateen({"lobe", "silk_shot", "--pairs", "p.json"}, {folder.path});
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(run.out, "");
  for (const char* message :
       {"p.json:2:8: error: wi has the length 2, expected a unit direction",
        "p.json:3:8: error: wi is not a list of three numbers", "p.json:4:1: error: the row has no wo",
        "p.json:5:1: error: the row is not an object with wi and wo"})
    EXPECT_NE(run.err.find(message), std::string::npos) << run.err;
}

TEST(Lobe, PicturesComeAsPngAndSvg) {
  const Folder folder;
  const Finished run = run_sateen({"lobe", "velvet_red", "-o", "a.png"}, {folder.path});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("albedo"), std::string::npos);
  EXPECT_GT(sateen::read_image(folder / "a.png").width, 1000);
  ASSERT_EQ(run_sateen({"lobe", "velvet_red", "-o", "a.svg"}, {folder.path}).code, 0);
  const std::string svg = read_text(folder / "a.svg");
  EXPECT_EQ(svg.rfind("<svg", 0), 0u);
  EXPECT_NE(svg.find("Velvet, red"), std::string::npos);
  EXPECT_LT(svg.size(), 2'000'000u);
  EXPECT_TRUE(is_json(run_sateen({"lobe", "velvet_red", "--json"}).out));
}

TEST(LookCommand, ListNamesEveryShippedLookWithTitleAndDescription) {
  const Finished run = run_sateen({"look", "list"});
  EXPECT_EQ(run.code, 0);
  for (const sateen::LookEntry& entry : sateen::list_looks({std::string(SATEEN_SOURCE_DIR) + "/looks"})) {
    EXPECT_NE(run.out.find(entry.name), std::string::npos) << entry.name;
    EXPECT_NE(run.out.find(sateen::read_look(entry.path.string()).title), std::string::npos) << entry.name;
  }
  EXPECT_TRUE(is_json(run_sateen({"look", "list", "--json"}).out));
}

TEST(LookCommand, CheckPrintsAlbedoByAngleAndNamesWhatPassesOne) {
  const Folder folder;
  write_text(
      folder / "glow.json",
      "{ \"warp\": { \"A\": [3, 1, 0.1], \"coverage\": 0.5 }, \"weft\": { \"A\": [3, 1, 0.1], \"coverage\": 0.5 } }");
  const Finished run = run_sateen({"look", "check", "glow.json", "silk_shot"}, {folder.path});
  EXPECT_EQ(run.code, 0);
  for (const char* angle : {"\n      0  ", "\n     30  ", "\n     45  ", "\n     60  ", "\n     75  ", "\n     85  "})
    EXPECT_NE(run.out.find(angle), std::string::npos) << run.out;
  EXPECT_NE(run.err.find("warning: glow: albedo "), std::string::npos) << run.err;
  EXPECT_NE(run.err.find(" at 0 degrees passes 1"), std::string::npos) << run.err;
  EXPECT_EQ(run.err.find("silk_shot"), std::string::npos) << run.err;
  EXPECT_TRUE(is_json(run_sateen({"look", "check", "silk_shot", "--json"}).out));
}

// What is told of a draft is not lost where textures are read, which have warnings of their own.
TEST(LookCommand, CheckTellsOfADraftBesideTextures) {
  const Folder folder;
  write_text(folder / "d.wif",
             "[WIF]\nVersion=1.1\n[WEAVING]\nRising Shed=yes\n[COLOR TABLE]\n1=999,0,0\n[THREADING]\n1=1\n2=2\n"
             "[TIEUP]\n1=1\n2=2\n[TREADLING]\n1=1\n2=2\n");
  write_text(folder / "a.json",
             "{\"inherits\": \"" SATEEN_SOURCE_DIR "/looks/printed_silk.json\", \"weave\": {\"draft\": \"d.wif\"}}");
  const Finished run = run_sateen({"look", "check", folder / "a.json"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE((run.out + run.err).find("the colours of its threads (COLOR TABLE) are not used yet"), std::string::npos)
      << run.out << run.err;
}

TEST(LookCommand, CheckTellsAllErrorsOfAllFilesAndEndsWithTwo) {
  const Folder folder;
  write_text(folder / "a.json", "{ \"warp\": { \"gamma_s_deg\": 170 } }");
  write_text(folder / "b.json", "{ \"wrap\": {},\n \"weft\": { \"eta\": 9 } }");
  const Finished run = run_sateen({"look", "check", "a.json", "b.json"}, {folder.path});
  EXPECT_EQ(run.code, 2);
  for (const char* place : {"a.json:1:28: error: ", "b.json:1:3: error: ", "b.json:2:19: error: "})
    EXPECT_NE(run.err.find(place), std::string::npos) << run.err;
}

TEST(LookCommand, ResolveTellsTheOriginOfEveryValueAndItsFileStandsAlone) {
  const Folder folder;
  const Finished run = run_sateen({"look", "resolve", "emerald_satin", "--set", "weft.eta=1.6"});
  EXPECT_EQ(run.code, 0);
  EXPECT_NE(run.out.find("emerald_satin.json:"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("champagne_silk_satin.json:"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("--set"), std::string::npos) << run.out;
  write_text(folder / "mine.json", run_sateen({"look", "resolve", "emerald_satin", "--file"}).out);
  EXPECT_EQ(run_sateen({"look", "diff", "mine.json", "emerald_satin"}, {folder.path}).out, "the same cloth\n");
  EXPECT_TRUE(is_json(run_sateen({"look", "resolve", "emerald_satin", "--json"}).out));
}

TEST(LookCommand, DiffShowsBothValues) {
  const Finished run = run_sateen({"look", "diff", "velvet", "velvet_red"});
  EXPECT_EQ(run.code, 0);
  EXPECT_NE(run.out.find("A\n"), std::string::npos) << run.out;
  EXPECT_TRUE(is_json(run_sateen({"look", "diff", "velvet", "velvet_red", "--json"}).out));
  EXPECT_EQ(run_sateen({"look", "diff", "velvet"}).code, 2);
}

TEST(LookCommand, SchemaIsTheLibrarysOwn) {
  const Folder folder;
  ASSERT_EQ(run_sateen({"look", "schema", "-o", "s.json"}, {folder.path}).code, 0);
  EXPECT_EQ(read_text(folder / "s.json"), sateen::look_schema() + "\n");
  EXPECT_TRUE(is_json(run_sateen({"look", "schema"}).out));
}

TEST(EnvCommand, MakesWhatItsDescriptionSaysAndInspectsIt) {
  const Folder folder;
  write_text(folder / "d.json",
             "{ \"size\": [64, 32], \"lights\": [ { \"kind\": \"disc\", \"azimuth_deg\": 90, \"elevation_deg\": 0, "
             "\"width_deg\": 30, \"intensity\": 5 } ] }");
  const Finished made = run_sateen({"env", "make", "d.json", "-o", "d.exr", "-r", "128", "64"}, {folder.path});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(sateen::read_image_info(folder / "d.exr").width, 128);
  const Finished seen = run_sateen({"env", "inspect", "d.exr"}, {folder.path});
  EXPECT_EQ(seen.code, 0);
  EXPECT_NE(seen.out.find("light at azimuth 90, elevation"), std::string::npos) << seen.out;
  EXPECT_TRUE(is_json(run_sateen({"env", "inspect", "d.exr", "--json"}, {folder.path}).out));
  EXPECT_EQ(run_sateen({"env", "make", "d.json"}, {folder.path}).code, 2);
  EXPECT_EQ(run_sateen({"env", "make", "no.json", "-o", "x.exr"}, {folder.path}).code, 3);
}

TEST(EnvCommand, ListNamesTheShippedMaps) {
  const Finished run = run_sateen({"env", "list"});
  for (const char* name : {"low_sun", "overcast", "studio_softboxes", "three_light_rig"})
    EXPECT_NE(run.out.find(name), std::string::npos) << name;
  EXPECT_TRUE(is_json(run_sateen({"env", "list", "--json"}).out));
}

TEST(Check, TellsLooksMeshesAndMapsApartAndWhatIsWrong) {
  const Folder folder;
  write_text(folder / "bad.json", "{ \"warp\": { \"gamma_s_deg\": 170 } }");
  write_text(folder / "bare.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  write_text(folder / "cut.exr", "v/1");
  write_text(folder / "notes.txt", "hello");
  const Finished run =
      run_sateen({"check", "silk_shot", "bad.json", "bare.obj", "overcast", "cut.exr", "notes.txt"}, {folder.path});
  EXPECT_EQ(run.code, 3);
  for (const char* line :
       {"silk_shot: look, good\n", "bad.json: not usable\n", "bare.obj: mesh\n", "  note: it has no UVs",
        "overcast: map, good\n", "cut.exr: not usable\n", "notes.txt: not usable\n"})
    EXPECT_NE(run.out.find(line), std::string::npos) << line << "\n" << run.out;
  EXPECT_NE(run.err.find("bad.json:1:28: error: "), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("notes.txt: neither a look (.json), a mesh (.obj) nor a map"), std::string::npos) << run.err;
  EXPECT_EQ(run_sateen({"check", "silk_shot", "overcast"}).code, 0);
  EXPECT_EQ(run_sateen({"check", "bad.json"}, {folder.path}).code, 2);
  EXPECT_TRUE(is_json(run_sateen({"check", "silk_shot", "bad.json", "--json"}, {folder.path}).out));
}

TEST(Check, TellsOfAMeshWhatItsCountsCountAndWhatARenderLeavesOut) {
  const Folder folder;
  write_text(folder / "triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 9 9\nf 1 2 3\n");
  write_text(folder / "panels.obj",
             "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 0\nv 2 0 1\nv 2 1 1\nv 1 1 0\n"
             "usemtl shell\x1b[31m\nf 1 2 3 4\nusemtl lining\nf 5 6 7 8\n");
  write_text(folder / "book.obj",
             "v 0 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\nv -1 0 0\nv -1 1 0\nv 0 0 1\nv 0 1 1\n"
             "f 1 3 4 2\nf 1 5 6 2\nf 1 7 8 2\n");
  const auto out = [&](const std::vector<std::string>& words) {
    const Finished run = run_sateen(words, {folder.path});
    EXPECT_EQ(run.code, 0);
    return run.out;
  };
  EXPECT_NE(
      out({"check", "triangle.obj"}).find("  cage of 3 vertices (1 more that no face uses), 1 face: 1 triangle\n"),
      std::string::npos);
  const std::string panels = out({"check", "panels.obj"});
  for (const char* line : {"  cage of 8 vertices, 2 faces: 2 quads\n",
                           "  note: its 2 pieces touch along 1 edge but are not joined: a crease shows there; weld "
                           "them on export, or with "
                           "--weld\n",
                           "its 2 materials (shell?[31m, lining) are all rendered with one look\n"})
    EXPECT_NE(panels.find(line), std::string::npos) << line << "\n" << panels;
  const Finished render = run_sateen(tiny({"-m", "panels.obj", "-o", "a.png"}), {folder.path});
  EXPECT_NE(render.err.find("panels.obj: its 2 pieces touch along 1 edge but are not joined"), std::string::npos)
      << render.err;
  const std::string welded = out({"check", "--weld", "panels.obj"});
  EXPECT_NE(welded.find("  welded along 1 edge, 2 vertices fewer\n"), std::string::npos) << welded;
  EXPECT_EQ(welded.find("not joined"), std::string::npos) << welded;
  EXPECT_NE(out({"check", "book.obj"}).find("1 edge where more than two faces meet"), std::string::npos);
}

TEST(Mesh, OfAnotherUpwardAxisIsStoodUp) {
  const Folder folder;
  // A sheet that hangs, its pleats unlike from side to side, written with y and with z upwards; also far away.
  for (const double away : {0.0, 1e5}) {
    std::string y_up, z_up;
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 6; ++i) {
        const double x = i * 0.25, up = away + j * 0.25, depth = 0.125 * (i * i % 5);
        y_up += fmt::format("v {} {} {}\n", x, up, depth);
        z_up += fmt::format("v {} {} {}\n", x, -depth, up);
      }
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 5; ++i) {
        const int k = j * 6 + i + 1;
        for (std::string* text : {&y_up, &z_up}) *text += fmt::format("f {} {} {} {}\n", k, k + 1, k + 7, k + 6);
      }
    write_text(folder / "y.obj", y_up);
    write_text(folder / "z.obj", z_up);
    ASSERT_EQ(run_sateen(tiny({"-m", "y.obj", "-o", "y.png"}), {folder.path}).code, 0);
    ASSERT_EQ(run_sateen(tiny({"-m", "z.obj", "--up", "z", "-o", "z.png"}), {folder.path}).code, 0);
    ASSERT_EQ(run_sateen(tiny({"-m", "z.obj", "-o", "lies.png"}), {folder.path}).code, 0);
    const auto pixels = [&](const char* name) { return sateen::read_image(folder / name).pixels; };
    EXPECT_EQ(pixels("z.png"), pixels("y.png")) << away;
    EXPECT_NE(pixels("lies.png"), pixels("y.png"));
  }
}

}  // namespace sateen_test
