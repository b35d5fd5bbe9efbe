#pragma once
#include <functional>
#include <string>
#include <string_view>

#include "look/fields.h"
#include "look/json.h"

namespace sateen {

/// Takes one complaint: its place in the text, found and expected, the remedy (may be empty), and whether it is of a
/// file that is missing.
struct Report {
  std::function<void(const JsonPlace& place, std::string message, std::string help, bool missing)> take;

  void operator()(const JsonPlace& place, std::string message, std::string help, bool missing = false) const {
    take(place, std::move(message), std::move(help), missing);
  }
};

/// Sets the field from a value of a look file after checking its kind and range; `name` is what messages call it.
/// False when there was something to report; the look is then unchanged. Giving `color` resets A to its default
/// and giving A drops `color`: a family has one or the other. A texture in place of the value goes to look.textures
/// and leaves the value that it stands over; a value drops the texture that was there.
bool set_field(Look& look, const Field& field, const JsonValue& value, std::string_view name, const Report& report);

/// The value as JSON, on one line, such that reading it back gives the same bits. Empty where the field holds
/// nothing: a shorthand, a `color` that is not given, an A that `color` stands in for.
std::string field_text(const Look& look, const Field& field);

/// The same with every colour's space written out and textures by their contents, so that equal cloths have equal
/// texts. InputError for a texture that cannot be read.
std::string canonical_text(const Look& look, const Field& field);

/// "0.5 to 90", "0 or more"; empty for texts.
std::string range_text(const Field& field);

/// Gives every colour of the look that relies on `color_space` that space by name.
void pin_color_spaces(Look& look);

}  // namespace sateen
