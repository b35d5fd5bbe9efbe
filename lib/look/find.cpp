#include "look/find.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>

#include "base/error.h"
#include "base/files.h"
#include "base/nearest_name.h"
#include "look/json.h"

namespace sateen {

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> search_folders(const std::vector<fs::path>& extra) {
  std::vector<fs::path> folders{fs::path()};
  folders.insert(folders.end(), extra.begin(), extra.end());
  if (const char* paths = std::getenv("SATEEN_PATH")) {
    std::string_view left = paths;
    while (!left.empty()) {
      const std::string_view one = left.substr(0, left.find(':'));
      left.remove_prefix(std::min(one.size() + 1, left.size()));
      if (one.empty()) continue;
      folders.emplace_back(one);
      folders.push_back(fs::path(one) / "looks");
    }
  }
  try {
    folders.push_back(data_folder() / "looks");
  } catch (const InputError&) {
    // Looks given by path need no data folder.
  }
  return folders;
}

bool is_path(std::string_view name) {
  return name.find('/') != std::string_view::npos || name.ends_with(".json");
}

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

bool exists(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

bool holds_look(const fs::path& path) {
  constexpr std::uint64_t most = 64u << 10;  // a look is a few hundred bytes; a big file here is something else
  try {
    const JsonDocument document = parse_json(read_text_file(path, most), path.string());
    return std::any_of(document.root.items.begin(), document.root.items.end(), [](const JsonValue& item) {
      return item.key == "warp" || item.key == "weft" || item.key == "inherits";
    });
  } catch (const InputError&) {
    return false;
  }
}

[[noreturn]] void refuse(const std::string& name, const std::vector<fs::path>& extra) {
  std::vector<std::string> known;
  for (const LookEntry& entry : list_looks(extra)) known.push_back(entry.name);
  const std::string stem = is_path(name) ? fs::path(name).stem().string() : name;
  const std::string message =
      is_path(name) ? shown_name(name) + ": no such file" : "there is no look called " + shown_name(name);
  std::string help = known.empty() ? "no looks were found: set SATEEN_HOME to the folder that holds looks/ and envmaps/"
                                   : suggestion(stem, known);
  // Long names are mostly half remembered rather than mistyped.
  if (stem.size() >= 3 && nearest_name(stem, known).empty())
    for (const std::string& each : known)
      if (each.find(stem) != std::string::npos) {
        help = fmt::format("did you mean {}?", each);
        break;
      }
  throw InputError(message, help, InputError::Kind::unreadable);
}

// Empty where there is none.
fs::path find_by_name(const std::string& name, const std::vector<fs::path>& extra) {
  for (const fs::path& folder : search_folders(extra))
    if (const fs::path path = folder / (name + ".json"); is_file(path)) return path;
  return {};
}

bool usable(const std::string& name) {
  return !name.empty() && name.find('\0') == std::string::npos;
}

}  // namespace

fs::path find_look(const std::string& name, const std::vector<fs::path>& extra) {
  if (usable(name) && is_path(name)) {
    if (exists(name)) return name;
    if (is_file(name + ".json")) return name + ".json";
    if (name.find('/') == std::string::npos)
      if (const fs::path path = find_by_name(fs::path(name).stem().string(), extra); !path.empty()) return path;
  } else if (usable(name)) {
    if (const fs::path path = find_by_name(name, extra); !path.empty()) return path;
    if (is_file(name)) return name;
  }
  refuse(name, extra);
}

fs::path find_look_beside(const std::string& name, const std::string& file, const std::vector<fs::path>& extra) {
  const fs::path folder = fs::path(file).parent_path();
  if (usable(name) && !fs::path(name).is_absolute()) {
    if (is_path(name) && is_file(folder / name)) return folder / name;
    if (is_file(folder / (name + ".json"))) return folder / (name + ".json");
  }
  return find_look(name, extra);
}

std::vector<LookEntry> list_looks(const std::vector<fs::path>& extra) {
  std::map<std::string, fs::path> found;
  for (const fs::path& folder : search_folders(extra)) {
    std::error_code code;
    fs::directory_iterator files(folder.empty() ? fs::path(".") : folder, code);
    if (code) continue;
    const bool looks_only = folder.filename() == "looks";
    for (; files != fs::directory_iterator(); files.increment(code)) {
      if (code) break;
      const fs::path name = files->path().filename();
      if (name.extension() != ".json" || !is_file(files->path())) continue;
      if (found.contains(name.stem().string())) continue;
      if (looks_only || holds_look(files->path())) found.emplace(name.stem().string(), folder / name);
    }
  }
  std::vector<LookEntry> entries;
  for (auto& [name, path] : found) entries.push_back({name, path});
  return entries;
}

}  // namespace sateen
