#include "look/wif.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>

#include "base/error.h"
#include "base/files.h"
#include "base/nearest_name.h"
#include "look/json.h"
#include "look/wif_drawdown.h"
#include "look/wif_text.h"
#include "look/wif_unused.h"

namespace sateen {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t most_bytes = 64u << 20;
const char* const what_a_draft_needs = "a draft needs THREADING and LIFTPLAN, or THREADING, TIEUP and TREADLING";

/// Numbers by thread (or, in a tie-up, by treadle), each with the line that it came from.
struct NumberLists {
  std::map<int, WifNumbers> rows;
  bool from_zero = false;

  /// Whether any thread has a number but 0, which is none.
  bool any() const {
    return std::any_of(rows.begin(), rows.end(),
                       [](const auto& row) { return !row.second.empty() && row.second.back() > 0; });
  }
  bool holds(int number) const {
    return std::any_of(rows.begin(), rows.end(), [&](const auto& row) {
      return std::binary_search(row.second.begin(), row.second.end(), std::uint16_t(number));
    });
  }
  void drop_zeros() {
    for (auto& [thread, numbers] : rows)
      if (!numbers.empty() && numbers.front() == 0) numbers.erase(numbers.begin());
  }
  void shift() {
    for (auto& [thread, numbers] : rows)
      for (std::uint16_t& n : numbers) ++n;
  }
};

class WifReader {
 public:
  WifReader(const std::string& text, const std::string& file) : text_(text, file), file_(file) {}

  WifDraft read() {
    const bool rising = yes_no("weaving", "rising shed", true);
    threading_ = lists("threading");
    read_lifts();
    text_.finish();
    settle_zeros();
    if (!threading_.any()) text_.fault("no end of [THREADING] is on a shaft");
    if (!lifts_.any()) text_.fault(fmt::format("no pick of {} lifts a shaft", lifts_name_));
    text_.finish();
    const Range ends = range("warp", threading_, "ends", "are on a shaft", "are on no shaft");
    const Range picks = range("weft", lifts_, "picks", "lift a shaft", "lift nothing");
    text_.finish();
    if (const std::string unused = unused_thread_values(text_); !unused.empty()) warn(unused);
    std::vector<WifNumbers> columns, rows;
    for (int end = ends.first; end <= ends.last; ++end) columns.push_back(numbers_of(threading_, end));
    for (int pick = picks.first; pick <= picks.last; ++pick) rows.push_back(numbers_of(lifts_, pick));
    const WifRepeat repeat = wif_repeat(columns, rows);
    if (repeat.ends > most_draft_side || repeat.picks > most_draft_side)
      text_.fault(fmt::format("repeats over {} ends and {} picks, expected at most {} of each", repeat.ends,
                              repeat.picks, most_draft_side),
                  "keep the lines of one repeat in THREADING, TREADLING and LIFTPLAN");
    text_.finish();
    return {wif_drawdown(repeat, rising), std::move(warnings_)};
  }

 private:
  struct Range {
    int first = 1, last = 1;
  };

  void warn(std::string text) { warnings_.push_back(fmt::format("{}: {}", file_, text)); }
  void warn(const WifEntry& at, std::string text) {
    warnings_.push_back(fmt::format("{}:{}: {}", file_, at.number, text));
  }

  /// A whole number from 0 to `most`; complains where it is none.
  std::optional<int> integer(const WifEntry& e, std::string_view text, const char* what, int most) {
    int value = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code == std::errc() && end == text.data() + text.size() && value >= 0 && value <= most) return value;
    text_.fault(e, text,
                fmt::format("{} is {}, expected a whole number from 0 to {}", what,
                            text.empty() ? "missing" : shown_name(text), most));
    return {};
  }

  NumberLists lists(const std::string& name) {
    NumberLists all;
    const WifSection* section = text_.used(name);
    if (!section) {
      if (text_.find(name))
        text_.fault(fmt::format("[CONTENTS] says that {} is not used, and nothing else tells it", upper(name)),
                    what_a_draft_needs);
      else
        text_.fault(fmt::format("there is no section [{}]", upper(name)), near(name));
      return all;
    }
    std::map<int, const WifEntry*> places;
    for (const WifEntry& e : section->entries) {
      const std::optional<int> key = integer(e, e.key, "the number before =", most_wif_threads);
      if (!key) continue;
      if (*key == 0 && &e == &section->entries.front()) all.from_zero = true;
      if (*key == 0 && !all.from_zero) {
        text_.fault(e, e.key, "threads, shafts and treadles are counted from 1");
        continue;
      }
      const int thread = *key + all.from_zero;
      WifNumbers numbers = numbers_in(e);
      const auto [place, first] = places.try_emplace(thread, &e);
      if (!first && numbers != all.rows[thread])
        text_.fault(e, e.key, fmt::format("{} is given twice, first in line {}", *key, place->second->number));
      else
        all.rows[thread] = std::move(numbers);
    }
    if (all.from_zero) warn(fmt::format("[{}] counts from 0, which is taken as its first", upper(name)));
    return all;
  }

  /// The numbers of one line, between commas or blanks, sorted and each once.
  WifNumbers numbers_in(const WifEntry& e) {
    constexpr const char* separators = ", \t";
    WifNumbers numbers;
    std::string_view left = e.value;
    while (!left.empty()) {
      const size_t end = left.find_first_of(separators);
      const std::string_view word = left.substr(0, end);
      const size_t next = end == std::string_view::npos ? end : left.find_first_not_of(separators, end);
      if (const auto n = integer(e, word, "the number in the list", most_wif_shafts))
        numbers.push_back(std::uint16_t(*n));
      left.remove_prefix(next == std::string_view::npos ? left.size() : next);
    }
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    return numbers;
  }

  std::string near(const std::string& name) const {
    std::vector<std::string> unknown;
    for (const std::string& section : text_.section_names())
      if (section != "threading" && section != "weaving") unknown.push_back(section);
    const std::string like = nearest_name(name, unknown);
    return like.empty() ? what_a_draft_needs : fmt::format("there is a section [{}]", upper(like));
  }

  /// Shafts that each pick lifts: the one of the two ways that [CONTENTS] names and that lifts anything.
  void read_lifts() {
    const WifSection *plan = text_.used("liftplan"), *treadling = text_.used("treadling"),
                     *tieup = text_.used("tieup");
    const bool either = plan && treadling && tieup;
    const size_t faults = text_.faults.size(), warnings = warnings_.size();
    if (!plan && !(treadling && tieup)) return complain_of_no_plan();
    if (plan) lifts_ = lists("liftplan");
    lifts_name_ = "[LIFTPLAN]";
    const bool empty = plan && !lifts_.any() && text_.faults.size() == faults;
    const bool treadles_named = either && treadling->named && tieup->named && !plan->named;
    if (plan && !(either && (empty || treadles_named))) {
      if (either) compare_with_treadles();
      return;
    }
    text_.faults.resize(faults);  // those of a plan that is not used
    warnings_.resize(warnings);
    lifts_ = treadled();
    lifts_name_ = "[TREADLING]";
    if (either && !empty) warn("[CONTENTS] names TREADLING and TIEUP; LIFTPLAN, which it does not name, is not used");
  }

  void complain_of_no_plan() {
    const bool some = text_.used("treadling") || text_.used("tieup");
    lists(!some ? "liftplan" : text_.used("treadling") ? "tieup" : "treadling");
  }

  /// Both ways are there, LIFTPLAN is used: says so where the other would be another cloth.
  void compare_with_treadles() {
    const size_t faults = text_.faults.size(), warnings = warnings_.size();
    NumberLists other = treadled();
    const bool sound = text_.faults.size() == faults;
    text_.faults.resize(faults);
    warnings_.resize(warnings);
    NumberLists own = lifts_;
    own.drop_zeros();
    other.drop_zeros();
    const auto empty_row = [](const auto& row) { return row.second.empty(); };
    std::erase_if(own.rows, empty_row);
    std::erase_if(other.rows, empty_row);
    if (sound && other.any() && own.rows != other.rows)
      warn("LIFTPLAN and TREADLING with TIEUP draw different cloths; LIFTPLAN is used");
  }

  /// Shafts that each pick lifts, by way of its treadles.
  NumberLists treadled() {
    NumberLists treadling = lists("treadling");
    NumberLists tieup = lists("tieup");
    const WifEntry* told = text_.setting("weaving", "treadles");
    if (tieup.from_zero) {
      treadling.shift();
    } else {
      treadling.drop_zeros();
    }
    NumberLists lifts;
    lifts.from_zero = treadling.from_zero;
    std::map<int, int> loose;  // treadles without a tie, and the first pick that uses each
    for (const auto& [pick, treadles] : treadling.rows) {
      WifNumbers& row = lifts.rows[pick];
      for (const std::uint16_t treadle : treadles) {
        const auto tied = tieup.rows.find(treadle);
        if (tied == tieup.rows.end() || tied->second.empty())
          loose.try_emplace(treadle, pick);
        else
          row.insert(row.end(), tied->second.begin(), tied->second.end());
      }
      std::sort(row.begin(), row.end());
      row.erase(std::unique(row.begin(), row.end()), row.end());
    }
    for (const auto& [treadle, pick] : loose)
      warn(fmt::format("treadle {}, first used by pick {}, is tied to no shaft{}: it lifts nothing",
                       treadle - int(tieup.from_zero), pick - int(treadling.from_zero),
                       told ? fmt::format(" (Treadles={})", told->value) : ""));
    return lifts;
  }

  /// In a file that counts its threads from 0 a shaft 0 may be the first, or none.
  void settle_zeros() {
    const bool zero = threading_.holds(0) || lifts_.holds(0);
    if (!zero) return;
    if (!threading_.from_zero) {
      threading_.drop_zeros();
      lifts_.drop_zeros();
      return;
    }
    const WifEntry* e = text_.setting("weaving", "shafts");
    const std::optional<int> shafts = e ? integer(*e, e->value, "Shafts", most_wif_shafts) : std::nullopt;
    if (!shafts || threading_.holds(*shafts) || lifts_.holds(*shafts))
      return text_.fault("counts threads from 0, and whether shaft 0 is the first or none cannot be told",
                         "count threads, shafts and treadles from 1");
    threading_.shift();
    lifts_.shift();
  }

  /// The threads that are drawn: without those at either end that are on no shaft, or lift none.
  Range range(const std::string& section, const NumberLists& lists, const char* things, const char* drawn,
              const char* idle_are) {
    Range r{0, 0};
    int named = 0;
    for (const auto& [thread, numbers] : lists.rows) {
      named = thread;
      if (numbers.empty()) continue;
      if (r.first == 0) r.first = thread;
      r.last = thread;
    }
    // A few that are written and idle belong to the cloth, a float at the end of the repeat; many are padding.
    const int used = r.last - r.first + 1, before = lists.rows.empty() ? 0 : r.first - lists.rows.begin()->first;
    if (2 * before <= used) r.first -= before;
    if (2 * (named - r.last) <= used) r.last = named;
    int count = named;
    if (const WifEntry* e = text_.setting(section, "threads")) {
      const std::optional<int> told = integer(*e, e->value, "Threads", 1 << 24);
      count = std::max(told.value_or(count), named);
      if (told && *told < named)
        warn(*e, fmt::format("[{}] says {} threads, but {} are written, which count", upper(section), *told, named));
    }
    if (r.first > 1 || r.last < count)
      warn(fmt::format("of {} {} only {} to {} {}: the others are left out", count, things, r.first, r.last, drawn));
    int idle = 0;
    for (int thread = r.first; thread <= r.last; ++thread) idle += numbers_of(lists, thread).empty();
    if (idle > 0) warn(fmt::format("{} of the {} {} {}", idle, r.last - r.first + 1, things, idle_are));
    return r;
  }

  static WifNumbers numbers_of(const NumberLists& lists, int thread) {
    const auto row = lists.rows.find(thread);
    return row == lists.rows.end() ? WifNumbers() : row->second;
  }

  bool yes_no(const std::string& section, const std::string& key, bool otherwise) {
    const WifEntry* e = text_.setting(section, key);
    if (!e) return otherwise;
    const int said = wif_yes_no(e->value);
    if (said < 0)
      text_.fault(*e, e->value, fmt::format("{} is {}, expected {}", e->key, shown_name(e->value), wif_yes_no_words));
    return said == 1;
  }

  WifText text_;
  const std::string& file_;
  NumberLists threading_, lifts_;
  std::string lifts_name_;
  std::vector<std::string> warnings_;
};

}  // namespace

WifDraft parse_wif(const std::string& text, const std::string& file) {
  return WifReader(text, file).read();
}

WifDraft read_wif(const fs::path& path) {
  return parse_wif(read_text_file(path, most_bytes), path.string());
}

void settle_draft(WeaveSettings& weave, const std::string& look_file) {
  weave.draft_warnings.clear();
  if (!is_draft_file(weave.draft)) return;
  std::error_code ignored;
  const fs::path beside = fs::path(look_file).parent_path() / weave.draft[0];
  WifDraft read = read_wif(fs::is_regular_file(beside, ignored) ? beside : fs::path(weave.draft[0]));
  weave.draft = draft_rows(read.draft);
  weave.draft_warnings = std::move(read.warnings);
}

}  // namespace sateen
