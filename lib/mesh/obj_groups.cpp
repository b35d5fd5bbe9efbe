#include "mesh/obj_groups.h"

#include <fmt/format.h>

namespace sateen::obj {

namespace {

constexpr size_t most_names = 5, longest_name = 40;

/// Bytes of the UTF-8 character at the start of a text, 0 where there is none or it controls a terminal.
size_t printable(std::string_view text) {
  const auto byte = [&](size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned first = byte(0);
  if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : 0;
  const size_t length = first >= 0xc2 && first < 0xe0   ? 2
                        : first >= 0xe0 && first < 0xf0 ? 3
                        : first >= 0xf0 && first < 0xf5 ? 4
                                                        : 0;
  for (size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  return first == 0xc2 && byte(1) < 0xa0 ? 0 : length;
}

std::string printable_name(std::string_view name) {
  std::string out;
  for (size_t i = 0; i < name.size();) {
    if (i >= longest_name) return out + "...";
    const size_t length = printable(name.substr(i));
    out += length > 0 ? name.substr(i, length) : "?";
    i += std::max<size_t>(length, 1);
  }
  return out.empty() ? "without a name" : out;
}

}  // namespace

void Groups::begin(std::string_view key, Text& text) {
  std::string_view first, last;
  for (std::string_view word = text.next_word(); !word.empty(); word = text.next_word()) {
    if (first.empty()) first = word;
    last = word;
  }
  Kind& kind = key == "usemtl" ? materials_ : key == "o" ? objects_ : groups_;
  kind.current =
      first.empty() ? first : std::string_view(first.data(), size_t(last.data() + last.size() - first.data()));
  kind.has_faces = false;
}

void Groups::add_face() {
  for (Kind* kind : {&materials_, &objects_, &groups_}) {
    if (kind->has_faces) continue;
    kind->has_faces = true;
    if (kind->met.insert(kind->current).second && kind->first.size() < most_names)
      kind->first.push_back(kind->current);
  }
}

std::string Groups::told() const {
  const char* what = "materials";
  const Kind* kind = &materials_;
  if (kind->met.size() < 2) what = "objects", kind = &objects_;
  if (kind->met.size() < 2) what = "groups", kind = &groups_;
  if (kind->met.size() < 2) return {};
  std::string names;
  for (const std::string_view name : kind->first) names += (names.empty() ? "" : ", ") + printable_name(name);
  if (kind->met.size() > kind->first.size()) names += ", ...";
  return fmt::format("its {} {} ({}) are all rendered with one look", kind->met.size(), what, names);
}

}  // namespace sateen::obj
