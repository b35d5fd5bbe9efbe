#include "mesh/obj.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/files.h"
#include "base/memory.h"
#include "base/text_encoding.h"
#include "mesh/check_cage.h"
#include "mesh/cut_polygon.h"
#include "mesh/obj_groups.h"
#include "mesh/obj_passed_over.h"
#include "mesh/obj_tags.h"
#include "mesh/obj_text.h"
#include "mesh/wanted_placement.h"

namespace sateen {

namespace {

using obj::Count;
using obj::Number;
using obj::Text;

constexpr float too_large = 1e15f;

class Reader {
 public:
  Reader(std::string_view text, const std::string& name) : whole_(text), text_(text, name) { mesh_.name = name; }
  ControlMesh read();

 private:
  bool read_number(std::string_view what, float& value, bool refuse_non_finite = true);
  void read_position();
  void read_uv();
  void read_face();
  bool read_corner(std::string_view word, int& position, int& uv);
  bool read_index(std::string_view word, std::string_view what, size_t count, bool is_uv, int& index);
  void keep_face(int line);
  void cut_faces();
  void move_to_origin();
  void check_forward_indices();
  void drop_bad_uvs();
  void refuse_no_face();
  void warn();

  std::string_view whole_;
  Text text_;
  ControlMesh mesh_;
  obj::Tags tags_;
  std::vector<int> face_positions_, face_uvs_;  // the current face
  bool any_uv_ = false;
  std::vector<int> first_of_face_;  // see Tags::apply
  struct Tangled {
    size_t face, corner;  // of the mesh
    int line;
  };
  std::vector<Tangled> tangled_;  // faces that meet a vertex twice, to be cut when all vertices are known
  std::vector<int> bad_uvs_;
  struct Forward {
    std::string_view word;
    int index;
    bool is_uv;
  };
  std::vector<Forward> forward_;  // positive indices beyond what had been read when they were met
  obj::Groups groups_;
  obj::PassedOver passed_over_;
  Count repeated_, cut_, dropped_, bad_uv_, mixed_uv_;
};

bool Reader::read_number(std::string_view what, float& value, bool refuse_non_finite) {
  const std::string_view word = text_.next_word();
  if (word.empty()) {
    text_.error(word, fmt::format("{} is missing, expected a number", what));
    return false;
  }
  const Number kind = obj::to_float(word, value);
  if (kind == Number::malformed) {
    text_.error(word, fmt::format("{} is '{}', expected a number", what, word.substr(0, 40)));
    return false;
  }
  if (!refuse_non_finite) return true;
  if (kind != Number::good || !(std::abs(value) < too_large)) {
    text_.error(word, fmt::format("{} is {}, expected a finite number below 1e15", what, word.substr(0, 40)));
    return false;
  }
  return true;
}

void Reader::read_position() {
  Vec3 p(0, 0, 0);
  // A position that is wrong still counts, so that later indices are judged as the author meant them.
  if (read_number("x", p.x) && read_number("y", p.y)) read_number("z", p.z);
  mesh_.positions.push_back(p);
}

void Reader::read_uv() {
  Vec2 uv(0, 0);
  if (read_number("u", uv.x, false)) {
    const std::string_view word = text_.next_word();
    if (!word.empty() && obj::to_float(word, uv.y) == Number::malformed)
      text_.error(word, fmt::format("v is '{}', expected a number", word.substr(0, 40)));
  }
  if (!(std::abs(uv.x) < too_large && std::abs(uv.y) < too_large)) {
    bad_uv_.add(text_.line());
    bad_uvs_.push_back(int(mesh_.uvs.size()));
    uv = Vec2(0, 0);
  }
  mesh_.uvs.push_back(uv);
}

bool Reader::read_index(std::string_view word, std::string_view what, size_t count, bool is_uv, int& index) {
  long long value = 0;
  if (!obj::to_integer(word, value)) {
    text_.error(word, fmt::format("{} index is '{}', expected an integer", what, word.substr(0, 40)));
    return false;
  }
  if (value == 0) {
    text_.error(word, fmt::format("{} index is 0, expected 1 or more, or a negative one", what),
                "OBJ counts from 1; -1 is the one read last");
    return false;
  }
  // The least integer has no opposite.
  if (value < -(long long)count) {
    text_.error(word, count == 0 ? fmt::format("{0} index is {1}, but no {0} stands before it", what, value)
                                 : fmt::format("{} index is {}, expected -1 to -{}", what, value, count));
    return false;
  }
  if (value > INT32_MAX) {
    text_.error(word, fmt::format("{} index is {}, expected at most {}", what, value, INT32_MAX));
    return false;
  }
  index = value > 0 ? int(value - 1) : int((long long)count + value);
  if (value > (long long)count) forward_.push_back({word, index, is_uv});
  return true;
}

bool Reader::read_corner(std::string_view word, int& position, int& uv) {
  // The one hot spot for indices: plain `v`, `v/vt`, `v//vn`, `v/vt/vn`. The normal's index is not looked at.
  const size_t slash = word.find('/');
  if (!read_index(word.substr(0, slash), "vertex", mesh_.positions.size(), false, position)) return false;
  uv = -1;
  if (slash == std::string_view::npos) return true;
  const std::string_view rest = word.substr(slash + 1);
  const std::string_view second = rest.substr(0, rest.find('/'));
  return second.empty() || read_index(second, "texture coordinate", mesh_.uvs.size(), true, uv);
}

void Reader::read_face() {
  face_positions_.clear();
  face_uvs_.clear();
  const int line = text_.line();
  std::string_view first, last;
  bool good = true, with_uv = false, without_uv = false;
  for (std::string_view word = text_.next_word(); !word.empty(); word = text_.next_word()) {
    if (first.empty()) first = word;
    last = word;
    int position = 0, uv = -1;
    good = read_corner(word, position, uv) && good;
    (uv < 0 ? without_uv : with_uv) = true;
    face_positions_.push_back(position);
    face_uvs_.push_back(uv);
  }
  if (face_positions_.size() < 3) {
    const std::string_view words =
        first.empty() ? last : std::string_view(first.data(), size_t(last.data() + last.size() - first.data()));
    text_.error(first.empty() ? text_.next_word() : words,
                fmt::format("face has {} corner{}, expected at least 3", face_positions_.size(),
                            face_positions_.size() == 1 ? "" : "s"));
    return;
  }
  if (!good) return;
  if (with_uv && without_uv) {
    mixed_uv_.add(line);
    std::fill(face_uvs_.begin(), face_uvs_.end(), -1);
  }
  keep_face(line);
}

void Reader::keep_face(int line) {
  // Corners that repeat their predecessor are dropped; a face that still meets a vertex twice is cut in the end.
  size_t kept = 0;
  const size_t n = face_positions_.size();
  for (size_t i = 0; i < n; ++i) {
    if (face_positions_[i] == face_positions_[i + 1 < n ? i + 1 : 0]) continue;
    face_positions_[kept] = face_positions_[i];
    face_uvs_[kept] = face_uvs_[i];
    ++kept;
  }
  const bool polygon = kept >= 3 && !meets_a_vertex_twice({face_positions_.data(), kept});
  if (!polygon)
    tangled_.push_back({mesh_.face_sizes.size(), mesh_.position_indices.size(), line});
  else if (kept < n)
    repeated_.add(line);
  mesh_.face_sizes.push_back(int(kept));
  mesh_.position_indices.insert(mesh_.position_indices.end(), face_positions_.begin(),
                                face_positions_.begin() + long(kept));
  any_uv_ = any_uv_ || (kept > 0 && face_uvs_[0] >= 0);
  // Filled late: a file without texture coordinates pays nothing for them.
  if (any_uv_) {
    mesh_.uv_indices.resize(mesh_.position_indices.size() - kept, -1);
    mesh_.uv_indices.insert(mesh_.uv_indices.end(), face_uvs_.begin(), face_uvs_.begin() + long(kept));
  }
}

/// Cuts or drops the faces that meet a vertex twice; those behind them move.
void Reader::cut_faces() {
  if (tangled_.empty()) return;
  std::vector<int> sizes, positions, uvs;
  sizes.swap(mesh_.face_sizes);
  positions.swap(mesh_.position_indices);
  uvs.swap(mesh_.uv_indices);
  const auto corner_at = [&](size_t i) { return PolygonCorner{positions[i], any_uv_ ? uvs[i] : -1}; };
  const auto add = [&](const std::vector<PolygonCorner>& face) {
    mesh_.face_sizes.push_back(int(face.size()));
    for (const PolygonCorner& c : face) {
      mesh_.position_indices.push_back(c.vertex);
      if (any_uv_) mesh_.uv_indices.push_back(c.uv);
    }
  };
  // Twenty polygons of a thousand corners, or a hundred thousand of ten: a second or two.
  constexpr double most_effort = 2e7;
  double effort = 0;
  // A vertex that one face alone has is a sharp corner; in several pieces of that face it would be a round one.
  constexpr float sharpest = 10;
  std::vector<int> only_face(mesh_.positions.size(), -1);  // -2: several
  size_t at = 0;
  for (size_t i = 0; i < sizes.size(); ++i)
    for (const size_t end = at + size_t(sizes[i]); at < end; ++at) {
      int& only = only_face[size_t(positions[at])];
      only = only == -1 || only == int(i) ? int(i) : -2;
    }
  at = 0;
  std::vector<PolygonCorner> face;
  auto tangled = tangled_.begin();
  for (size_t i = 0; i < sizes.size(); ++i) {
    first_of_face_.push_back(int(mesh_.face_sizes.size()));
    face.clear();
    for (int k = 0; k < sizes[i]; ++k) face.push_back(corner_at(at++));
    if (tangled == tangled_.end() || tangled->face != i) {
      add(face);
      continue;
    }
    for (const PolygonCorner& c : face)
      if (only_face[size_t(c.vertex)] == int(i)) mesh_.corners.push_back({c.vertex, sharpest});
    effort += double(face.size()) * double(face.size());
    std::vector<std::vector<PolygonCorner>> pieces;
    if (effort <= most_effort) pieces = cut_polygon(std::move(face), mesh_.positions);
    for (const std::vector<PolygonCorner>& piece : pieces) add(piece);
    (pieces.empty() ? dropped_ : cut_).add(tangled->line);
    ++tangled;
  }
  first_of_face_.push_back(int(mesh_.face_sizes.size()));
}

/// Far from the origin floats round away what the file says: there positions are read anew, in double.
void Reader::move_to_origin() {
  const Vec3d origin = wanted_placement(mesh_).origin;
  if (origin == Vec3d(0)) return;
  mesh_.placement.origin = origin;
  Text text(whole_, mesh_.name);
  size_t vertex = 0;
  while (vertex < mesh_.positions.size() && text.next_line()) {
    if (text.next_word() != "v") continue;
    Vec3d p(0);
    for (int k = 0; k < 3; ++k) obj::to_double(text.next_word(), p[k]);
    mesh_.positions[vertex++] = Vec3(p - origin);
  }
}

void Reader::check_forward_indices() {
  for (const Forward& f : forward_) {
    const size_t count = f.is_uv ? mesh_.uvs.size() : mesh_.positions.size();
    if (size_t(f.index) < count || text_.gave_up()) continue;
    const std::string_view what = f.is_uv ? "texture coordinate" : "vertex";
    text_.error_anywhere(f.word, count == 0 ? fmt::format("{} index is {}, but the file holds none", what, f.word)
                                            : fmt::format("{} index is {}, expected 1 to {}", what, f.word, count));
  }
}

void Reader::drop_bad_uvs() {
  if (bad_uvs_.empty() || !any_uv_) return;
  std::vector<char> bad(mesh_.uvs.size(), 0);
  for (const int i : bad_uvs_) bad[size_t(i)] = 1;
  size_t at = 0;
  for (const int size : mesh_.face_sizes) {
    const auto begin = mesh_.uv_indices.begin() + long(at), end = begin + size;
    if (std::any_of(begin, end, [&](int i) { return i >= 0 && bad[size_t(i)]; })) std::fill(begin, end, -1);
    at += size_t(size);
  }
}

void Reader::refuse_no_face() {
  if (dropped_.count == 0) passed_over_.complain_of_no_face(text_, mesh_.name, mesh_.positions.size());
  throw InputError(
      fmt::format("{}:{}: no face is left: {}", mesh_.name, dropped_.first_line,
                  dropped_.count == 1
                      ? "its only one meets a vertex twice and crosses itself, has no area or is too "
                        "large to cut"
                      : fmt::format("all {} meet a vertex twice and cross themselves, have no area or are "
                                    "too large to cut",
                                    dropped_.count)),
      "name each vertex of a face once, in the order around it");
}

void Reader::warn() {
  std::vector<std::string>& warnings = mesh_.warnings;
  const auto tell = [&](const Count& count, const char* thing, const char* one, const char* many) {
    count.warn(mesh_.name, thing, one, many, warnings);
  };
  tell(repeated_, "face", "repeats a corner: the repetition was dropped",
       "repeat a corner: the repetition was dropped");
  tell(cut_, "face", "meets a vertex twice, as around a hole: it was cut into simple ones",
       "meet a vertex twice, as around a hole: they were cut into simple ones");
  tell(dropped_, "face",
       "meets a vertex twice and crosses itself, has no area or is too large to cut: it was dropped",
       "meet a vertex twice and cross themselves, have no area or are too large to cut: they were dropped");
  tell(mixed_uv_, "face", "has UVs at some corners only: its UVs were dropped",
       "have UVs at some corners only: their UVs were dropped");
  tell(bad_uv_, "texture coordinate", "is not finite or reaches 1e15: the faces that use it lost their UVs",
       "are not finite or reach 1e15: the faces that use them lost their UVs");
  passed_over_.warn(mesh_.name, warnings);
  if (const std::string told = groups_.told(); !told.empty()) warnings.push_back(mesh_.name + ": " + told);
}

ControlMesh Reader::read() {
  while (!text_.gave_up() && text_.next_line()) {
    if (text_.line_too_long()) {
      const std::string_view word = text_.next_word();
      if (!word.empty()) text_.error(word.substr(0, 1), "line is longer than 1 MiB");  // no word: a comment
      continue;
    }
    const std::string_view key = text_.next_word();
    if (key.empty()) continue;
    if (key == "v") {
      read_position();
    } else if (key == "vt") {
      read_uv();
    } else if (key == "f" || key == "fo") {
      read_face();
      groups_.add_face();
    } else if (key == "t") {
      tags_.read(text_);
    } else if (key == "usemtl" || key == "g" || key == "o") {
      groups_.begin(key, text_);
    } else {
      passed_over_.read(key, text_);
    }
  }
  // Indices are ints from here on.
  if (std::max({mesh_.positions.size(), mesh_.uvs.size(), mesh_.position_indices.size()}) > size_t(INT32_MAX))
    throw InputError(
        fmt::format("{}: holds {} vertices, {} texture coordinates and {} corners of faces, expected at "
                    "most {} of each",
                    mesh_.name, mesh_.positions.size(), mesh_.uvs.size(), mesh_.position_indices.size(), INT32_MAX));
  if (!text_.gave_up()) {
    check_forward_indices();
    if (text_.errors().empty()) {
      if (any_uv_) mesh_.uv_indices.resize(mesh_.position_indices.size(), -1);
      const int file_faces = int(mesh_.face_sizes.size());
      move_to_origin();
      cut_faces();
      tags_.apply(text_, first_of_face_, file_faces, mesh_);
    }
  }
  if (!text_.errors().empty()) throw InputError(InputError::Kind::wrong, std::move(text_.errors()));
  if (mesh_.face_sizes.empty()) refuse_no_face();
  drop_bad_uvs();
  if (!any_uv_) mesh_.uvs.clear();
  warn();
  return std::move(mesh_);
}

}  // namespace

ControlMesh parse_obj(std::string_view text, const std::string& name) {
  if (const std::string complaint = wide_text_complaint(text); !complaint.empty())
    throw InputError(name + ": " + complaint, wide_text_help);
  if (!obj::has_lone_returns(text)) return Reader(text, name).read();
  std::string lines(text);
  obj::end_lines_at_returns(lines);
  return Reader(lines, name).read();
}

ControlMesh read_obj(const std::filesystem::path& path) {
  constexpr std::uint64_t limit = std::uint64_t(16) << 30;
  return name_where_memory_ends(path, [&] {
    std::string text = read_text_file(path, limit);
    obj::end_lines_at_returns(text);  // here, lest parse_obj holds the text twice
    return parse_obj(text, path.string());
  });
}

}  // namespace sateen
