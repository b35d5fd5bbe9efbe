#include "look/wif_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/text_encoding.h"
#include "look/json.h"

namespace sateen {

namespace {

constexpr size_t most_faults = 20;
constexpr size_t most_entries = 20000;  // of a section; more would only fill memory

const std::set<std::string> weave_sections{"contents",    "weaving",     "warp",       "weft",
                                           "threading",   "tieup",       "treadling",  "liftplan",
                                           "color table", "warp colors", "weft colors"};

// Of the threads, that are told as not used; their lines may be any text.
const std::set<std::string> told_sections{"warp spacing",   "weft spacing",      "warp thickness",
                                          "weft thickness", "warp symbol table", "weft symbol table",
                                          "symbol table",   "warp symbols",      "weft symbols"};

bool is_blank(char c) {
  constexpr char dos_end = 0x1a;  // by which DOS ended a file
  return c == ' ' || c == '\t' || c == '\f' || c == '\v' || c == dos_end;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = char(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

std::string_view without_comment(std::string_view line) {
  for (size_t i = 0; i < line.size(); ++i)
    if (line[i] == ';' || (line[i] == '#' && (i == 0 || is_blank(line[i - 1])))) return line.substr(0, i);
  return line;
}

// Text in another encoding would be read as one long line of nonsense.
void check_encoding(std::string_view text, const std::string& file) {
  const auto refuse = [&](const std::string& what) {
    Diagnostic d;
    d.file = file;
    d.message = what;
    d.help = wide_text_help;
    throw InputError(InputError::Kind::wrong, {d});
  };
  if (const std::string wide = wide_text_complaint(text); !wide.empty()) refuse(wide);
  if (const size_t zero = text.find('\0'); zero != std::string_view::npos)
    refuse(fmt::format("holds a zero byte at {}, expected UTF-8 or plain ASCII text", zero));
}

}  // namespace

std::string upper(std::string name) {
  for (char& c : name) c = char(std::toupper(static_cast<unsigned char>(c)));
  return name;
}

int wif_yes_no(std::string_view word) {
  const std::string value = lower(word);
  if (value == "true" || value == "on" || value == "yes" || value == "1") return 1;
  return value == "false" || value == "off" || value == "no" || value == "0" ? 0 : -1;
}

WifText::WifText(const std::string& text, const std::string& file) : file_(file) {
  std::string_view left = without_dos_end(text);
  check_encoding(left, file);
  if (left.starts_with("\xef\xbb\xbf")) left.remove_prefix(3);
  split(left);
  if (sections_.empty() && first_stray_.number > 0)
    fault(first_stray_, first_stray_.key, "stands before the first section, expected [WIF]");
  else if (!sections_.contains("wif") && faults.empty())
    fault("there is no section [WIF], expected a Weaving Information File",
          "a draft can also be written into the look: plain, twill 3/1, rows of x and .");
  finish();
  obey_contents();
}

void WifText::split(std::string_view left) {
  for (int number = 1; !left.empty(); ++number) {
    const size_t end = left.find_first_of("\r\n");
    const std::string_view line = left.substr(0, end);
    if (end == std::string_view::npos)
      left = {};
    else
      left.remove_prefix(end + (left.substr(end, 2) == "\r\n" ? 2 : 1));
    const std::string_view body = trimmed(without_comment(line));
    if (body.empty()) continue;
    WifEntry entry{{}, {}, line, number};
    if (body.front() == '[' && body.back() == ']') {
      heading(trimmed(body.substr(1, body.size() - 2)), entry);
      continue;
    }
    if (!current_ && first_stray_.number == 0) first_stray_ = entry, first_stray_.key = body;
    if (current_) ++current_->lines;
    if (!keeps_entries_) continue;
    const size_t equals = body.find_first_of("=:");
    if (equals == std::string_view::npos) {
      if (body.find_first_not_of("0123456789") == std::string_view::npos)
        current_->entries.push_back({body, {}, line, number});  // a thread without a value has its default
      else if (body.front() == '[')
        fault(entry, body, "the section's name has no ], expected [NAME]");
      else
        fault(entry, body, "has no =, expected key=value, [SECTION] or ; and a comment");
      continue;
    }
    entry.key = trimmed(body.substr(0, equals));
    entry.value = trimmed(body.substr(equals + 1));
    if (current_->entries.size() == most_entries)
      return fault(entry, body, fmt::format("is one line too many, expected at most {} in a section", most_entries));
    current_->entries.push_back(entry);
  }
}

void WifText::heading(std::string_view name, const WifEntry& line) {
  const std::string key = lower(name);
  const auto [at, first] = sections_.try_emplace(key);
  keeps_entries_ = weave_sections.contains(key);
  current_ = &at->second;
  if (first) {
    current_->number = line.number;
  } else if (keeps_entries_) {
    fault(line, name, fmt::format("there are two sections [{}], the first in line {}", name, current_->number),
          "keep one of them");
  }
}

void WifText::obey_contents() {
  const auto contents = sections_.find("contents");
  if (contents == sections_.end()) return;
  for (const WifEntry& e : contents->second.entries) {
    const std::string name = lower(e.key);
    const auto section = sections_.find(name);
    if (section == sections_.end() || e.value.empty()) continue;
    const bool told = told_sections.contains(name);
    if (!told && !weave_sections.contains(name)) continue;
    const int said = wif_yes_no(e.value);
    if (said < 0 && !told)
      fault(e, e.value, fmt::format("{} is {}, expected {}", e.key, shown_name(e.value), wif_yes_no_words));
    section->second.denied = said == 0;
    section->second.named = said == 1;
  }
}

const WifSection* WifText::used(const std::string& name) const {
  const WifSection* section = find(name);
  return section && !section->denied ? section : nullptr;
}

const WifSection* WifText::find(const std::string& name) const {
  const auto at = sections_.find(name);
  return at == sections_.end() ? nullptr : &at->second;
}

const WifEntry* WifText::setting(const std::string& section, const std::string& key) const {
  const WifSection* in = used(section);
  if (!in) return nullptr;
  for (const WifEntry& e : in->entries)
    if (lower(e.key) == key) return e.value.empty() ? nullptr : &e;
  return nullptr;
}

std::vector<std::string> WifText::section_names() const {
  std::vector<std::string> names;
  for (const auto& [name, section] : sections_) names.push_back(name);
  return names;
}

void WifText::fault(const WifEntry& e, std::string_view at, std::string message, std::string help) {
  if (faults.size() == most_faults) return;
  Diagnostic d;
  d.file = file_;
  d.line = e.number;
  d.source_line = std::string(e.line.substr(0, 200));
  d.column = at.data() && e.line.data() ? int(at.data() - e.line.data()) + 1 : 1;
  d.width = std::max(1, int(std::min<size_t>(at.size(), 40)));
  d.message = std::move(message);
  d.help = std::move(help);
  faults.push_back(std::move(d));
}

void WifText::fault(std::string message, std::string help) {
  fault(WifEntry{}, {}, std::move(message), std::move(help));
}

void WifText::finish() const {
  if (faults.empty()) return;
  std::vector<Diagnostic> by_line = faults;
  std::stable_sort(by_line.begin(), by_line.end(),
                   [](const Diagnostic& a, const Diagnostic& b) { return a.line < b.line; });
  throw InputError(InputError::Kind::wrong, std::move(by_line));
}

}  // namespace sateen
