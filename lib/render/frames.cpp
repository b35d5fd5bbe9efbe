#include "render/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>
#include <string_view>

#include "base/error.h"
#include "look/json.h"

namespace sateen {

namespace {
constexpr int largest_frame = 999'999;
constexpr size_t most_frames = 100'000;

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw InputError(fmt::format("frames {}: {}", shown_name(text), why),
                   "expected such as 1-100, 1-100x2, 1..10 or 1,5,9");
}

// Takes the number at the front of `text`.
int take_number(std::string_view& text, const std::string& whole) {
  int value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code == std::errc::result_out_of_range || value > largest_frame)
    refuse(whole, fmt::format("numbers go up to {}", largest_frame));
  if (code != std::errc() || value < 0 || text[0] == '-') refuse(whole, "a number is missing");
  text.remove_prefix(size_t(end - text.data()));
  return value;
}

struct Place {
  size_t begin, length;
  int digits;
};

// Digits after the sign of %04d or $F4; at most two of them.
int take_digits(std::string_view text, size_t& at) {
  int digits = 0, count = 0;
  while (at < text.size() && text[at] >= '0' && text[at] <= '9' && count < 2)
    digits = digits * 10 + (text[at++] - '0'), ++count;
  return digits;
}

std::vector<Place> places_in(std::string_view name) {
  std::vector<Place> places;
  for (size_t i = 0; i < name.size();) {
    size_t end = i;
    if (name[i] == '#') {
      while (end < name.size() && name[end] == '#') ++end;
      places.push_back({i, end - i, end - i == 1 ? 4 : int(end - i)});
    } else if (name[i] == '%') {
      size_t at = i + 1;
      const int digits = take_digits(name, at);
      if (at < name.size() && name[at] == 'd') end = at + 1, places.push_back({i, end - i, digits});
    } else if (name.substr(i, 2) == "$F") {
      end = i + 2;
      const int digits = take_digits(name, end);
      places.push_back({i, end - i, digits});
    }
    i = std::max(end, i + 1);
  }
  return places;
}
}  // namespace

std::vector<int> parse_frames(const std::string& text) {
  std::vector<int> frames;
  std::set<int> seen;
  std::string_view left = text;
  for (;;) {
    const int first = take_number(left, text);
    int last = first, step = 1;
    const bool dots = left.substr(0, 2) == "..";
    if (dots || left.substr(0, 1) == "-") {
      left.remove_prefix(dots ? 2 : 1);
      last = take_number(left, text);
      if (last < first) refuse(text, fmt::format("the range {} to {} runs backwards", first, last));
      if (left.substr(0, 1) == "x") {
        left.remove_prefix(1);
        step = take_number(left, text);
        if (step < 1) refuse(text, "a step is 1 or more");
      }
    }
    for (int f = first; f <= last; f += step)
      if (seen.insert(f).second) frames.push_back(f);
    if (frames.size() > most_frames) refuse(text, fmt::format("{} frames are too many", frames.size()));
    if (left.empty()) return frames;
    if (left[0] != ',') refuse(text, fmt::format("{} is not understood", shown_name(left)));
    left.remove_prefix(1);
  }
}

bool has_frame_place(const std::string& pattern) {
  return !places_in(pattern).empty();
}

std::string frame_name(const std::string& pattern, int frame) {
  const std::vector<Place> places = places_in(pattern);
  if (places.empty()) return pattern;
  if (places.size() > 1)
    throw InputError(
        fmt::format("{} has {} places for the frame's number, expected one", shown_name(pattern), places.size()));
  const Place& p = places[0];
  return pattern.substr(0, p.begin) + fmt::format("{:0{}}", frame, p.digits) + pattern.substr(p.begin + p.length);
}

}  // namespace sateen
