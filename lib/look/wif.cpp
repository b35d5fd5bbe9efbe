#include "look/wif.h"

#include <fmt/format.h>

#include <algorithm>
#include <bitset>
#include <charconv>
#include <map>
#include <optional>

#include "base/error.h"
#include "base/files.h"
#include "look/json.h"

namespace sateen {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t most_bytes = 4u << 20;
constexpr size_t most_faults = 20;

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r')) text.remove_suffix(1);
  return text;
}

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = char(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

/// One "key=value" with its place.
struct Entry {
  std::string_view key, value, line;
  int number = 0;
};
using Section = std::vector<Entry>;

class WifReader {
 public:
  WifReader(const std::string& text, const std::string& file) : text_(text), file_(file) {}

  Draft read() {
    split();
    if (!sections_.contains("wif"))
      fault(1, {}, {}, "there is no section [WIF], expected a Weaving Information File",
            "a draft can also be written into the look: plain, twill 3/1, rows of x and .");
    finish();
    const bool rising = setting_is_on("weaving", "rising shed", true);
    const Lists threading = lists("threading");
    const bool by_lifts = sections_.contains("liftplan");
    const Lists lifts = by_lifts ? lists("liftplan") : treadled();
    const int ends = count("warp", threading), picks = count("weft", lifts);
    finish();
    Draft draft{ends, picks, std::vector<std::uint8_t>(size_t(ends) * size_t(picks))};
    for (int pick = 1; pick <= picks; ++pick) {
      const auto lifted = lifts.find(pick);
      for (int end = 1; end <= ends; ++end) {
        const auto shafts = threading.find(end);
        const bool up = shafts != threading.end() && lifted != lifts.end() && (shafts->second & lifted->second).any();
        draft.warp_up[size_t(picks - pick) * size_t(ends) + size_t(ends - end)] = up == rising;
      }
    }
    Draft smallest = smallest_repeat(draft);
    if (smallest.ends > most_draft_side || smallest.picks > most_draft_side)
      fault(0, {}, {},
            fmt::format("repeats over {} ends and {} picks, expected at most {} of each", smallest.ends,
                        smallest.picks, most_draft_side),
            {});
    finish();
    return smallest;
  }

 private:
  using Numbers = std::bitset<most_wif_shafts + 1>;
  using Lists = std::map<int, Numbers>;  // shafts or treadles by thread

  void fault(int number, std::string_view line, std::string_view at, std::string message, std::string help) {
    if (faults_.size() == most_faults) return;
    Diagnostic d;
    d.file = file_;
    d.line = number;
    d.source_line = std::string(line.substr(0, 200));
    d.column = at.data() && line.data() ? int(at.data() - line.data()) + 1 : 1;
    d.width = std::max(1, int(std::min<size_t>(at.size(), 40)));
    d.message = std::move(message);
    d.help = std::move(help);
    faults_.push_back(std::move(d));
  }
  void fault(const Entry& e, std::string_view at, std::string message, std::string help = {}) {
    fault(e.number, e.line, at, std::move(message), std::move(help));
  }
  void finish() const {
    if (!faults_.empty()) throw InputError(InputError::Kind::wrong, faults_);
  }

  void split() {
    std::string_view left = text_;
    Section* current = nullptr;
    for (int number = 1; !left.empty(); ++number) {
      const size_t end = left.find('\n');
      const std::string_view line = left.substr(0, end), body = trimmed(line);
      left.remove_prefix(end == std::string_view::npos ? left.size() : end + 1);
      if (body.empty() || body[0] == ';') continue;
      if (body[0] == '[') {
        if (body.back() != ']') fault(number, line, body, "the section's name has no ], expected [NAME]", {});
        current = &sections_[lower(trimmed(body.substr(1, body.find(']') - 1)))];
        continue;
      }
      const size_t equals = body.find('=');
      if (equals == std::string_view::npos || !current) {
        fault(number, line, body,
              !current ? "stands before the first section, expected [WIF]"
                       : "has no =, expected key=value, [SECTION] or ; and a comment",
              {});
        if (!current) return;  // no WIF at all: one complaint is enough
        continue;
      }
      current->push_back({trimmed(body.substr(0, equals)), trimmed(body.substr(equals + 1)), line, number});
    }
  }

  /// A whole number from 0 to `most`; complains where it is none.
  std::optional<int> integer(const Entry& e, std::string_view text, const char* what, int most) {
    int value = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code == std::errc() && end == text.data() + text.size() && value >= 0 && value <= most) return value;
    fault(e, text,
          fmt::format("{} is {}, expected a whole number from 0 to {}", what,
                      text.empty() ? "missing" : shown_name(text), most));
    return {};
  }

  Lists lists(const std::string& name) {
    Lists all;
    const auto section = sections_.find(name);
    if (section == sections_.end()) {
      fault(0, {}, {}, fmt::format("there is no section [{}]", upper(name)),
            "a draft needs THREADING and LIFTPLAN, or THREADING, TIEUP and TREADLING");
      return all;
    }
    for (const Entry& e : section->second) {
      const std::optional<int> thread = integer(e, e.key, "the number before =", most_wif_threads);
      if (!thread) continue;
      if (*thread == 0) {
        fault(e, e.key, "threads, shafts and treadles are counted from 1");
        continue;
      }
      Numbers& numbers = all[*thread];
      std::string_view left = trimmed(e.value.substr(0, e.value.find(';')));
      while (!left.empty()) {
        const size_t comma = left.find(',');
        if (const auto n = integer(e, trimmed(left.substr(0, comma)), "the number in the list", most_wif_shafts))
          numbers.set(size_t(*n));
        left.remove_prefix(comma == std::string_view::npos ? left.size() : comma + 1);
      }
      numbers.reset(0);  // 0: on no shaft
    }
    return all;
  }

  /// Shafts that each pick lifts, by way of its treadles.
  Lists treadled() {
    const Lists treadling = lists("treadling"), tieup = lists("tieup");
    Lists lifts;
    for (const auto& [pick, treadles] : treadling)
      for (const auto& [treadle, shafts] : tieup)
        if (treadle <= most_wif_shafts && treadles[size_t(treadle)]) lifts[pick] |= shafts;
    return lifts;
  }

  /// Threads= of WARP or WEFT; without it the largest thread that is named.
  int count(const std::string& name, const Lists& lists) {
    const int named = lists.empty() ? 0 : lists.rbegin()->first;
    if (const Entry* e = setting(name, "threads")) {
      const std::optional<int> told = integer(*e, e->value, "Threads", most_wif_threads);
      if (told && *told >= std::max(named, 1)) return *told;
      if (told)
        fault(*e, e->value, fmt::format("[{}] has {} threads, but thread {} is used", upper(name), *told, named));
      return 1;
    }
    if (named == 0) fault(0, {}, {}, fmt::format("no thread of the {} is named", name), {});
    return std::max(named, 1);
  }

  const Entry* setting(const std::string& section, const std::string& key) const {
    const auto at = sections_.find(section);
    if (at == sections_.end()) return nullptr;
    for (const Entry& e : at->second)
      if (lower(e.key) == key) return &e;
    return nullptr;
  }

  bool setting_is_on(const std::string& section, const std::string& key, bool otherwise) const {
    const Entry* e = setting(section, key);
    if (!e) return otherwise;
    const std::string value = lower(e->value);
    return value == "yes" || value == "true" || value == "on" || value == "1";
  }

  static std::string upper(std::string name) {
    for (char& c : name) c = char(std::toupper(static_cast<unsigned char>(c)));
    return name;
  }

  const std::string& text_;
  const std::string& file_;
  std::map<std::string, Section> sections_;
  std::vector<Diagnostic> faults_;
};

}  // namespace

Draft parse_wif(const std::string& text, const std::string& file) {
  return WifReader(text, file).read();
}

Draft read_wif(const fs::path& path) {
  return parse_wif(read_text_file(path, most_bytes), path.string());
}

void settle_draft(std::vector<std::string>& text, const std::string& look_file) {
  if (!is_draft_file(text)) return;
  std::error_code ignored;
  const fs::path beside = fs::path(look_file).parent_path() / text[0];
  text = draft_rows(read_wif(fs::is_regular_file(beside, ignored) ? beside : fs::path(text[0])));
}

}  // namespace sateen
