#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace sateen {

/// Where a key or a value stands in its text.
struct JsonPlace {
  int line = 0;    ///< from 1; 0 when it has no place
  int column = 0;  ///< from 1, in bytes
  int width = 1;   ///< bytes, quotes and brackets included; 1 for a list or object that spans lines
};

/// One value of a JSON text; the members of an object are values with a key, in the order of the text.
struct JsonValue {
  enum class Kind : std::uint8_t { null, boolean, number, text, list, object };
  Kind kind = Kind::null;
  bool boolean = false;
  double number = 0;  ///< finite
  std::string text;   ///< a text decoded, a number as it was written
  JsonPlace place;
  std::string key;  ///< empty outside objects
  JsonPlace key_place;
  std::vector<JsonValue> items;

  /// The member of that key, or nullptr.
  const JsonValue* find(std::string_view name) const;
};

/// A JSON text that was understood.
struct JsonDocument {
  std::string file;  ///< as the user gave it
  std::string text;  ///< without a byte order mark
  std::vector<std::uint32_t> line_starts;
  JsonValue root;
  std::vector<Diagnostic> problems;  ///< keys given twice; the first of them is the one kept
};

inline constexpr std::uint64_t json_most_bytes = 8u << 20;  // hard-cases.md: limits on input
inline constexpr int json_most_depth = 64;
inline constexpr int json_most_values = 500000;  ///< keeps a hostile file of 8 MiB below 256 MiB of memory

/// Reads JSON (RFC 8259), with // and /* */ comments allowed and a UTF-8 byte order mark skipped. InputError (wrong)
/// on the first fault of syntax, with its place, and beyond the limits above; keys given twice go to `problems`.
JsonDocument parse_json(std::string text, std::string file);

/// A complaint about a place of the document, with the line that it stands on.
Diagnostic diagnostic_at(const JsonDocument& document, const JsonPlace& place, std::string message,
                         std::string help = {});

/// The text in double quotes, escaped so that parse_json returns it unchanged (it must be UTF-8).
std::string json_quote(std::string_view text);

/// A name of the user's fit for a message: control characters escaped, cut after 60 bytes.
std::string shown_name(std::string_view name);

}  // namespace sateen
