#include <fmt/format.h>

#include <algorithm>

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
    for (char& c : d.source_line)
      if ((static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7f) c = '.';  // a terminal would obey them
  }
  return d;
}

std::string json_quote(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    switch (c) {
      case '"':
        quoted += "\\\"";
        break;
      case '\\':
        quoted += "\\\\";
        break;
      case '\n':
        quoted += "\\n";
        break;
      case '\r':
        quoted += "\\r";
        break;
      case '\t':
        quoted += "\\t";
        break;
      default:
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
          quoted += fmt::format("\\u{:04x}", unsigned(c));
        else
          quoted += c;
    }
  }
  return quoted + "\"";
}

std::string shown_name(std::string_view name) {
  constexpr size_t longest = 60;
  size_t length = std::min(name.size(), longest);
  // Never cut inside a character of several bytes.
  while (length < name.size() && length > 0 && (static_cast<unsigned char>(name[length]) & 0xc0) == 0x80) --length;
  const std::string quoted = json_quote(name.substr(0, length));
  const std::string inside = quoted.substr(1, quoted.size() - 2) + (length < name.size() ? "..." : "");
  return inside.empty() || inside.find(' ') != std::string::npos ? "\"" + inside + "\"" : inside;
}

}  // namespace sateen
