#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "mesh/obj_text.h"

namespace sateen::obj {

/// Things of one kind, by number, with the place of the first.
struct Count {
  int count = 0, first_line = 0;
  void add(int line) {
    if (count++ == 0) first_line = line;
  }
  /// Adds "NAME:LINE: 2 THINGs MANY" to the warnings where there are any.
  void warn(const std::string& name, const char* thing, const char* one, const char* many,
            std::vector<std::string>& warnings) const;
};

/// What an OBJ holds that is no polygon: counted, to be told where it matters. Smoothing groups, normals and the like
/// are not counted, for nothing is missing without them.
class PassedOver {
 public:
  /// Reads the rest of a line that begins with a word that nobody else takes.
  void read(std::string_view key, Text& text);
  /// Throws InputError that says what the file holds instead of faces.
  [[noreturn]] void complain_of_no_face(Text& text, const std::string& name, size_t vertices) const;
  /// Of a file with faces: surfaces and curves that are missing, calls and commands that were not followed.
  void warn(const std::string& name, std::vector<std::string>& warnings) const;

 private:
  struct Kind : Count {
    std::string_view first, argument;  // of the first, parts of the text that is read
  };
  void add(Kind& kind, std::string_view word, Text& text);

  Kind surfaces_, curves_, lines_, points_, calls_, commands_;
  Count unknown_;
};

}  // namespace sateen::obj
