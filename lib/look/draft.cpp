#include "look/draft.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <numeric>
#include <sstream>
#include <string_view>

#include "base/error.h"
#include "base/nearest_name.h"
#include "look/json.h"

namespace sateen {

namespace {

const char* const forms = "expected plain, twill 3/1, satin 5/2, sateen 5/2, rows of x and ., or a .wif file";

std::string lower(std::string text) {
  for (char& c : text) c = char(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

Draft make_draft(int ends, int picks, auto&& warp_up) {
  Draft draft{ends, picks, {}};
  draft.warp_up.reserve(size_t(ends) * size_t(picks));
  for (int pick = 0; pick < picks; ++pick)
    for (int end = 0; end < ends; ++end) draft.warp_up.push_back(warp_up(end, pick) ? 1 : 0);
  return draft;
}

/// "3/1" as two numbers, or nothing.
bool read_ratio(const std::string& text, int& first, int& second) {
  const size_t slash = text.find('/');
  const auto number = [](const std::string& digits, int& to) {
    if (digits.empty() || digits.size() > 4) return false;
    if (!std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; })) return false;
    to = std::stoi(digits);
    return true;
  };
  return slash != std::string::npos && number(text.substr(0, slash), first) && number(text.substr(slash + 1), second);
}

/// Counters that spread the interlacings of a satin over n ends: prime to n, and neither 1 nor n - 1, which are
/// twills.
std::vector<int> satin_counters(int n) {
  std::vector<int> counters;
  for (int c = 2; c < n - 1; ++c)
    if (std::gcd(n, c) == 1) counters.push_back(c);
  return counters;
}

Draft twill(const std::string& shown, const std::vector<std::string>& words) {
  int over = 0, under = 0;
  const bool turned = words.size() == 3 && (words[2] == "z" || words[2] == "s");
  if (words.size() < 2 || words.size() > (turned ? 3u : 2u) || !read_ratio(words[1], over, under) || over < 1 ||
      under < 1)
    throw InputError(fmt::format("the draft is {}, expected twill n/m, perhaps with z or s", shown),
                     "twill 3/1 z passes over three picks and under one");
  const int repeat = over + under;
  if (repeat > most_draft_side)
    throw InputError(fmt::format("the twill repeats over {} ends, expected at most {}", repeat, most_draft_side));
  const bool z = words.size() < 3 || words[2] == "z";
  return make_draft(repeat, repeat,
                    [&](int end, int pick) { return (z ? end + pick : end + repeat - pick) % repeat < over; });
}

Draft satin(const std::string& shown, const std::vector<std::string>& words) {
  int n = 0, counter = 0;
  const bool short_form = words.size() == 2 && read_ratio(words[1], n, counter);
  const bool long_form =
      words.size() == 4 && words[2] == "counter" && read_ratio(words[1] + "/" + words[3], n, counter);
  if (!short_form && !long_form)
    throw InputError(fmt::format("the draft is {}, expected {} n/c or {} n counter c", shown, words[0], words[0]),
                     "satin 5/2 and satin 8/3 are the usual ones");
  if (n < 5 || n > most_draft_side || n == 6)
    throw InputError(fmt::format("the {} is over {} ends, expected 5, or 7 to {}", words[0], n, most_draft_side),
                     n == 6 ? "no counter spreads over 6 ends: write the rows of an irregular one" : "");
  const std::vector<int> counters = satin_counters(n);
  if (std::find(counters.begin(), counters.end(), counter) == counters.end())
    throw InputError(
        fmt::format("the {} over {} ends has the counter {}, which meets some end twice or is a twill", words[0], n,
                    counter),
        fmt::format("for {} ends: {}", n,
                    fmt::join(counters.begin(),
                              counters.begin() + std::ptrdiff_t(std::min<size_t>(counters.size(), 8)), ", ")));
  const bool warp_faced = words[0] == "satin";
  return make_draft(n, n, [&](int end, int pick) { return (end == pick * counter % n) != warp_faced; });
}

Draft matrix(const std::vector<std::string>& rows) {
  const size_t ends = rows[0].size();
  if (rows.size() > size_t(most_draft_side) || ends > size_t(most_draft_side))
    throw InputError(fmt::format("the draft has {} rows of {} crossings, expected at most {} of {}", rows.size(),
                                 ends, most_draft_side, most_draft_side));
  for (size_t i = 0; i < rows.size(); ++i) {
    const size_t odd = rows[i].find_first_not_of("xX1.0");
    if (odd != std::string::npos)
      throw InputError(fmt::format("row {} of the draft holds {}, expected x or 1 for warp on top, . or 0 for weft",
                                   i + 1, shown_name(rows[i].substr(odd, 1))));
    if (rows[i].size() != ends || ends == 0)
      throw InputError(fmt::format("row {} of the draft has {} crossings, expected {}", i + 1, rows[i].size(),
                                   ends == 0 ? "one at least" : fmt::format("{} as the first", ends)));
  }
  return make_draft(int(ends), int(rows.size()), [&](int end, int pick) {
    const char c = rows[size_t(pick)][size_t(end)];
    return c != '.' && c != '0';
  });
}

/// Whether the draft repeats itself after `step` ends, or picks, which divide its own.
bool repeats(const Draft& d, int step, bool along_ends) {
  const auto ends = size_t(d.ends), picks = size_t(d.picks), by = size_t(step);
  const auto row = [&](size_t pick) { return d.warp_up.begin() + std::ptrdiff_t(pick * ends); };
  const auto after = [](auto at, size_t n) { return at + std::ptrdiff_t(n); };
  if (!along_ends) return std::equal(row(by), d.warp_up.end(), row(0));
  for (size_t pick = 0; pick < picks; ++pick)
    if (!std::equal(after(row(pick), by), after(row(pick), ends), row(pick))) return false;
  return true;
}

constexpr std::string_view packed_word = "packed ";

Draft unpacked(const std::vector<std::string>& rows) {
  int ends = 0;
  const char *const begin = rows[0].data() + packed_word.size(), *const stop = rows[0].data() + rows[0].size();
  const auto read = std::from_chars(begin, stop, ends);
  if (read.ec != std::errc() || read.ptr != stop || ends < 1 || ends > most_draft_side ||
      rows.size() > size_t(most_draft_side) + 1)
    throw InputError(
        fmt::format("the draft is {} with {} rows, expected packed and a number of ends from 1 to {}, and "
                    "at most {} rows",
                    shown_name(rows[0]), rows.size() - 1, most_draft_side, most_draft_side));
  Draft draft{ends, int(rows.size()) - 1, {}};
  draft.warp_up.reserve(size_t(ends) * rows.size());
  for (size_t i = 1; i < rows.size(); ++i) {
    const size_t odd = rows[i].find_first_not_of("0123456789abcdefABCDEF");
    if (odd != std::string::npos || rows[i].size() != size_t(ends + 3) / 4)
      throw InputError(fmt::format("row {} of the draft is {}, expected {} hexadecimal digits for {} ends", i,
                                   shown_name(rows[i]), (ends + 3) / 4, ends));
    for (size_t end = 0; end < size_t(ends); ++end) {
      const char c = rows[i][end / 4];
      const int digit = c <= '9' ? c - '0' : (c | 32) - 'a' + 10;
      draft.warp_up.push_back(std::uint8_t(digit >> (3 - end % 4) & 1));
    }
  }
  return draft;
}

std::vector<std::string> packed(const Draft& draft) {
  std::vector<std::string> rows{fmt::format("{}{}", packed_word, draft.ends)};
  for (int pick = 0; pick < draft.picks; ++pick) {
    std::string& row = rows.emplace_back();
    for (int end = 0; end < draft.ends; end += 4) {
      int digit = 0;
      for (int i = end; i < end + 4; ++i) digit = digit * 2 + (i < draft.ends && draft.up(i, pick));
      row += "0123456789abcdef"[digit];
    }
  }
  return rows;
}

}  // namespace

Draft parse_draft(const std::vector<std::string>& text) {
  if (text.empty()) throw InputError("the draft is an empty list", forms);
  if (text.size() > 1 && text[0].starts_with(packed_word)) return unpacked(text);
  const bool is_matrix = text.size() > 1 || text[0].find_first_not_of("xX1.0") == std::string::npos;
  if (is_matrix && !text[0].empty()) return matrix(text);
  std::vector<std::string> words;
  std::istringstream stream(lower(text[0]));
  for (std::string word; words.size() < 8 && stream >> word;) words.push_back(word);
  const std::string shown = shown_name(text[0]);
  if (words.size() == 1 && words[0] == "plain")
    return make_draft(2, 2, [](int e, int p) { return (e + p) % 2 == 0; });
  if (!words.empty() && words[0] == "twill") return twill(shown, words);
  if (!words.empty() && (words[0] == "satin" || words[0] == "sateen")) return satin(shown, words);
  const std::string near = words.empty() ? "" : nearest_name(words[0], {"plain", "twill", "satin", "sateen"});
  throw InputError(fmt::format("there is no draft {}, {}", shown, forms),
                   near.empty() ? "" : fmt::format("did you mean {}?", near));
}

std::vector<std::string> draft_rows(const Draft& draft) {
  if (draft.warp_up.size() > largest_plain_draft) return packed(draft);
  std::vector<std::string> rows;
  for (int pick = 0; pick < draft.picks; ++pick) {
    std::string& row = rows.emplace_back();
    for (int end = 0; end < draft.ends; ++end) row += draft.up(end, pick) ? 'x' : '.';
  }
  return rows;
}

Draft smallest_repeat(const Draft& draft) {
  int ends = draft.ends, picks = draft.picks;
  for (int step = 1; step < draft.ends && ends == draft.ends; ++step)
    if (draft.ends % step == 0 && repeats(draft, step, true)) ends = step;
  for (int step = 1; step < draft.picks && picks == draft.picks; ++step)
    if (draft.picks % step == 0 && repeats(draft, step, false)) picks = step;
  return make_draft(ends, picks, [&](int end, int pick) { return draft.up(end, pick); });
}

bool is_draft_file(const std::vector<std::string>& text) {
  return text.size() == 1 && lower(text[0]).ends_with(".wif");
}

}  // namespace sateen
