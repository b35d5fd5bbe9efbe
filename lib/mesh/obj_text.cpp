#include "mesh/obj_text.h"

#include <algorithm>
#include <climits>
#include <cstring>

#include "base/text_encoding.h"

namespace sateen::obj {

namespace {
// A backslash directly before a line's end is white space of the logical line, and so is the end itself.
bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f';
}
// By which DOS ended a file; in one that was joined from several it stands before or behind a word.
constexpr char dos_end = 0x1a;

// The next carriage return that no line feed ends; several before one line feed are one end.
size_t lone_return(std::string_view text, size_t from) {
  for (size_t at = text.find('\r', from); at != std::string_view::npos; at = text.find('\r', at)) {
    const size_t next = text.find_first_not_of('\r', at);
    if (next == std::string_view::npos || text[next] != '\n') return at;
    at = next;
  }
  return std::string_view::npos;
}

bool has_comment(const char* begin, const char* end) {
  for (const char* p = begin; (p = static_cast<const char*>(std::memchr(p, '#', size_t(end - p)))); ++p)
    if (p == begin || is_space(p[-1])) return true;
  return false;
}
}  // namespace

Text::Text(std::string_view text, std::string name) : name_(std::move(name)) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  text = without_dos_end(text);
  begin_ = text.data();
  end_ = begin_ + text.size();
  line_begin_ = line_end_ = at_ = begin_;
}

bool Text::next_line() {
  const bool first = line_ == 0;
  const char* start = first ? begin_ : line_end_ + (line_end_ < end_ ? 1 : 0);
  if (start >= end_) return false;
  line_ = next_line_;
  line_begin_ = at_ = start;
  const char* from = start;
  for (;;) {
    const char* found = static_cast<const char*>(std::memchr(from, '\n', size_t(end_ - from)));
    line_end_ = found ? found : end_;
    if (next_line_ < INT_MAX) ++next_line_;  // 16 GB may hold more
    const char* last = line_end_;
    if (last > from && last[-1] == '\r') --last;
    if (!found || last == from || last[-1] != '\\') return true;
    // A comment ends with its line, whatever it ends with: a folder's name must not swallow a vertex.
    if (has_comment(from, last)) return true;
    from = found + 1;
  }
}

std::string_view Text::next_word() {
  const char* p = at_;
  for (;; ++p) {
    if (p >= line_end_) {
      at_ = line_end_;
      return {line_end_, 0};
    }
    if (is_space(*p) || *p == dos_end) continue;
    if (*p == '\\' && (p + 1 == line_end_ || p[1] == '\n' || p[1] == '\r')) continue;
    break;
  }
  if (*p == '#') {
    at_ = line_end_;
    return {line_end_, 0};
  }
  const char* start = p;
  // A # inside a word is a part of it: as in 1.#IND, or in the name of a material.
  while (p < line_end_ && !is_space(*p) && !(*p == '\\' && (p + 1 == line_end_ || p[1] == '\n' || p[1] == '\r'))) ++p;
  at_ = p;
  while (p > start && p[-1] == dos_end) --p;
  return {start, size_t(p - start)};
}

int Text::line_of(const char* place) const {
  return int(std::min<long long>(line_ + std::count(line_begin_, place, '\n'), INT_MAX));
}

void Text::error(std::string_view word, std::string message, std::string help) {
  add(word, line_of(word.data()), std::move(message), std::move(help));
}

void Text::error_anywhere(std::string_view word, std::string message, std::string help) {
  const long long lines = 1 + std::count(begin_, word.data(), '\n');
  add(word, int(std::min<long long>(lines, INT_MAX)), std::move(message), std::move(help));
}

void Text::add(std::string_view word, int line, std::string message, std::string help) {
  if (gave_up()) return;
  const char* start = word.data();
  while (start > begin_ && start[-1] != '\n') --start;
  const char* stop = static_cast<const char*>(std::memchr(start, '\n', size_t(end_ - start)));
  if (!stop) stop = end_;
  if (stop > start && stop[-1] == '\r') --stop;
  Diagnostic d;
  d.file = name_;
  d.line = line;
  d.column = int(std::min<long long>(word.data() - start, INT_MAX - 1)) + 1;
  d.width = int(std::clamp<size_t>(word.size(), 1, Text::longest_line));
  d.message = std::move(message);
  d.help = std::move(help);
  constexpr long most_shown = 4096;  // a hundred errors in lines of 1 MiB must not fill the memory
  if (word.data() - start < most_shown) d.source_line.assign(start, size_t(std::min<long>(stop - start, most_shown)));
  errors_.push_back(std::move(d));
}

bool has_lone_returns(std::string_view text) {
  return lone_return(text, 0) != std::string_view::npos;
}

void end_lines_at_returns(std::string& text) {
  for (size_t at = 0; (at = lone_return(text, at)) != std::string::npos;) text[at] = '\n';
}

namespace {
/// As Microsoft's libraries print what is no finite number: -1.#IND, 1.#QNAN0, 1.#INF00.
Number as_microsoft_prints(std::string_view word) {
  const size_t point = word.find(".#");
  if (point == std::string_view::npos || word.substr(0, point).find_first_not_of("+-0123456789") < point)
    return Number::malformed;
  return word.substr(point + 2).starts_with("INF") ? Number::not_finite : Number::not_a_number;
}
}  // namespace

Number to_float(std::string_view word, float& value) {
  const char *first = word.data(), *last = first + word.size();
  if (first < last && *first == '+') ++first;
  const std::from_chars_result r = std::from_chars(first, last, value);
  if (r.ec == std::errc::invalid_argument || r.ptr != last) {
    const Number kind = as_microsoft_prints(word);
    if (kind != Number::malformed) value = NAN;
    return kind;
  }
  if (r.ec == std::errc::result_out_of_range) {
    double wide = 0;
    if (std::from_chars(first, last, wide).ec == std::errc()) {
      value = float(wide);
    } else {
      const size_t e = word.find_first_of("eE");
      const bool small = e != std::string_view::npos && e + 1 < word.size() && word[e + 1] == '-';
      value = small ? 0.0f : INFINITY;
    }
  }
  if (std::isnan(value)) return Number::not_a_number;
  return std::isfinite(value) ? Number::good : Number::not_finite;
}

void to_double(std::string_view word, double& value) {
  const char *first = word.data(), *last = first + word.size();
  if (first < last && *first == '+') ++first;
  std::from_chars(first, last, value);
}

bool to_integer(std::string_view word, long long& value) {
  const char *first = word.data(), *last = first + word.size();
  if (first < last && *first == '+') ++first;
  const std::from_chars_result r = std::from_chars(first, last, value);
  return r.ec == std::errc() && r.ptr == last;
}

}  // namespace sateen::obj
