#include "layering/rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>

namespace sateen_test {

namespace {

bool starts_with(const std::string& text, const std::string& with) {
  return text.compare(0, with.size(), with) == 0;
}

struct Include {
  int line;
  std::string name;
  bool outside;  ///< in angle brackets
};

std::vector<Include> includes_of(const std::string& text) {
  static const std::regex pattern(R"(^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"])");
  std::vector<Include> all;
  int line = 1;
  for (size_t start = 0; start < text.size(); ++line) {
    const size_t end = std::min(text.find('\n', start), text.size());
    const std::string one = text.substr(start, end - start);
    std::smatch found;
    if (std::regex_search(one, found, pattern)) all.push_back({line, found[2], found[1] == "<"});
    start = end + 1;
  }
  return all;
}

/// "scene" of "lib/scene/camera.h", "app" of "app/main.cpp".
std::string room_of(const std::string& path) {
  if (!starts_with(path, "lib/")) return path.substr(0, path.find('/'));
  const std::string below = path.substr(4);
  return below.substr(0, below.find('/'));
}

std::string joined(const std::vector<std::string>& all) {
  std::string text;
  for (size_t i = 0; i < all.size(); ++i) text += (i ? ", " : "") + all[i];
  return text;
}

void check_outside(const SourceFile& file, const Include& include, std::vector<std::string>& found) {
  for (const OutsideLibrary& library : outside_libraries()) {
    const bool belongs = std::any_of(library.prefixes.begin(), library.prefixes.end(),
                                     [&](const std::string& p) { return starts_with(include.name, p); });
    if (!belongs) continue;
    const bool allowed = std::any_of(library.places.begin(), library.places.end(), [&](const std::string& place) {
      return place.back() == '/' ? starts_with(file.path, place) : file.path == place;
    });
    if (!allowed)
      found.push_back(fmt::format("{}:{}: includes <{}>, but {} stays in {}: call what that place offers instead",
                                  file.path, include.line, include.name, library.name, joined(library.places)));
    return;
  }
  // The C++ and C libraries have no folder in their names; POSIX and Linux have sys/ and linux/.
  const bool from_system = include.name.find('/') == std::string::npos || starts_with(include.name, "sys/") ||
                           starts_with(include.name, "linux/");
  if (!from_system)
    found.push_back(
        fmt::format("{}:{}: includes <{}> of a library without a place: give it one file or one room in "
                    "tests/layering/rules.cpp",
                    file.path, include.line, include.name));
}

void check_inside(const SourceFile& file, const Include& include, const std::vector<std::string>& rooms,
                  const std::set<std::string>& known, std::vector<std::string>& found) {
  const std::string own = room_of(file.path), other = include.name.substr(0, include.name.find('/'));
  const auto floor = [&](const std::string& room) {
    return std::find(rooms.begin(), rooms.end(), room) - rooms.begin();
  };
  const auto say = [&](const std::string& what) {
    found.push_back(fmt::format("{}:{}: includes \"{}\", {}", file.path, include.line, include.name, what));
  };
  if (own == "app") {
    // The program's files name one another without a folder.
    if (include.name.find('/') == std::string::npos) {
      if (!known.count("app/" + include.name)) say("which is not in app/");
      return;
    }
  }
  if (!known.count("lib/" + include.name))
    return say("which is not there: a file is named from lib/, as \"room/file.h\"");
  if (own == "app") return;
  if (size_t(floor(other)) > size_t(floor(own)))
    say(fmt::format("but {} is above {}: a file includes its own room and rooms below it ({})", other, own,
                    joined(rooms)));
}

/// Rooms that include one another around in a circle, as "a -> b -> a"; empty where there is none.
std::string circle(const std::map<std::string, std::set<std::string>>& uses) {
  std::vector<std::string> way;
  std::set<std::string> done;
  std::string found;
  const auto visit = [&](const auto& self, const std::string& room) -> void {
    if (!found.empty() || done.count(room)) return;
    if (const auto at = std::find(way.begin(), way.end(), room); at != way.end()) {
      for (auto i = at; i != way.end(); ++i) found += *i + " -> ";
      found += room;
      return;
    }
    way.push_back(room);
    if (const auto it = uses.find(room); it != uses.end())
      for (const std::string& other : it->second) self(self, other);
    way.pop_back();
    done.insert(room);
  };
  for (const auto& [room, others] : uses) visit(visit, room);
  return found;
}

}  // namespace

std::vector<std::string> rooms_in_order(const std::string& cmake_text) {
  static const std::regex call(R"((^|\n)sateen_room\(([a-z_]+))");
  std::vector<std::string> rooms;
  for (std::sregex_iterator it(cmake_text.begin(), cmake_text.end(), call), end; it != end; ++it)
    rooms.push_back((*it)[2]);
  return rooms;
}

const std::vector<OutsideLibrary>& outside_libraries() {
  static const std::vector<OutsideLibrary> all{
      {"Embree", {"embree"}, {"lib/scene/ray_tracer.cpp"}},
      {"OpenSubdiv", {"opensubdiv/"}, {"lib/mesh/"}},
      {"OpenColorIO", {"OpenColorIO/"}, {"lib/image/color_config.h"}},
      {"OpenImageIO", {"OpenImageIO/"}, {"lib/image/"}},
      {"OpenEXR", {"OpenEXR/", "Imf", "Iex"}, {"lib/image/"}},
      {"nlohmann json", {"nlohmann/"}, {"lib/look/json.cpp"}},
      {"CLI11", {"CLI/"}, {"app/"}},
      {"Cairo", {"cairo"}, {"lib/report/"}},
      {"TBB", {"tbb/", "oneapi/"}, {"lib/base/parallel.cpp"}},
      // half is the pixel type of OpenEXR.
      {"Imath's half", {"Imath/half"}, {"lib/image/"}},
      {"Imath", {"Imath/"}, {"lib/math/vector.h"}},
      {"fmt", {"fmt/"}, {"lib/", "app/"}},
  };
  return all;
}

std::vector<std::string> breaches(const std::vector<SourceFile>& files, const std::vector<std::string>& rooms) {
  std::vector<std::string> found;
  std::set<std::string> known;
  for (const SourceFile& file : files) known.insert(file.path);
  std::map<std::string, std::set<std::string>> uses;
  for (const SourceFile& file : files) {
    const std::string own = room_of(file.path);
    if (own != "app" && std::find(rooms.begin(), rooms.end(), own) == rooms.end())
      found.push_back(fmt::format("{}: lies in no room of lib/CMakeLists.txt ({})", file.path, joined(rooms)));
    for (const Include& include : includes_of(file.text)) {
      if (include.outside) {
        check_outside(file, include, found);
        continue;
      }
      check_inside(file, include, rooms, known, found);
      if (const std::string other = room_of("lib/" + include.name); own != "app" && other != own)
        uses[own].insert(other);
    }
    const auto lines = std::count(file.text.begin(), file.text.end(), '\n');
    if (lines > most_lines)
      found.push_back(fmt::format("{}: has {} lines, expected at most {}: split it by what it does", file.path, lines,
                                  most_lines));
  }
  if (const std::string around = circle(uses); !around.empty())
    found.push_back("rooms include one another in a circle: " + around);
  return found;
}

}  // namespace sateen_test
