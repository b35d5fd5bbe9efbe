#pragma once
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "mesh/obj_text.h"

namespace sateen::obj {

/// The parts that a file divides its faces into by `usemtl`, `g` and `o`. They are counted, to be told; only those
/// that hold a face.
class Groups {
 public:
  /// Reads the rest of the line after one of these words.
  void begin(std::string_view key, Text& text);
  void add_face();
  /// "its 3 materials (shell, lining, buttons) are all rendered with one look"; of materials, else objects, else
  /// groups, whichever are several; empty where none are. Names come without control bytes.
  std::string told() const;

 private:
  struct Kind {
    std::unordered_set<std::string_view> met;
    std::vector<std::string_view> first;  // in the order of the file
    std::string_view current;             // parts of the text that is read
    bool has_faces = true;                // of the current part; true: there is none, or it is counted
  };
  Kind materials_, objects_, groups_;
};

}  // namespace sateen::obj
