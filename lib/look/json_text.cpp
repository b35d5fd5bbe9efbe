#include <fmt/format.h>

#include <algorithm>

#include "base/printable.h"
#include "look/json.h"

namespace sateen {

Diagnostic diagnostic_at(const JsonDocument& document, const JsonPlace& place, std::string message,
                         std::string help) {
  Diagnostic d;
  d.file = document.file;
  d.line = place.line;
  d.column = place.column;
  d.width = place.width;
  d.message = std::move(message);
  d.help = std::move(help);
  constexpr size_t longest_line = 4096;  // a file of one long line must not be copied into every message
  if (place.line > 0 && size_t(place.line) <= document.line_starts.size()) {
    const size_t begin = document.line_starts[size_t(place.line) - 1];
    const size_t end = std::min(document.text.find('\n', begin), document.text.size());
    if (end - begin <= longest_line) d.source_line = document.text.substr(begin, end - begin);
    if (d.source_line.ends_with('\r')) d.source_line.pop_back();
  }
  return d;
}

std::string json_quote(std::string_view text) {
  std::string quoted = "\"";
  for (size_t at = 0, length = 0; at < text.size(); at += length) {
    length = std::max<size_t>(character_length(text, at), 1);
    const char c = text[at];
    if (c == '"' || c == '\\')
      quoted += {'\\', c};
    else if (c == '\n' || c == '\r' || c == '\t')
      quoted += c == '\n' ? "\\n" : c == '\r' ? "\\r" : "\\t";
    else if (const unsigned code = obeyed_character(text, at, length); code != 0 || c == '\0')
      quoted += fmt::format("\\u{:04x}", code);
    else
      quoted += text.substr(at, length);
  }
  return quoted + "\"";
}

std::string shown_name(std::string_view name) {
  constexpr size_t longest = 60;
  size_t length = std::min(name.size(), longest);
  // Never cut inside a character of several bytes.
  while (length < name.size() && length > 0 && (static_cast<unsigned char>(name[length]) & 0xc0) == 0x80) --length;
  const std::string inside = printable(name.substr(0, length)) + (length < name.size() ? "..." : "");
  return inside.empty() || inside.find(' ') != std::string::npos ? "\"" + inside + "\"" : inside;
}

}  // namespace sateen
