#include "look/json_syntax.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include "base/printable.h"

namespace sateen {

namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.' || c == '+' || c == '-' || c == '$';
}

// The next byte that is neither blank nor part of a comment; at the opening of a comment that never closes.
size_t skip_blank(std::string_view text, size_t at) {
  while (at < text.size()) {
    if (is_blank(text[at])) {
      ++at;
    } else if (text.substr(at, 2) == "//") {
      at = std::min(text.find_first_of("\r\n", at), text.size());
    } else if (text.substr(at, 2) == "/*") {
      const size_t close = text.find("*/", at + 2);
      if (close == std::string_view::npos) return at;
      at = close + 2;
    } else {
      break;
    }
  }
  return at;
}

size_t token_end(std::string_view text, size_t begin) {
  if (begin >= text.size()) return begin;
  if (text[begin] == '"' || text[begin] == '\'') {
    for (size_t at = begin + 1; at < text.size() && text[at] != '\n' && text[at] != '\r'; ++at) {
      if (text[at] == text[begin]) return at + 1;
      if (text[at] == '\\') ++at;
    }
    return std::min(text.find_first_of("\r\n", begin), text.size());
  }
  size_t end = begin;
  while (end < text.size() && is_word(text[end])) ++end;
  if (end > begin) return end;
  ++end;
  while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) ++end;
  return end;
}

std::string shown(std::string_view text, size_t begin, size_t end) {
  const auto first = static_cast<unsigned char>(text[begin]);
  if (first < 0x20 || first == 0x7f) return fmt::format("the control character 0x{:02x}", first);
  constexpr size_t longest = 40;
  if (end - begin <= longest) return std::string(text.substr(begin, end - begin));
  end = begin + longest;
  while (end > begin + 1 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
  return std::string(text.substr(begin, end - begin)) + "...";
}

size_t line_of(std::string_view text, size_t at) {
  return size_t(std::count(text.begin(), text.begin() + long(at), '\n')) + 1;
}

// The code unit of the \uXXXX at `at`, or -1.
int code_unit(std::string_view text, size_t at) {
  if (at + 6 > text.size() || text[at] != '\\' || text[at + 1] != 'u') return -1;
  unsigned unit = 0;  // unsigned, as a sign is no hex digit
  const auto result = std::from_chars(text.data() + at + 2, text.data() + at + 6, unit, 16);
  return result.ptr == text.data() + at + 6 ? int(unit) : -1;
}

// The first fault of the text in quotes at `begin`.
SyntaxFault explain_text(std::string_view text, size_t begin) {
  size_t at = begin + 1;
  while (at < text.size() && text[at] != '"' && text[at] != '\n' && text[at] != '\r') {
    const auto byte = static_cast<unsigned char>(text[at]);
    if (byte == '\t') return {at, at + 1, "found a tab inside a text, expected \\t", {}};
    if (byte < 0x20)
      return {at, at + 1, fmt::format("found the control character 0x{:02x} inside a text", byte),
              fmt::format("write \\u{:04x}", byte)};
    size_t length = character_length(text, at);
    if (length == 0)
      return {at, at + 1, fmt::format("found byte 0x{:02x}, which is not valid UTF-8", byte),
              "save the file as UTF-8"};
    if (byte == '\\') {
      length = 2;
      const int unit = code_unit(text, at);
      const bool known =
          at + 1 < text.size() && std::string_view("\"\\/bfnrt").find(text[at + 1]) != std::string_view::npos;
      if (unit < 0 && !known)
        return {
            at, at + 2, "found a backslash that begins no escape",
            "write \\\\ for a backslash; the others are \\\" \\/ \\b \\f \\n \\r \\t and \\u with four hex digits"};
      if (unit >= 0) {
        length = 6;
        const int next = code_unit(text, at + 6);
        const bool pair = unit >= 0xd800 && unit < 0xdc00 && next >= 0xdc00 && next < 0xe000;
        if (unit >= 0xd800 && unit < 0xe000 && !pair)
          return {at, at + 6, fmt::format("{} is half a character, expected a pair", text.substr(at, 6)), {}};
        if (pair) length = 12;
      }
    }
    at += length;
  }
  return {begin, at, "the text is not closed, expected \" before the end of the line", {}};
}

SyntaxFault explain_word(std::string_view text, size_t begin, size_t end, const std::string& expected) {
  const std::string_view word = text.substr(begin, end - begin);
  std::string bare(word.substr(word[0] == '-' || word[0] == '+' ? 1 : 0));
  std::transform(bare.begin(), bare.end(), bare.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  SyntaxFault fault{begin, end, fmt::format("found {}, expected {}", shown(text, begin, end), expected), {}};
  const bool numeric = !bare.empty() && (std::isdigit(static_cast<unsigned char>(bare[0])) || bare[0] == '.');
  if (bare == "nan" || bare == "inf" || bare == "infinity")
    fault.message = fmt::format("found {}, expected a finite number", word);
  else if (numeric)
    fault.message = fmt::format("found {}, expected a number such as 12, 0.5 or 1e-3", shown(text, begin, end));
  else if (bare == "true" || bare == "false" || bare == "null")
    fault.help = "did you mean " + bare + "?";
  else if (bare == "none" || bare == "nil")
    fault.help = "did you mean null?";
  else if (std::isalpha(static_cast<unsigned char>(word[0])) || word[0] == '_')
    fault.help = "texts and keys stand in double quotes";
  return fault;
}

}  // namespace

SyntaxFault explain_syntax(std::string_view text, const JsonProgress& progress) {
  using Last = JsonProgress::Last;
  const bool inside = !progress.open.empty();
  const bool object = inside && text[progress.open.back()] == '{';
  size_t at = skip_blank(text, progress.token_end), comma = std::string_view::npos;
  std::string expected = "a value";
  bool text_fits = true;
  if (progress.last == Last::opened) {
    expected = object ? "a key in double quotes, or }" : "a value or ]";
  } else if (progress.last == Last::key) {
    if (at < text.size() && text[at] == ':')
      at = skip_blank(text, at + 1);
    else
      expected = ": behind the key", text_fits = false;
  } else if (progress.last == Last::value) {
    if (inside && at < text.size() && text[at] == ',') {
      comma = at;
      at = skip_blank(text, at + 1);
      if (object) expected = "a key in double quotes";
    } else {
      expected = !inside ? "nothing more" : object ? ", or }" : ", or ]";
      text_fits = false;
    }
  }

  if (at >= text.size()) {
    const bool empty = progress.last == Last::nothing;
    const size_t end = empty ? 0 : comma != std::string_view::npos ? comma + 1 : progress.token_end;
    SyntaxFault fault{end, end + 1, fmt::format("{}, expected {}", empty ? "is empty" : "ends here", expected), {}};
    if (inside)
      fault.help = fmt::format("the {} of line {} is not closed", text[progress.open.back()],
                               line_of(text, progress.open.back()));
    return fault;
  }
  if (text.substr(at, 2) == "/*") return {at, at + 2, "the comment is not closed, expected */", {}};
  const size_t end = token_end(text, at);
  const char c = text[at];
  if (comma != std::string_view::npos && (c == '}' || c == ']'))
    return {comma, comma + 1, fmt::format("found a comma before {}, expected none", c), "remove the comma"};
  if (progress.too_large)
    return {at, end, fmt::format("found {}, expected a finite number", shown(text, at, end)), {}};
  if (c == '"' && text_fits) return explain_text(text, at);
  // 01, 1.2.3 and 0x10 begin with a number that was understood.
  if (progress.last == Last::value && at == progress.token_end && is_word(c) && is_word(text[at - 1]))
    return explain_word(text, progress.token_begin, end, "a value");

  SyntaxFault fault{at, end, fmt::format("found {}, expected {}", shown(text, at, end), expected), {}};
  if (is_word(c) && text_fits) fault = explain_word(text, at, end, expected);
  if (c == '\'') fault.help = "texts and keys stand in double quotes";
  if (c == '#' || c == '/') fault.help = "a comment begins with //";
  if (c == '=' && progress.last == Last::key) fault.help = "write : instead";
  if (progress.last == Last::value && inside && !text_fits && (c == '"' || c == '{' || c == '[' || is_word(c)))
    fault.help = "a comma is missing before it";
  return fault;
}

}  // namespace sateen
