#include "mesh/obj_tags.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace sateen::obj {

namespace {
constexpr long long most_arguments = 1 << 20;
constexpr float sharpest = 10;  // OpenSubdiv's "infinitely sharp"

bool is_known(std::string_view name) {
  constexpr std::array<std::string_view, 5> known{"crease", "corner", "hole", "interpolateboundary",
                                                  "facevaryinginterpolateboundary"};
  return std::find(known.begin(), known.end(), name) != known.end();
}
}  // namespace

void Tags::read(Text& text) {
  Tag tag;
  tag.name = text.next_word();
  const std::string_view counts = text.next_word();
  std::array<long long, 3> count{};
  bool good = is_known(tag.name);
  for (size_t i = 0, from = 0; good && i < 3; ++i) {
    const size_t to = i < 2 ? counts.find('/', from) : counts.size();
    good = to != std::string_view::npos && to_integer(counts.substr(from, to - from), count[i]) && count[i] >= 0 &&
           count[i] <= most_arguments;
    from = to + 1;
  }
  for (long long i = 0; good && i < count[0]; ++i) {
    long long value = 0;
    const std::string_view word = text.next_word();
    good = to_integer(word, value);
    tag.integers.push_back(value);
    tag.integer_words.push_back(word);
  }
  for (long long i = 0; good && i < count[1]; ++i) {
    float value = 0;
    good = to_float(text.next_word(), value) == Number::good;
    tag.floats.push_back(value);
  }
  const bool wants_float = tag.name == "crease" || tag.name == "corner";
  good = good && !tag.integers.empty() && (!wants_float || !tag.floats.empty()) &&
         (tag.name != "crease" || tag.integers.size() % 2 == 0);
  if (good) {
    tags_.push_back(std::move(tag));
  } else if (ignored_++ == 0) {
    first_ignored_line_ = text.line();
  }
}

void Tags::apply_edges(Text& text, const Tag& tag, ControlMesh& mesh) {
  for (size_t i = 0; i + 1 < tag.integers.size(); i += 2) {
    ControlMesh::Crease crease;
    bool good = true;
    for (size_t k = i; k < i + 2; ++k) {
      const long long vertex = tag.integers[k];
      if (vertex < 0 || vertex >= (long long)mesh.positions.size()) {
        text.error_anywhere(tag.integer_words[k], fmt::format("crease at vertex {}, expected 0 to {}", vertex,
                                                              (long long)mesh.positions.size() - 1));
        good = false;
      } else {
        crease.vertices.push_back(int(vertex));
      }
    }
    // One sharpness for all pairs, one a pair, or (as OpenSubdiv's own reader has it) one a vertex.
    const size_t pairs = tag.integers.size() / 2;
    const size_t which = tag.floats.size() == pairs ? i / 2 : tag.floats.size() > pairs ? i : 0;
    crease.sharpness = std::clamp(tag.floats[std::min(which, tag.floats.size() - 1)], 0.0f, sharpest);
    if (good) mesh.creases.push_back(std::move(crease));
  }
}

void Tags::apply_corners(Text& text, const Tag& tag, ControlMesh& mesh) {
  for (size_t i = 0; i < tag.integers.size(); ++i) {
    const long long vertex = tag.integers[i];
    if (vertex < 0 || vertex >= (long long)mesh.positions.size()) {
      text.error_anywhere(tag.integer_words[i], fmt::format("corner at vertex {}, expected 0 to {}", vertex,
                                                            (long long)mesh.positions.size() - 1));
      continue;
    }
    const float sharpness = tag.floats[std::min(i, tag.floats.size() - 1)];
    mesh.corners.push_back({int(vertex), std::clamp(sharpness, 0.0f, sharpest)});
  }
}

namespace {
// The last of equal edges or vertices counts, as in OpenSubdiv; groups in a file often repeat all tags.
void drop_duplicates(ControlMesh& mesh) {
  std::map<std::pair<int, int>, float> edges;
  for (const ControlMesh::Crease& c : mesh.creases) edges[std::minmax(c.vertices[0], c.vertices[1])] = c.sharpness;
  mesh.creases.clear();
  for (const auto& [edge, sharpness] : edges)
    if (sharpness > 0) mesh.creases.push_back({{edge.first, edge.second}, sharpness});
  std::map<int, float> corners;
  for (const ControlMesh::Corner& c : mesh.corners) corners[c.vertex] = c.sharpness;
  mesh.corners.clear();
  for (const auto& [vertex, sharpness] : corners)
    if (sharpness > 0) mesh.corners.push_back({vertex, sharpness});
  std::sort(mesh.holes.begin(), mesh.holes.end());
  mesh.holes.erase(std::unique(mesh.holes.begin(), mesh.holes.end()), mesh.holes.end());
}
}  // namespace

void Tags::apply(Text& text, const std::vector<int>& first_of_face, int file_faces, ControlMesh& mesh) {
  using Boundary = ControlMesh::Boundary;
  using Fvar = ControlMesh::FvarBoundary;
  constexpr std::array boundaries{Boundary::none, Boundary::edge_and_corner, Boundary::edge_only};
  constexpr std::array fvars{Fvar::none,          Fvar::corners_only, Fvar::corners_plus1,
                             Fvar::corners_plus2, Fvar::boundaries,   Fvar::all};
  for (const Tag& tag : tags_) {
    const auto choose = [&](const auto& choices, auto& field) {
      if (tag.integers[0] >= 0 && size_t(tag.integers[0]) < choices.size())
        field = choices[size_t(tag.integers[0])];
      else
        text.error_anywhere(tag.integer_words[0],
                            fmt::format("{} is {}, expected 0 to {}", tag.name, tag.integers[0], choices.size() - 1));
    };
    if (tag.name == "crease") {
      apply_edges(text, tag, mesh);
    } else if (tag.name == "corner") {
      apply_corners(text, tag, mesh);
    } else if (tag.name == "interpolateboundary") {
      choose(boundaries, mesh.boundary);
    } else if (tag.name == "facevaryinginterpolateboundary") {
      choose(fvars, mesh.fvar_boundary);
    } else {
      for (size_t i = 0; i < tag.integers.size(); ++i) {
        const long long face = tag.integers[i];
        if (face < 0 || face >= file_faces)
          text.error_anywhere(tag.integer_words[i],
                              fmt::format("hole at face {}, expected 0 to {}", face, file_faces - 1));
        else if (first_of_face.empty())
          mesh.holes.push_back(int(face));
        else
          for (int piece = first_of_face[size_t(face)]; piece < first_of_face[size_t(face) + 1]; ++piece)
            mesh.holes.push_back(piece);
      }
    }
  }
  drop_duplicates(mesh);
  if (ignored_)
    mesh.warnings.push_back(fmt::format("{}:{}: {} tag{} not understood and ignored", mesh.name, first_ignored_line_,
                                        ignored_, ignored_ == 1 ? "" : "s"));
}

}  // namespace sateen::obj
