#include <fstream>
#include <sstream>

#include "look/describe.h"
#include "look_text.h"

namespace sateen {
namespace {

struct Random {
  std::uint64_t state;
  std::uint32_t next() {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    return std::uint32_t(state >> 32);
  }
  size_t below(size_t n) { return n ? next() % n : 0; }
};

const std::vector<std::string>& pieces() {
  static const std::vector<std::string> all{"{",
                                            "}",
                                            "[",
                                            "]",
                                            ",",
                                            ":",
                                            "\"",
                                            "\\",
                                            "/",
                                            "//",
                                            "/*",
                                            "*/",
                                            "\n",
                                            "\r\n",
                                            "\t",
                                            "-",
                                            "+",
                                            ".",
                                            "e",
                                            "0",
                                            "1e999",
                                            "-1e-999",
                                            "NaN",
                                            "Infinity",
                                            "null",
                                            "true",
                                            "\\u0000",
                                            "\\ud800",
                                            "\\uDC00",
                                            "\xff",
                                            "\xc3",
                                            "\xf0\x9f\xa7\xb5",
                                            std::string(1, '\0'),
                                            "\xef\xbb\xbf",
                                            "\"inherits\": \"velvet\",",
                                            "\"inherits\": \"silk\",",
                                            "\"warp\": {",
                                            "\"A\": [1, 1, 1],",
                                            "\"color\": [0.5, 0.5, 0.5],",
                                            "\"back\": \"linen_plain\",",
                                            "\"lengths\": [1],",
                                            "\"offsets_deg\": [0, 0],",
                                            "9999999999999999999999",
                                            "[[[[[[[[[[[[[[[[",
                                            "\"\"",
                                            "1.",
                                            "01",
                                            "'"};
  return all;
}

std::string mutate(std::string text, Random& random) {
  for (size_t edits = 1 + random.below(4); edits > 0; --edits) {
    const size_t at = random.below(text.size() + 1);
    switch (random.below(6)) {
      case 0:
        text.insert(at, pieces()[random.below(pieces().size())]);
        break;
      case 1:
        text.erase(at, 1 + random.below(8));
        break;
      case 2:
        text.resize(at);
        break;
      case 3:
        if (at < text.size()) text[at] = char(random.next());
        break;
      case 4: {
        const std::string copy = text.substr(at, 1 + random.below(60));
        text.insert(random.below(text.size() + 1), copy);
        break;
      }
      default:
        text.replace(at, std::min<size_t>(text.size() - at, 1 + random.below(4)),
                     pieces()[random.below(pieces().size())]);
    }
  }
  return text;
}

TEST(ReadLook, RefusesOrUnderstandsWhateverItIsGiven) {
  use_source_tree();
  std::vector<std::string> seeds;
  for (const auto& path : shipped_looks()) {
    std::ifstream in(path);
    std::stringstream text;
    text << in.rdbuf();
    seeds.push_back(text.str());
  }
  const int count = std::getenv("SATEEN_LONG_TESTS") ? 2000000 : 20000;
  Random random{2013};
  int understood = 0, refused = 0;
  for (int i = 0; i < count; ++i) {
    const std::string text = mutate(seeds[random.below(seeds.size())], random);
    try {
      const Look look = parse_look(text, SATEEN_SOURCE_DIR "/looks/mutant.json");
      ASSERT_EQ(all_values(parse_look(write_look(look), look.file)), all_values(look)) << text;
      ++understood;
    } catch (const InputError& error) {
      ASSERT_FALSE(error.diagnostics.empty());
      for (const Diagnostic& diagnostic : error.diagnostics) {
        ASSERT_FALSE(diagnostic.message.empty()) << text;
        ASSERT_EQ(diagnostic.message.find("json.exception"), std::string::npos) << diagnostic.message;
        ASSERT_EQ(diagnostic.message.find("syntax error"), std::string::npos) << diagnostic.message;
        ASSERT_LT(diagnostic.message.size(), 400u) << diagnostic.message;
      }
      ++refused;
    }
  }
  // Both happen often enough that neither side goes untested.
  EXPECT_GT(understood, count / 50);
  EXPECT_GT(refused, count / 2);
}

TEST(Overrides, RefuseOrUnderstandWhateverTheyAreGiven) {
  use_source_tree();
  const std::vector<std::string> seeds{"warp.gamma_s_deg=4", "color=[0.1, 0.2, 0.3]", "weft.offsets_deg=-9,0,9",
                                       "title=Silk",         "back=velvet",           "color_space=acescg"};
  Random random{14};
  const int count = std::getenv("SATEEN_LONG_TESTS") ? 500000 : 5000;
  int understood = 0;
  const Look base = read_look("linen_plain");
  for (int i = 0; i < count; ++i) {
    Look look = base;
    try {
      apply_override(look, mutate(seeds[random.below(seeds.size())], random));
      ASSERT_EQ(all_values(parse_look(write_look(look), look.file)), all_values(look));
      ++understood;
    } catch (const InputError& error) {
      ASSERT_FALSE(error.diagnostics.empty());
    }
  }
  EXPECT_GT(understood, count / 50);
}

}  // namespace
}  // namespace sateen
