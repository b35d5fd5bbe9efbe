#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "math/vector.h"

// Meshes that must come out sound, or be refused with a text, wherever they are used.

namespace sateen::torture {

inline std::string polygon(int corners, float radius, float z) {
  std::string text;
  for (int i = 0; i < corners; ++i) {
    const float a = 2 * pi * float(i) / float(corners);
    text += fmt::format("v {} {} {}\n", radius * std::cos(a), radius * std::sin(a), z);
  }
  return text;
}

inline std::string numbered_face(int first, int count) {
  std::string text = "f";
  for (int i = 0; i < count; ++i) text += fmt::format(" {}", first + i);
  return text + "\n";
}

inline std::string pole(int valence) {
  std::string text = "v 0 0 0.3\n" + polygon(valence, 1, 0);
  for (int i = 0; i < valence; ++i) text += fmt::format("f 1 {} {}\n", i + 2, (i + 1) % valence + 2);
  return text;
}

inline std::string moebius(int pieces) {
  std::string text;
  for (int i = 0; i < pieces; ++i) {
    const float a = 2 * pi * float(i) / float(pieces);
    for (const float side : {-0.3f, 0.3f}) {
      const float r = 1 + side * std::cos(a / 2);
      text += fmt::format("v {} {} {}\n", r * std::cos(a), r * std::sin(a), side * std::sin(a / 2));
    }
  }
  for (int i = 0; i + 1 < pieces; ++i)
    text += fmt::format("f {} {} {} {}\n", 2 * i + 1, 2 * i + 3, 2 * i + 4, 2 * i + 2);
  return text + fmt::format("f {} 2 1 {}\n", 2 * pieces - 1, 2 * pieces);
}

/// A bent sheet of 4 by 4 quads with UVs: v -> v * scale + offset, uv by `chart`.
template <class Chart>
std::string sheet(double scale, double offset, const Chart& chart) {
  std::string text;
  for (int i = 0; i < 25; ++i) {
    const double x = i % 5, y = i / 5;
    text += fmt::format("v {} {} {}\n", x * scale + offset, y * scale + offset, std::sin(x) * scale + offset);
    text += fmt::format("vt {}\n", chart(x, y));
  }
  for (int i = 0; i < 16; ++i) {
    const int v = i / 4 * 5 + i % 4 + 1;
    text += fmt::format("f {0}/{0} {1}/{1} {2}/{2} {3}/{3}\n", v, v + 1, v + 6, v + 5);
  }
  return text;
}
inline std::string plain(double x, double y) {
  return fmt::format("{} {}", x / 4, y / 4);
}

/// A book: sheets around one edge, the page `twice` written two times.
inline std::string fan(int sheets, int twice) {
  std::string text = "v 0 0 0\nv 0 1 0\n", faces;
  for (int i = 0; i < sheets; ++i) {
    const float a = 2 * pi * float(i) / float(sheets);
    text += fmt::format("v {0} 0 {1}\nv {0} 1 {1}\n", std::cos(a), std::sin(a));
    const std::string face = fmt::format("f 1 {} {} 2\n", 2 * i + 3, 2 * i + 4);
    faces += i == twice ? face + face : face;
  }
  return text + faces;
}

inline const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
inline const std::string cube =
    "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

struct Case {
  std::string name, text;
  bool refused_by_opensubdiv = false;
};

inline std::vector<Case> cases() {
  std::string random_soup;
  std::mt19937 random(3);
  for (int i = 0; i < 60; ++i)
    random_soup +=
        fmt::format("v {} {} {}\n", double(random()) / 4e9, double(random()) / 4e9, double(random()) / 4e9);
  for (int i = 0; i < 200; ++i)
    random_soup +=
        fmt::format("f {} {} {} {}\n", random() % 60 + 1, random() % 60 + 1, random() % 60 + 1, random() % 60 + 1);
  return {
      {"one triangle", square + "f 1 2 3\n"},
      {"one quad", square + "f 1 2 3 4\n"},
      {"zero area, all in one point", "v 1 1 1\nv 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3 4\n"},
      {"zero area, all on a line", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nf 1 2 3 4\nf 1 2 3\n"},
      {"sliver of 1e-20", "v 0 0 0\nv 1 0 0\nv 0.5 1e-20 0\nf 1 2 3\n"},
      {"tiny triangle of 1e-20", "v 0 0 0\nv 1e-20 0 0\nv 0 1e-20 0\nf 1 2 3\n"},
      {"tiny triangle beside a large one", "v 0 0 0\nv 1e-20 0 0\nv 0 1e-20 0\nv 9 0 0\nv 0 9 0\nf 1 2 3\nf 1 4 5\n"},
      {"duplicate faces", square + "f 1 2 3 4\nf 1 2 3 4\nf 2 3 4 1\n"},
      {"coplanar overlapping faces", square + "v 0.5 0.5 0\nv 2 0.5 0\nv 2 2 0\nf 1 2 3 4\nf 5 6 7\n"},
      {"equal UVs", sheet(1, 0, [](double, double) { return "0.5 0.5"; })},
      {"zero UVs", sheet(1, 0, [](double, double) { return "0 0"; })},
      {"UVs on a line", sheet(1, 0, [](double x, double) { return fmt::format("{} 0", x); })},
      {"UVs that are not numbers", sheet(1, 0, [](double x, double y) { return x == 2 ? "nan inf" : plain(x, y); })},
      {"huge UVs", sheet(1, 0, [](double x, double y) { return fmt::format("{} {}", x * 1e14, y * 1e14); })},
      {"UVs far from the origin", sheet(1, 0, [](double x, double y) { return fmt::format("{} {}", x + 1e5, y); })},
      {"no UVs", cube},
      {"mirrored UVs", sheet(1, 0, [](double x, double y) { return fmt::format("{} {}", std::abs(x - 2), y); })},
      {"flipped faces", square + "v 2 0 0\nv 2 1 0\nf 1 2 3 4\nf 2 3 6 5\n"},
      {"non-manifold fan", "v 0 0 0\nv 0 0 1\nv 1 0 0\nv 0 1 0\nv -1 0 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\n"},
      {"bow-tie vertex", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv -1 0 0\nv -1 -1 0\nf 1 2 3\nf 1 4 5\n"},
      {"bow-tie quad", "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n"},
      {"T-junction", square + "v 1 0.5 0\nv 2 0 0\nv 2 0.5 0\nv 2 1 0\nf 1 2 3 4\nf 2 6 7 5\nf 5 7 8 3\n"},
      {"unwelded seam", square + "v 1 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nf 1 2 3 4\nf 5 6 7 8\n"},
      {"edge of zero length", "v 0 0 0\nv 1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n"},
      {"n-gon of 1,000", polygon(1000, 1, 0) + numbered_face(1, 1000)},
      {"n-gon of 5,000", polygon(5000, 1, 0) + numbered_face(1, 5000)},
      {"concave", "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nf 1 2 3 4 5\n"},
      {"pole of valence 360", pole(360)},
      {"pole of valence 3,000", pole(3000)},
      {"n-gon of 70,000", polygon(70000, 1, 0) + numbered_face(1, 70000), true},
      {"two faces around a vertex", square + "v 2 0 1\nv 2 1 1\nf 1 2 3 4\nf 2 1 5 6 3\nt crease 2/1/0 1 2 3.5\n"},
      {"two faces around a vertex with a dart",
       square + "v 2 0 1\nv 2 1 1\nf 1 2 3 4\nf 2 1 5 6 3\nt crease 2/1/0 1 2 10\n"},
      {"pillow", square + "f 1 2 3 4\nf 4 3 2 1\n"},
      {"isolated vertices", square + "v 5e14 0 0\nv 7 7 7\nf 1 2 3 4\n"},
      {"Moebius strip", moebius(12)},
      {"1e-6 in size", sheet(1e-6, 0, plain)},
      {"1e6 in size", sheet(1e6, 0, plain)},
      {"1e-30 in size", sheet(1e-30, 0, plain)},
      {"2e14 in size", sheet(2e14, 0, plain)},
      {"1e6 from the origin", sheet(1, 1e6, plain)},
      {"1e9 from the origin, collapsed by rounding", sheet(1, 1e9, plain)},
      {"all kinds of creases", cube + "t crease 4/2/0 0 1 1 2 10 0.5\nt corner 2/2/0 0 6 10 1.5\n"},
      {"every edge sharp", cube + "t crease 24/1/0 0 1 1 2 2 3 3 0 4 5 5 6 6 7 7 4 0 4 1 5 2 6 3 7 10\n"},
      {"a crease where no edge is", cube + "t crease 2/1/0 0 6 10\n"},
      {"holes", cube + "t hole 2/0/0 0 1\n"},
      {"nothing but holes", square + "f 1 2 3 4\nt hole 1/0/0 0\n"},
      {"no boundary interpolation, nothing left", square + "f 1 2 3 4\nt interpolateboundary 1/0/0 0\n"},
      {"fan of 12 faces, one twice", fan(12, 3)},
      {"fan of 50 faces, one twice", fan(50, 7)},
      {"two poles that meet in one point",
       pole(5) + "v 0 0 0.9\nv 0.4 0 0.9\nv 0 0.4 0.9\nv -0.4 -0.4 0.9\n" + "f 1 8 9\nf 1 9 10\nf 1 10 8\n"},
      {"soup", random_soup},
  };
}

/// Patches of all that no surface is, glued together at random: books, pillows, faces written twice or turned about,
/// bow-ties, poles, polygons, with creases, corners, holes and texture coordinates. The same number gives the same.
inline std::string random_mesh(std::uint32_t number) {
  std::mt19937 random(number);
  const auto below = [&](int n) { return int(random() % std::uint32_t(n)); };
  std::string text, faces;
  int vertices = 0, count = 0;
  const bool with_uvs = below(2) == 0;
  const auto vertex = [&](float x, float y, float z) {
    text += fmt::format("v {} {} {}\nvt {} {}\n", x, y, z, x + z * 0.3f, y);
    return ++vertices;
  };
  const auto jitter = [&] { return float(below(1000)) * 0.001f; };
  // One after the other: the order in which a call's arguments are made is the compiler's.
  const auto anywhere = [&] {
    const float x = jitter(), y = jitter(), z = jitter();
    return vertex(x, y, z);
  };
  // Some vertex that there is, or a new one.
  const auto some = [&] { return vertices > 0 && below(3) > 0 ? 1 + below(vertices) : anywhere(); };
  const auto face = [&](std::vector<int> corners) {
    for (size_t i = 0; i < corners.size(); ++i)
      for (size_t j = i + 1; j < corners.size(); ++j)
        if (corners[i] == corners[j]) corners[j] = anywhere();
    const int times = below(6) == 0 ? 2 : 1;
    for (int n = 0; n < times; ++n) {
      faces += "f";
      for (const int c : corners)
        faces += with_uvs && below(40) > 0 ? fmt::format(" {0}/{0}", c) : fmt::format(" {}", c);
      faces += "\n";
      ++count;
      if (below(4) == 0) std::reverse(corners.begin(), corners.end());
    }
  };
  const int patches = 1 + below(5);
  for (int patch = 0; patch < patches; ++patch) {
    const int kind = below(6), a = some(), b = some();
    if (kind == 0) {  // a book
      const int sheets = 3 + (below(6) == 0 ? below(198) : below(12));
      for (int i = 0; i < sheets; ++i) face({a, b, some(), anywhere()});
    } else if (kind == 1) {  // a pillow
      std::vector<int> corners{a, b};
      for (int i = below(4); i >= 0; --i) corners.push_back(some());
      face(corners);
      std::reverse(corners.begin(), corners.end());
      face(corners);
    } else if (kind == 2) {  // a bow-tie
      for (int i = 2 + below(4); i > 0; --i) face({a, some(), anywhere()});
    } else if (kind == 3) {  // a pole
      const int valence = 3 + below(below(8) == 0 ? 100 : 5);
      std::vector<int> rim;
      for (int i = 0; i < valence; ++i) rim.push_back(anywhere());
      for (int i = 0; i + (below(3) == 0 ? 1 : 0) < valence; ++i)
        face({a, rim[size_t(i)], rim[size_t((i + 1) % valence)]});
    } else if (kind == 4) {  // a strip, perhaps of Moebius
      int p = a, q = b;
      for (int i = 1 + below(6); i > 0; --i) {
        const int r = anywhere(), s = anywhere();
        face({p, q, s, r});
        p = r;
        q = s;
      }
      if (below(2) == 0) face({p, q, a, b});
      if (below(2) == 0) face({p, q, b, a});
    } else {  // a polygon
      std::vector<int> corners{a, b};
      for (int i = 1 + below(below(8) == 0 ? 60 : 6); i > 0; --i) corners.push_back(some());
      face(corners);
    }
  }
  for (int i = below(4); i > 0; --i) {
    const int from = below(vertices), to = below(vertices);
    faces += fmt::format("t crease 2/1/0 {} {} {}\n", from, to, below(21) * 0.5);
  }
  for (int i = below(3); i > 0; --i) {
    const int at = below(vertices);
    faces += fmt::format("t corner 1/1/0 {} {}\n", at, below(21) * 0.5);
  }
  if (below(5) == 0) faces += fmt::format("t hole 1/0/0 {}\n", below(count));
  if (below(4) == 0) faces += fmt::format("t interpolateboundary 1/0/0 {}\n", below(3));
  if (below(4) == 0) faces += fmt::format("t facevaryinginterpolateboundary 1/0/0 {}\n", below(6));
  return text + faces;
}

}  // namespace sateen::torture
