#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "base/error.h"
#include "mesh/obj.h"
#include "mesh/subdivide.h"

namespace sateen {
namespace {

const std::string seeds[] = {
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 1\nv 2 1 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "f 1/1 2/2 3/3 4/4\nf 2/1 5/2 6/3 3/4\nt crease 2/1/0 1 2 3.5\nt corner 1/1/0 0 10\nt hole 1/0/0 1\n"
    "t interpolateboundary 1/0/0 1\nt facevaryinginterpolateboundary 1/0/0 3\n",
    "\xEF\xBB\xBFo a\r\nv -1 -1 -1\r\nv 1 -1 -1\r\nv 1 1 -1\r\nv -1 1 -1\r\nv 0 0 1\r\nvn 0 0 1\r\nf -5//1 -4//1 "
    "-1//1\r\n"
    "f 2 3 5\r\nf 3 4 5\r\nf 4 1 5\r\nf 4 3 \\\r\n2 1\r\ns off\r\ng x y\r\n",
    "v 0 0 0\nv 1 0 .1\nv 2 .5 0\nv 1 1 0\nv 0 1 0\nv -1 .5 0\nv .5 .5 1e0\nf 1 2 3 4 5 6\nf 1 7 2\nf 1 2 4\n",
};

std::string mutate(const std::string& seed, std::mt19937_64& random) {
  std::string text = seed;
  const auto below = [&](size_t n) { return size_t(random() % std::max<size_t>(n, 1)); };
  static const std::string pieces[] = {"-",       "0",
                                       "9",       "e",
                                       "1e15",    "nan",
                                       "/",       "//",
                                       " ",       "\n",
                                       "\\\n",    "\r",
                                       "#",       "t crease 2/1/0 ",
                                       "f ",      "v ",
                                       "vt ",     "99999999999999999999",
                                       "-1",      ".",
                                       "\xFF",    "t hole 1/0/0 0\n",
                                       "1 1 1\n", "-9223372036854775808",
                                       "\x1a"};
  for (size_t edits = 1 + below(6); edits > 0; --edits) {
    const size_t at = below(text.size());
    switch (below(5)) {
      case 0:
        text.erase(at, 1 + below(8));
        break;
      case 1:
        text.insert(at, pieces[below(std::size(pieces))]);
        break;
      case 2:
        text[at] = char(random() & 0xff);
        break;
      case 3:
        text.insert(at, text.substr(below(text.size()), below(40)));
        break;
      default:
        text[at] = char('0' + below(10));
        break;
    }
    if (text.empty()) text = "v";
  }
  return text;
}

// Whatever the text, either an InputError with a text or a mesh that can be rendered: no crash, no NaN.
TEST(ObjFuzz, MutatedFilesAreRefusedOrGiveAFiniteMesh) {
  const int rounds = std::getenv("SATEEN_LONG_TESTS") ? 2'000'000 : 20'000;
  std::mt19937_64 random(7);
  int good = 0, refused = 0;
  for (int i = 0; i < rounds; ++i) {
    const std::string text = mutate(seeds[size_t(i) % std::size(seeds)], random);
    try {
      const ControlMesh cage = parse_obj(text, "fuzz.obj");
      const Mesh mesh = subdivide(cage, i % 3, 1);
      ASSERT_FALSE(mesh.quads.empty()) << text;
      for (size_t v = 0; v < mesh.positions.size(); ++v) {
        ASSERT_TRUE(std::isfinite(mesh.positions[v].length())) << text;
        ASSERT_NEAR(mesh.normals[v].length(), 1, 1e-5) << text;
        ASSERT_GT(mesh.dpdu[v].length(), 0) << text;
      }
      ++good;
    } catch (const InputError& e) {
      ASSERT_GT(std::string(e.what()).size(), 10u);
      ++refused;
    }
  }
  EXPECT_GT(good, rounds / 20);
  EXPECT_GT(refused, rounds / 20);
}

}  // namespace
}  // namespace sateen
