#include "base/printable.h"

#include <fmt/format.h>

namespace sateen {

namespace {
unsigned byte_at(std::string_view text, size_t at) {
  return at < text.size() ? static_cast<unsigned char>(text[at]) : 0u;
}
}  // namespace

size_t character_length(std::string_view text, size_t at) {
  const unsigned first = byte_at(text, at);
  if (first < 0x80) return 1;
  const size_t length = first >= 0xc2 && first < 0xe0   ? 2
                        : (first & 0xf0) == 0xe0        ? 3
                        : first >= 0xf0 && first < 0xf5 ? 4
                                                        : 0;
  for (size_t i = 1; i < length; ++i)
    if ((byte_at(text, at + i) & 0xc0) != 0x80) return 0;
  const unsigned second = byte_at(text, at + 1);
  const bool wrong = (first == 0xe0 && second < 0xa0) || (first == 0xed && second >= 0xa0) ||
                     (first == 0xf0 && second < 0x90) || (first == 0xf4 && second >= 0x90);
  return wrong ? 0 : length;
}

unsigned obeyed_character(std::string_view text, size_t at, size_t length) {
  unsigned code = byte_at(text, at);
  if (length == 1) return code == 0 || (code >= 0x20 && code != 0x7f) ? 0 : code;
  if (length > 3) return 0;
  code &= length == 2 ? 0x1fu : 0x0fu;
  for (size_t i = 1; i < length; ++i) code = code << 6 | (byte_at(text, at + i) & 0x3fu);
  const bool obeyed = code < 0xa0 || code == 0x61c || code == 0x200e || code == 0x200f ||
                      (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
  return obeyed ? code : 0;
}

std::string printable(std::string_view text, bool keep_lines, bool keep_tabs) {
  std::string out;
  out.reserve(text.size());
  for (size_t at = 0, length = 0; at < text.size(); at += length) {
    const char c = text[at];
    length = character_length(text, at);
    if (length == 0 || c == '\0') {
      length = 1;
      out += fmt::format("\\x{:02x}", byte_at(text, at));
      continue;
    }
    const unsigned code = obeyed_character(text, at, length);
    if (code == 0 || (c == '\n' && keep_lines) || (c == '\t' && keep_tabs))
      out += text.substr(at, length);
    else if (c == '\n' || c == '\r' || c == '\t')
      out += c == '\n' ? "\\n" : c == '\r' ? "\\r" : "\\t";
    else
      out += code < 0x80 ? fmt::format("\\x{:02x}", code) : fmt::format("\\u{:04x}", code);
  }
  return out;
}

}  // namespace sateen
