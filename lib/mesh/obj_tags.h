#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "mesh/control_mesh.h"
#include "mesh/obj_text.h"

namespace sateen::obj {

/// The `t` lines of OpenSubdiv's OBJ dialect: `t NAME ints/floats/strings values...`, indices from 0. Collected while
/// the file is read and applied when all vertices and faces are known. Tags that repeat are merged.
class Tags {
 public:
  /// Reads the rest of the current line. Malformed or unknown tags are counted, not refused: other programs write
  /// lines that begin with t too.
  void read(Text& text);
  /// `first_of_face[i]` is the place in the cage of the first piece of the file's face i, with one past the last;
  /// empty: each face is its own piece.
  void apply(Text& text, const std::vector<int>& first_of_face, int file_faces, ControlMesh& mesh);

 private:
  struct Tag {
    std::string_view name;
    std::vector<long long> integers;
    std::vector<std::string_view> integer_words;
    std::vector<float> floats;
  };
  void apply_edges(Text& text, const Tag& tag, ControlMesh& mesh);
  void apply_corners(Text& text, const Tag& tag, ControlMesh& mesh);

  std::vector<Tag> tags_;
  int ignored_ = 0, first_ignored_line_ = 0;
};

}  // namespace sateen::obj
