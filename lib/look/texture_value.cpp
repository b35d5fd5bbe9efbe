#include "look/texture_value.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/files.h"
#include "look/json.h"

namespace sateen {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view udim_mark = "<UDIM>";
constexpr std::uint64_t most_bytes = 4ull << 30;

/// The members beside the file, those that are not as they are anyway.
std::string settings_text(const TextureValue& t) {
  std::string text;
  if (!t.space.empty()) text += fmt::format(", \"space\": {}", json_quote(t.space));
  if (!t.layer.empty()) text += fmt::format(", \"layer\": {}", json_quote(t.layer));
  if (t.scale != 1) text += fmt::format(", \"scale\": {}", t.scale + 0.0f);
  if (t.offset != 0) text += fmt::format(", \"offset\": {}", t.offset);
  if (t.repeat != std::array<float, 2>{1, 1}) text += fmt::format(", \"repeat\": [{}, {}]", t.repeat[0], t.repeat[1]);
  if (is_sized(t)) text += fmt::format(", \"repeat_cm\": [{}, {}]", t.repeat_cm[0], t.repeat_cm[1]);
  if (t.wrap != TextureWrap::repeat) text += fmt::format(", \"wrap\": \"{}\"", wrap_names()[size_t(t.wrap)]);
  return text;
}

}  // namespace

const std::vector<std::string>& wrap_names() {
  static const std::vector<std::string> names{"repeat", "clamp", "mirror"};
  return names;
}

bool is_udim(const std::string& path) {
  return path.find(udim_mark) != std::string::npos;
}

std::vector<TextureFile> texture_files(const std::string& path) {
  std::vector<TextureFile> files;
  std::error_code ignored;
  if (!is_udim(path)) {
    if (fs::is_regular_file(path, ignored)) files.push_back({0, 0, path});
    return files;
  }
  const fs::path whole(path);
  const std::string name = whole.filename().string();
  const size_t mark = name.find(udim_mark);
  if (mark == std::string::npos) return files;
  const std::string before = name.substr(0, mark), after = name.substr(mark + udim_mark.size());
  for (fs::directory_iterator entry(whole.parent_path(), ignored), end; entry != end; entry.increment(ignored)) {
    const std::string found = entry->path().filename().string();
    if (found.size() != before.size() + 4 + after.size() || !found.starts_with(before) || !found.ends_with(after))
      continue;
    const std::string digits = found.substr(before.size(), 4);
    if (!std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; })) continue;
    const int number = std::stoi(digits) - 1001;
    if (number >= 0 && entry->is_regular_file(ignored)) files.push_back({number % 10, number / 10, entry->path()});
  }
  std::sort(files.begin(), files.end(), [](const TextureFile& a, const TextureFile& b) { return a.path < b.path; });
  return files;
}

std::string texture_text(const TextureValue& texture, const std::string& look_file) {
  std::error_code ignored;
  const fs::path folder = fs::absolute(look_file, ignored).parent_path().lexically_normal();
  const fs::path near = fs::path(texture.path).lexically_relative(folder);
  const std::string path = look_file.empty() || near.empty() ? texture.path : near.string();
  return fmt::format("{{\"texture\": {}{}}}", json_quote(path), settings_text(texture));
}

std::string texture_identity(const TextureValue& texture) {
  Hash hash;
  for (const TextureFile& file : texture_files(texture.path)) {
    if (is_udim(texture.path)) hash.add(fmt::format("{} {} ", file.u, file.v));
    hash.add(read_text_file(file.path, most_bytes));
  }
  return fmt::format("{{\"texture\": \"{}\"{}}}", hash.hex(), settings_text(texture));
}

}  // namespace sateen
