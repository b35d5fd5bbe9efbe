#include "look/wif_unused.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace sateen {

namespace {

void append(std::string& list, const std::string& name, const char* separator = ", ") {
  list += (list.empty() ? "" : separator) + name;
}

/// Those that say anything: "COLOR TABLE, Color of WARP".
std::string names_of(const WifText& text, const std::vector<std::string>& sections,
                     const std::vector<std::string>& keys) {
  std::string names;
  for (const std::string& name : sections)
    if (const WifSection* section = text.used(name); section && section->lines > 0) append(names, upper(name));
  for (const std::string& key : keys) {
    std::string of;
    for (const std::string section : {"warp", "weft"})
      if (text.setting(section, key)) append(of, upper(section), " and ");
    if (!of.empty()) append(names, char(std::toupper(key[0])) + key.substr(1) + " of " + of);
  }
  return names;
}

}  // namespace

std::string unused_thread_values(const WifText& text) {
  const std::string colors = names_of(text, {"color table", "warp colors", "weft colors"}, {"color"});
  const std::string sizes = names_of(text, {"warp spacing", "weft spacing", "warp thickness", "weft thickness"},
                                     {"units", "spacing", "thickness"});
  const std::string symbols = names_of(
      text, {"warp symbol table", "weft symbol table", "symbol table", "warp symbols", "weft symbols"}, {"symbol"});
  std::string all;
  const auto add = [&](const char* what, const std::string& names) {
    if (!names.empty())
      append(all, fmt::format("the {} {} ({})", what, all.empty() ? "of its threads" : "of them", names));
  };
  add("colours", colors);
  add("spacing and thickness", sizes);
  add("symbols", symbols);
  if (all.empty()) return {};
  return all + " are not used yet" + (colors.empty() && sizes.empty() ? "" : ", those of the look are");
}

}  // namespace sateen
