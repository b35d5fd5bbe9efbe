#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/printable.h"

namespace sateen {

namespace {
constexpr size_t most_printed = 20;  // hard-cases.md: all errors of a file in one go, at most 20

std::string join(const std::vector<Diagnostic>& all) {
  std::string text;
  for (size_t i = 0; i < std::min(all.size(), most_printed); ++i) {
    if (i) text += '\n';
    text += to_string(all[i]);
  }
  if (all.size() > most_printed) text += fmt::format("\n... and {} more", all.size() - most_printed);
  return text;
}

// What a file holds is shown, never obeyed: a tab alone keeps its width, so that the carets stand under what they
// mean.
std::string shown_line(const std::string& text) {
  return printable(text, false, true);
}

std::string blanks_below(const std::string& shown) {
  std::string blanks;
  for (const char c : shown)
    if ((static_cast<unsigned char>(c) & 0xc0) != 0x80) blanks += c == '\t' ? '\t' : ' ';
  return blanks;
}
}  // namespace

std::string to_string(const Diagnostic& d) {
  std::string place = printable(d.file);
  if (d.line > 0) place += fmt::format(":{}:{}", d.line, d.column);
  if (d.offset >= 0) place += fmt::format(": at byte {}", d.offset);
  const std::string message = printable(d.message, true);
  std::string text = place.empty() ? "error: " + message : fmt::format("{}: error: {}", place, message);
  if (d.line > 0 && !d.source_line.empty()) {
    constexpr size_t longest = 160;
    const std::string& line = d.source_line;
    const size_t column = size_t(std::max(d.column - 1, 0));
    size_t start = line.size() > longest && column > longest / 2 ? column - longest / 2 : 0;
    // Never cut inside a character of several bytes.
    while (start > 0 && start < line.size() && (static_cast<unsigned char>(line[start]) & 0xc0) == 0x80) --start;
    size_t stop = std::min(line.size(), start + longest);
    while (stop > start && stop < line.size() && (static_cast<unsigned char>(line[stop]) & 0xc0) == 0x80) --stop;
    const auto part = [&](size_t from, size_t to) {
      from = std::clamp(from, start, stop);
      return shown_line(line.substr(from, std::clamp(to, from, stop) - from));
    };
    const size_t end = column + size_t(std::max(d.width, 1));
    std::string pad = blanks_below(part(start, column));
    if (column > line.size()) pad += std::string(column - line.size(), ' ');
    const std::string carets(std::max<size_t>(blanks_below(part(column, end)).size(), 1), '^');
    text += fmt::format("\n{:>5} | {}{}\n      | {}{}", d.line, part(start, column), part(column, stop), pad, carets);
  }
  if (!d.help.empty()) text += "\n  help: " + printable(d.help, true);
  return text;
}

InputError::InputError(std::string message, std::string help, Kind k) : kind(k) {
  Diagnostic d;
  d.message = std::move(message);
  d.help = std::move(help);
  diagnostics.push_back(std::move(d));
  text_ = join(diagnostics);
}

InputError::InputError(Kind k, std::vector<Diagnostic> all) : kind(k), diagnostics(std::move(all)) {
  text_ = join(diagnostics);
}

}  // namespace sateen
