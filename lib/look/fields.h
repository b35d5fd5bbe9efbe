#pragma once
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "look/look.h"

namespace sateen {

/// What a field holds, and so how it is written in a look file.
enum class FieldKind {
  text,       ///< any text
  name,       ///< a text that is not empty
  look_name,  ///< the name or path of another look, or an empty text
  number,     ///< one number
  color,      ///< [r, g, b] or {"value": [r, g, b], "space": "..."}
  numbers,    ///< a list of numbers
  draft       ///< a text or a list of texts that parse_draft or a WIF file explains; an empty text for none
};

/// Stands for the same member of both families at once; a field with it sets values and never holds one.
struct OfBothFamilies {
  std::optional<ColorValue> ThreadFamily::*member;
};

using FieldMember =
    std::variant<std::string Look::*, float Look::*, float ThreadFamily::*, ColorValue ThreadFamily::*,
                 std::optional<ColorValue> ThreadFamily::*, std::vector<float> ThreadFamily::*, float WeaveSettings::*,
                 std::vector<std::string> WeaveSettings::*, OfBothFamilies>;

/// One parameter of a look. Reading, writing, ranges, help, schema, hash, diff and --set all go through these.
struct Field {
  std::string path;  ///< "warp.gamma_s_deg", "masking_width_deg"
  std::string key;   ///< the last part of the path
  std::string group;  ///< the part before it: "pattern", "warp", "weft", "weave"; empty at the top level
  FieldKind kind = FieldKind::text;
  ThreadFamily Look::*family = nullptr;  ///< null but for the fields of a family
  FieldMember member;
  double low =
      -std::numeric_limits<double>::infinity();  ///< bounds of a number, of each number of a list, of a channel
  double high = std::numeric_limits<double>::infinity();
  std::string unit;        ///< "degrees" or empty
  std::string help;        ///< one sentence without its period
  bool appearance = true;  ///< part of the hash and of differences
  bool inherited = true;   ///< false: each file says it for itself
  bool mappable = false;   ///< a texture may stand in place of the value

  bool is_shorthand() const { return std::holds_alternative<OfBothFamilies>(member); }
};

/// Numbers in a list of offsets, at least and at most: a tangent curve is short.
inline constexpr size_t fewest_offsets = 2, most_offsets = 64;

/// All fields in the order in which they are written: the look's own, the pattern's, the warp's, the weft's, the
/// weave's.
const std::vector<Field>& fields();

/// The field of that path, or nullptr.
const Field* find_field(std::string_view path);

/// Calls use(member) with a reference to the field's member in `look` (const or not). Not for shorthands.
template <class LookOrConst, class Use>
void visit_member(LookOrConst& look, const Field& field, Use&& use) {
  std::visit(
      [&](auto member) {
        if constexpr (std::is_same_v<decltype(member), std::string Look::*> ||
                      std::is_same_v<decltype(member), float Look::*>)
          use(look.*member);
        else if constexpr (std::is_same_v<decltype(member), float WeaveSettings::*> ||
                           std::is_same_v<decltype(member), std::vector<std::string> WeaveSettings::*>)
          use(look.weave.*member);
        else if constexpr (!std::is_same_v<decltype(member), OfBothFamilies>)
          use(look.*(field.family).*member);
      },
      field.member);
}

}  // namespace sateen
