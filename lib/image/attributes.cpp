#include "image/attributes.h"

#include <fmt/format.h>

#include <charconv>

namespace sateen {

namespace {
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c == '\n' ? std::string("\\n") : std::string(1, c);
  }
  return out + '"';
}

bool unquote(std::string_view text, std::string& out) {
  if (text.size() < 2 || text.front() != '"' || text.back() != '"') return false;
  for (size_t i = 1; i + 1 < text.size(); ++i) {
    if (text[i] == '\\' && i + 2 < text.size()) {
      ++i;
      out += text[i] == 'n' ? '\n' : text[i];
    } else {
      out += text[i];
    }
  }
  return true;
}

template <class Number>
bool parse(std::string_view text, Number& number) {
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  return code == std::errc() && end == text.data() + text.size();
}
}  // namespace

std::string to_text(const Attributes& attributes) {
  std::string text;
  for (const auto& [name, value] : attributes) {
    std::string shown;
    if (const int* i = std::get_if<int>(&value)) {
      shown = std::to_string(*i);
    } else if (const double* d = std::get_if<double>(&value)) {
      shown = fmt::format("{}", *d);
      if (shown.find_first_of(".einf") == std::string::npos) shown += ".0";
    } else {
      shown = quoted(std::get<std::string>(value));
    }
    text += fmt::format("{} = {}\n", name, shown);
  }
  return text;
}

Attributes attributes_from_text(std::string_view text) {
  Attributes attributes;
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const size_t equals = line.find(" = ");
    if (equals == std::string_view::npos || equals == 0) continue;
    const std::string name(line.substr(0, equals));
    const std::string_view value = line.substr(equals + 3);
    int i = 0;
    double d = 0;
    std::string s;
    if (parse(value, i)) {
      attributes[name] = i;
    } else if (parse(value, d)) {
      attributes[name] = d;
    } else if (unquote(value, s)) {
      attributes[name] = s;
    }
  }
  return attributes;
}

}  // namespace sateen
