#include "mesh/obj_passed_over.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/printable.h"
#include "mesh/check_cage.h"

namespace sateen::obj {

namespace {

template <size_t n>
bool is_one_of(std::string_view word, const std::array<std::string_view, n>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// The shorter names are of the format's version 2.11 and before.
constexpr std::array<std::string_view, 4> surfaces{"surf", "bsp", "bzp", "cdp"};
constexpr std::array<std::string_view, 2> curves{"curv", "cdc"};

std::string shown(std::string_view word) {
  constexpr size_t longest = 80;
  return printable(word.substr(0, longest)) + (word.size() > longest ? "..." : "");
}

}  // namespace

void Count::warn(const std::string& name, const char* thing, const char* one, const char* many,
                 std::vector<std::string>& warnings) const {
  if (count > 0)
    warnings.push_back(fmt::format("{}:{}: {} {}", name, first_line, counted(count, thing), count == 1 ? one : many));
}

void PassedOver::add(Kind& kind, std::string_view word, Text& text) {
  const std::string_view argument = text.next_word();
  if (kind.count == 0) kind.first = word, kind.argument = argument;
  kind.add(text.line());
}

void PassedOver::read(std::string_view key, Text& text) {
  if (is_one_of(key, surfaces)) {
    add(surfaces_, key, text);
  } else if (is_one_of(key, curves)) {
    add(curves_, key, text);
  } else if (key == "l") {
    add(lines_, key, text);
  } else if (key == "p") {
    add(points_, key, text);
    // As many as there are words, of which the first is read.
    while (!text.next_word().empty()) ++points_.count;
  } else if (key == "call") {
    add(calls_, key, text);
  } else if (key == "csh") {
    add(commands_, key, text);
  } else if (static_cast<unsigned char>(key[0]) < 0x20 || static_cast<unsigned char>(key[0]) >= 0x7f) {
    unknown_.add(text.line());
  }
}

void PassedOver::complain_of_no_face(Text& text, const std::string& name, size_t vertices) const {
  std::string held;
  std::string_view place;
  const auto hold = [&](const Kind& kind, const char* thing) {
    if (kind.count == 0) return;
    held += (held.empty() ? "; it holds " : ", ") + counted(kind.count, thing);
    if (place.empty()) place = kind.first;
  };
  hold(surfaces_, "free-form surface");
  hold(curves_, "free-form curve");
  hold(lines_, "line");
  hold(points_, "point");
  if (held.empty() && vertices > 0) held = "; it holds " + counted((long long)vertices, "vertex");
  if (calls_.count > 0) {
    held += fmt::format("; it calls {}, which is not read", shown(calls_.argument));
    if (place.empty()) place = calls_.first;
  }
  const char* help = surfaces_.count + curves_.count > 0
                         ? "export it as polygons, not as free-form surfaces or curves"
                     : lines_.count > 0 ? "export its faces, not its edges alone"
                     : calls_.count > 0 ? "write the files that it calls into one"
                     : vertices > 0     ? "points alone have no surface: export faces too, as lines such as f 1 2 3"
                                        : "meshes are OBJ text with lines such as f 1 2 3: export it as one";
  const std::string message = "holds no face, expected at least one" + held;
  if (place.empty()) throw InputError(name + ": " + message, help);
  text.error_anywhere(place, message, help);
  throw InputError(InputError::Kind::wrong, std::move(text.errors()));
}

void PassedOver::warn(const std::string& name, std::vector<std::string>& warnings) const {
  surfaces_.warn(name, "free-form surface", "is passed over and missing: export it as polygons",
                 "are passed over and missing: export them as polygons", warnings);
  curves_.warn(name, "free-form curve", "is passed over", "are passed over", warnings);
  if (calls_.count > 0)
    warnings.push_back(
        fmt::format("{}:{}: it calls {}, which {} not followed: what is in there is missing", name, calls_.first_line,
                    calls_.count == 1 ? shown(calls_.argument)
                                      : fmt::format("{} files, {} the first", calls_.count, shown(calls_.argument)),
                    calls_.count == 1 ? "is" : "are"));
  commands_.warn(name, "csh command", "is not run", "are not run", warnings);
  unknown_.warn(name, "line", "is not text of an OBJ file: passed over", "are not text of an OBJ file: passed over",
                warnings);
}

}  // namespace sateen::obj
