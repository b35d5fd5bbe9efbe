#include "base/nearest_name.h"

#include <algorithm>
#include <cctype>

#include "base/name_distance.h"

namespace sateen {

namespace {
char lower(char c) {
  return char(std::tolower(static_cast<unsigned char>(c)));
}

size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

bool holds(std::string_view whole, std::string_view part) {
  return std::search(whole.begin(), whole.end(), part.begin(), part.end(),
                     [](char a, char b) { return lower(a) == lower(b); }) != whole.end();
}
}  // namespace

size_t name_distance(std::string_view a, std::string_view b) {
  constexpr size_t fewest_letters = 3;
  const size_t edits = edit_distance(a, b);
  const bool inside = std::min(a.size(), b.size()) >= fewest_letters && (holds(a, b) || holds(b, a));
  return inside ? std::min<size_t>(edits, 1) : edits;
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
  size_t best = std::clamp<size_t>(name.size() / 3, 1, 4) + 1;
  std::string found;
  for (const std::string& candidate : candidates) {
    if (candidate.size() > name.size() + 4 || name.size() > candidate.size() + 4) continue;
    if (const size_t d = edit_distance(name, candidate); d < best) best = d, found = candidate;
  }
  return found;
}

std::string suggestion(std::string_view name, const std::vector<std::string>& candidates) {
  if (const std::string near = nearest_name(name, candidates); !near.empty()) return "did you mean " + near + "?";
  if (candidates.empty()) return {};
  std::string text = "known: ";
  for (size_t i = 0; i < candidates.size(); ++i) text += (i ? ", " : "") + candidates[i];
  return text;
}

}  // namespace sateen
