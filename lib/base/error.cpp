#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>

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
}  // namespace

std::string to_string(const Diagnostic& d) {
  std::string place = d.file;
  if (d.line > 0) place += fmt::format(":{}:{}", d.line, d.column);
  if (d.offset >= 0) place += fmt::format(": at byte {}", d.offset);
  std::string text = place.empty() ? "error: " + d.message : fmt::format("{}: error: {}", place, d.message);
  if (d.line > 0 && !d.source_line.empty()) {
    // A tab keeps its width, so that the carets stand under what they mean.
    constexpr size_t longest = 160;
    const std::string number = std::to_string(d.line);
    size_t start = 0;
    const size_t column = size_t(std::max(d.column - 1, 0));
    if (d.source_line.size() > longest && column > longest / 2) start = column - longest / 2;
    const std::string shown = start < d.source_line.size() ? d.source_line.substr(start, longest) : std::string();
    std::string pad;
    for (size_t i = start; i < column; ++i) {
      const unsigned char c = i < d.source_line.size() ? static_cast<unsigned char>(d.source_line[i]) : ' ';
      if ((c & 0xc0) == 0x80) continue;  // the later bytes of a UTF-8 character take no room
      pad += c == '\t' ? '\t' : ' ';
    }
    const size_t room = shown.size() > pad.size() ? shown.size() - pad.size() : 1;
    const std::string carets(std::clamp<size_t>(size_t(std::max(d.width, 1)), 1, room), '^');
    text += fmt::format("\n{:>5} | {}\n      | {}{}", number, shown, pad, carets);
  }
  if (!d.help.empty()) text += "\n  help: " + d.help;
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
