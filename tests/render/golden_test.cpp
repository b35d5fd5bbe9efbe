#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "image/color.h"
#include "look/read.h"
#include "render/pictures.h"
#include "scene/compile_cloth.h"
#include "statistics/z_test.h"

// A golden picture of every look: means and mean squares of blocks of pixels, kept with their standard errors in
// tests/render/golden/LOOK.json. A change of the sampling moves them by chance and passes; a change of the picture
// does not. False alarms: 1e-3 over all looks together.
//
// After a change of a look, of the drape, of the studio map or of the cloth model that is meant, make them anew:
//
//     SATEEN_UPDATE_GOLDEN=1 build/bin/test_render --gtest_filter='Golden*'
//
// SATEEN_UPDATE_GOLDEN=missing makes those of new looks alone.

namespace sateen_test {
namespace {

using namespace sateen;
namespace fs = std::filesystem;

constexpr int width = 48, height = 27, block_width = 8, block_height = 9, batches = 16, spp = 16;
constexpr int blocks = (width / block_width) * (height / block_height);
const char* const again =
    "make it anew if the change is meant: SATEEN_UPDATE_GOLDEN=1 build/bin/test_render --gtest_filter='Golden*'";

fs::path golden_path(const std::string& look) {
  return fs::path(SATEEN_SOURCE_DIR "/tests/render/golden") / (look + ".json");
}

std::vector<std::string> look_names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(SATEEN_SOURCE_DIR "/looks"))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

/// The same place, light and camera for all looks.
Scene& stage() {
  static Scene scene = scene_of(scene_settings("linen_plain", width, height));
  return scene;
}

/// The pixels of a part of the picture: its blocks row by row, and last the whole, which small changes show in.
struct Part {
  int x0, y0, width, height;
};
constexpr int parts = blocks + 1;
Part part(int i) {
  if (i == blocks) return {0, 0, width, height};
  constexpr int across = width / block_width;
  return {i % across * block_width, i / across * block_height, block_width, block_height};
}

/// [part][channel] of the mean and of the mean square of the pixels. Squares are products of two independent batches:
/// free of the noise of either, so that they do not depend on how it was sampled.
struct Golden {
  std::vector<Batches> means = std::vector<Batches>(parts * 3), squares = std::vector<Batches>(parts * 3);
};

Golden measure(const std::string& name) {
  static const ColorManager colors("built-in");
  FabricParts compiled;
  compiled.threads = 2;
  Scene& scene = stage();
  const Look look = read_look(look_path(name));
  std::optional<CompiledSide> back;
  if (!look.back.empty()) back = compile_side(read_back(look), colors, compiled);
  set_sides(scene, compile_side(look, colors, compiled), std::move(back));
  Golden golden;
  std::vector<Color> before;
  for (std::uint32_t b = 0; b < batches; ++b) {
    RenderSettings settings = samples(spp, 1 + b);
    settings.light.strategy = Strategy::mis_compensated;
    Film film(width, height, false);
    EXPECT_EQ(render(scene, settings, film).rays.non_finite, 0) << name;
    std::vector<Color> now;
    for (const FilmPixel& pixel : film.pixels) now.push_back(pixel_mean(pixel));
    for (int i = 0; i < parts; ++i)
      for (int c = 0; c < 3; ++c) {
        double sum = 0, product = 0;
        const Part p = part(i);
        for (int y = p.y0; y < p.y0 + p.height; ++y)
          for (int x = p.x0; x < p.x0 + p.width; ++x) {
            const size_t at = size_t(y * width + x);
            sum += double(now[at][c]);
            if (b % 2) product += double(now[at][c]) * before[at][c];
          }
        golden.means[size_t(i * 3 + c)].add(sum / (p.width * p.height));
        if (b % 2) golden.squares[size_t(i * 3 + c)].add(product / (p.width * p.height));
      }
    before = now;
  }
  return golden;
}

nlohmann::ordered_json to_json(const std::vector<Batches>& all) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  // Six digits: less than a thousandth of any standard error.
  const auto rounded = [](double value) { return std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr); };
  for (const Batches& b : all) out.push_back({rounded(b.mean), rounded(std::sqrt(b.variance_of_mean()))});
  return out;
}

void write_golden(const std::string& look, const Golden& golden) {
  fs::create_directories(golden_path(look).parent_path());
  nlohmann::ordered_json out;
  out["what"] = fmt::format(
      "drape at level 1, studio_softboxes, {} x {} pixels in blocks of {} x {}, {} batches; of "
      "every block, then the whole, and every channel [value, standard error]",
      width, height, block_width, block_height, batches);
  out["means"] = to_json(golden.means);
  out["squares"] = to_json(golden.squares);
  std::string text = out.dump();
  // A line a block keeps differences readable.
  for (size_t at = text.find("],["); at != std::string::npos; at = text.find("],[", at + 1))
    text.replace(at, 3, "],\n[");
  write_text_whole(golden_path(look), text + "\n");
}

std::vector<Batches> from_json(const nlohmann::json& all, int count) {
  std::vector<Batches> out;
  for (const auto& pair : all) {
    Batches b;
    b.count = count;
    b.mean = pair.at(0).get<double>();
    const double error = pair.at(1).get<double>();
    b.squares = error * error * count * (count - 1);
    out.push_back(b);
  }
  return out;
}

void expect_like(const std::vector<Batches>& found, const std::vector<Batches>& kept, double bound,
                 const std::string& what) {
  ASSERT_EQ(found.size(), kept.size()) << what;
  double worst = 0;
  size_t where = 0;
  for (size_t i = 0; i < found.size(); ++i)
    if (const double d = std::abs(difference_deviate(found[i], kept[i])); d > worst) worst = d, where = i;
  const Batches &f = found[where], &k = kept[where];
  EXPECT_LT(worst, bound) << what << ", part " << where / 3 << ", channel " << where % 3 << ": " << f.mean << " +- "
                          << std::sqrt(f.variance_of_mean()) << ", kept " << k.mean << " +- "
                          << std::sqrt(k.variance_of_mean()) << "\n"
                          << again;
}

TEST(GoldenPictures, OfAllLooksAreWhatTheyWere) {
  const std::vector<std::string> names = look_names();
  const char* const asked = std::getenv("SATEEN_UPDATE_GOLDEN");
  const bool update = asked != nullptr, missing_alone = update && std::string(asked) == "missing";
  const double bound = sidak_deviate(1e-3, double(names.size()) * parts * 3 * 2);
  for (const std::string& name : names) {
    if (!update && !fs::exists(golden_path(name))) {
      ADD_FAILURE() << "looks/" << name << ".json has no golden picture: " << again;
      continue;
    }
    if (missing_alone && fs::exists(golden_path(name))) continue;
    const Golden golden = measure(name);
    if (update) {
      write_golden(name, golden);
      continue;
    }
    std::ifstream in(golden_path(name));
    const nlohmann::json kept = nlohmann::json::parse(in);
    expect_like(golden.means, from_json(kept.at("means"), batches), bound, name + ", means");
    expect_like(golden.squares, from_json(kept.at("squares"), batches / 2), bound, name + ", squares");
  }
}

TEST(GoldenPictures, AreOfLooksThatAreThere) {
  const std::vector<std::string> names = look_names();
  if (!fs::exists(golden_path("x").parent_path())) GTEST_SKIP() << "no golden pictures: " << again;
  for (const auto& entry : fs::directory_iterator(golden_path("x").parent_path()))
    EXPECT_TRUE(std::binary_search(names.begin(), names.end(), entry.path().stem().string()))
        << entry.path() << " belongs to no look: remove it";
}

}  // namespace
}  // namespace sateen_test
