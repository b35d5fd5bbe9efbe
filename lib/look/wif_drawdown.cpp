#include "look/wif_drawdown.h"

#include <algorithm>
#include <bitset>
#include <map>
#include <string>

#include "look/wif.h"

namespace sateen {

namespace {

// One more than there may be, for a file that counts them from 0.
using Shafts = std::bitset<most_wif_shafts + 2>;

/// Numbers equal values from 0 in the order in which they first come; `firsts` names one thread of each kind.
template <class Value>
std::vector<int> kinds_of(const std::vector<Value>& values, std::vector<size_t>& firsts) {
  std::map<Value, int> known;
  std::vector<int> kinds;
  for (size_t i = 0; i < values.size(); ++i) {
    const auto [at, is_new] = known.try_emplace(values[i], int(known.size()));
    if (is_new) firsts.push_back(i);
    kinds.push_back(at->second);
  }
  return kinds;
}

int smallest_period(const std::vector<int>& kinds) {
  const int n = int(kinds.size());
  for (int step = 1; step < n; ++step)
    if (n % step == 0 && std::equal(kinds.begin() + step, kinds.end(), kinds.begin())) return step;
  return n;
}

Shafts shafts_of(const WifNumbers& numbers) {
  Shafts set;
  for (const std::uint16_t n : numbers) set.set(n);
  return set;
}

/// Threads of different shafts may cross alike: merges kinds whose rows of `meets` are equal.
void merge_kinds(std::vector<int>& kinds, std::vector<std::string>& rows) {
  std::vector<size_t> firsts;
  const std::vector<int> merged = kinds_of(rows, firsts);
  for (int& kind : kinds) kind = merged[size_t(kind)];
  std::vector<std::string> kept;
  for (const size_t first : firsts) kept.push_back(std::move(rows[first]));
  rows = std::move(kept);
}

std::vector<std::string> turned(const std::vector<std::string>& rows) {
  std::vector<std::string> columns(rows[0].size(), std::string(rows.size(), '\0'));
  for (size_t r = 0; r < rows.size(); ++r)
    for (size_t c = 0; c < columns.size(); ++c) columns[c][r] = rows[r][c];
  return columns;
}

}  // namespace

WifRepeat wif_repeat(const std::vector<WifNumbers>& ends, const std::vector<WifNumbers>& picks) {
  std::vector<size_t> first_ends, first_picks;
  std::vector<int> end_kinds = kinds_of(ends, first_ends), pick_kinds = kinds_of(picks, first_picks);
  std::vector<Shafts> threaded;
  for (const size_t end : first_ends) threaded.push_back(shafts_of(ends[end]));
  std::vector<std::string> rows;  // by kind of pick
  for (const size_t pick : first_picks) {
    const Shafts lifted = shafts_of(picks[pick]);
    std::string& row = rows.emplace_back(first_ends.size(), '\0');
    for (size_t end = 0; end < threaded.size(); ++end) {
      const WifNumbers& few = ends[first_ends[end]];
      row[end] = few.size() == 1 ? lifted[few[0]] : (threaded[end] & lifted).any();
    }
  }
  merge_kinds(pick_kinds, rows);
  std::vector<std::string> columns = turned(rows);
  merge_kinds(end_kinds, columns);
  rows = turned(columns);

  WifRepeat repeat;
  repeat.ends = smallest_period(end_kinds);
  repeat.picks = smallest_period(pick_kinds);
  end_kinds.resize(size_t(repeat.ends));
  pick_kinds.resize(size_t(repeat.picks));
  repeat.end_kinds = std::move(end_kinds);
  repeat.pick_kinds = std::move(pick_kinds);
  repeat.kinds_of_ends = int(columns.size());
  for (const std::string& row : rows) repeat.meets.insert(repeat.meets.end(), row.begin(), row.end());
  return repeat;
}

Draft wif_drawdown(const WifRepeat& repeat, bool rising) {
  const auto ends = size_t(repeat.ends), picks = size_t(repeat.picks);
  Draft draft{repeat.ends, repeat.picks, std::vector<std::uint8_t>(ends * picks)};
  for (size_t pick = 0; pick < picks; ++pick) {
    const size_t row = size_t(repeat.pick_kinds[pick]) * size_t(repeat.kinds_of_ends);
    for (size_t end = 0; end < ends; ++end) {
      const bool lifted = repeat.meets[row + size_t(repeat.end_kinds[end])] != 0;
      draft.warp_up[(picks - 1 - pick) * ends + (ends - 1 - end)] = lifted == rising;
    }
  }
  return draft;
}

}  // namespace sateen
