#pragma once
#include <string>
#include <vector>

#include "look/look.h"

namespace sateen {

/// The look as the text of a look file, every field written out and nothing inherited; parse_look returns the same
/// look, bit by bit, when it is told the same file.
std::string write_look(const Look& look);

/// A field in which two looks differ. Titles, descriptions and sources do not count.
struct FieldDifference {
  std::string path;  ///< "warp.gamma_s_deg"
  std::string a, b;  ///< the values as JSON; empty where one of the looks does not have it
};
std::vector<FieldDifference> diff_looks(const Look& a, const Look& b);

/// 16 hexadecimal digits that are equal for looks which are the same cloth: not the name, file, title, description,
/// source, comments or order of keys. `back` and the pattern's
/// look count by their names alone: add the hashes of those looks too. Textures count by their files' contents:
/// InputError where they cannot be read.
std::string look_hash(const Look& look);

/// JSON Schema (draft 2020-12) of a look file, for editors that complete and check while typing.
std::string look_schema();

/// All fields with range, unit, default and meaning, one a line, for help texts.
std::string look_field_help();

}  // namespace sateen
