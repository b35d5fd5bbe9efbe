#include "look/read_texture.h"

#include <fmt/format.h>

#include <cmath>

#include "base/nearest_name.h"

namespace sateen {

namespace fs = std::filesystem;

namespace {

using Kind = JsonValue::Kind;

struct Reader {
  std::string_view name;
  const Report& report;
  bool good = true;

  void fault(const JsonPlace& place, std::string message, std::string help = {}, bool missing = false) {
    report(place, std::move(message), std::move(help), missing);
    good = false;
  }

  void number(float& to, const JsonValue& item, double low, double high, std::string_view what) {
    if (item.kind != Kind::number || !(item.number >= low && item.number <= high))
      return fault(item.place,
                   fmt::format("{} of the texture of {} is {}, expected a number from {:g} to {:g}", what, name,
                               item.kind == Kind::number ? shown_name(item.text) : "none", low, high));
    to = float(item.number) + 0.0f;
  }

  void pair(std::array<float, 2>& to, const JsonValue& item, double low, double high, const std::string& expected) {
    if (item.kind != Kind::list || item.items.size() != 2)
      return fault(item.place,
                   fmt::format("{} of {} is no list of two numbers, expected {}", item.key, name, expected));
    for (size_t i = 0; i < 2; ++i) number(to[i], item.items[i], low, high, item.key);
  }

  void text(std::string& to, const JsonValue& item, std::string_view expected) {
    if (item.kind != Kind::text || item.text.empty() || item.text.find('\0') != std::string::npos)
      return fault(item.place, fmt::format("{} of {} is no text, expected {}", item.key, name, expected));
    to = item.text;
  }
};

// What the folder holds that is spelled most alike.
std::string nearest_file(const fs::path& path) {
  std::vector<std::string> names;
  std::error_code ignored;
  constexpr size_t most = 1000;
  for (fs::directory_iterator entry(path.parent_path(), ignored), end; entry != end && names.size() < most;
       entry.increment(ignored))
    names.push_back(entry->path().filename().string());
  const std::string near = nearest_name(path.filename().string(), names);
  return near.empty() ? "paths are taken from the look file's folder" : fmt::format("did you mean {}?", near);
}

void settle_path(Reader& reader, TextureValue& texture, const JsonValue& item, const std::string& look_file) {
  std::error_code code;
  const fs::path path =
      (fs::absolute(look_file.empty() ? "." : look_file, code).parent_path() / texture.path).lexically_normal();
  texture.path = path.string();
  if (!texture_files(texture.path).empty()) return;
  if (is_udim(texture.path))
    return reader.fault(item.place, fmt::format("there is no texture {} of any number", shown_name(item.text)),
                        "<UDIM> stands for 1001, 1002 ... in the file's name", true);
  const bool exists = fs::exists(path, code);
  reader.fault(item.place,
               exists ? fmt::format("the texture {} is not a regular file", shown_name(item.text))
                      : fmt::format("there is no texture {}", shown_name(item.text)),
               exists ? "" : nearest_file(path), true);
}

}  // namespace

bool read_texture(TextureValue& to, const Field& field, const JsonValue& value, std::string_view name,
                  const std::string& look_file, const Report& report) {
  Reader reader{name, report};
  if (!field.mappable) {
    reader.fault(value.place, fmt::format("{} cannot be a texture", name), "colours and most numbers can");
    return false;
  }
  constexpr double most = 1e6, least_repeat = 1e-3, most_repeat = 1e4, least_cm = 1e-3, most_cm = 1e5;
  TextureValue texture;
  const JsonValue *repeats = nullptr, *sizes = nullptr;
  const bool color = field.kind == FieldKind::color, family_color = color && field.family;
  for (const JsonValue& item : value.items) {
    if (item.key == "texture") {
      reader.text(texture.path, item, "the path of a picture");
      if (!texture.path.empty()) settle_path(reader, texture, item, look_file);
    } else if (item.key == "space" && color) {
      reader.text(texture.space, item, "the name of a colour space");
    } else if (item.key == "space") {
      reader.fault(item.key_place,
                   fmt::format("the texture of {} has a space, but numbers are taken as they are", name),
                   "drop it, and scale with \"scale\" and \"offset\"");
    } else if (item.key == "layer") {
      reader.text(texture.layer, item, "the name of a layer of an OpenEXR file");
    } else if (item.key == "scale") {
      reader.number(texture.scale, item, -most, most, "scale");
    } else if (item.key == "offset") {
      reader.number(texture.offset, item, -most, most, "offset");
    } else if (item.key == "repeat") {
      reader.pair(texture.repeat, item, least_repeat, most_repeat, "[along u, along v]");
      repeats = &item;
    } else if (item.key == "repeat_cm") {
      reader.pair(texture.repeat_cm, item, least_cm, most_cm, "[centimetres along u, centimetres along v]");
      sizes = &item;
    } else if (item.key == "wrap") {
      const auto& names = wrap_names();
      const auto found = std::find(names.begin(), names.end(), item.kind == Kind::text ? item.text : std::string());
      if (found == names.end())
        reader.fault(item.place,
                     fmt::format("wrap of {} is {}, expected repeat, clamp or mirror", name, shown_name(item.text)),
                     suggestion(item.text, names));
      else
        texture.wrap = TextureWrap(found - names.begin());
    } else if (item.key == "under" || (family_color && item.key == (field.key == "A" ? "under_color" : "under_A"))) {
      continue;  // a value like any other, which set_field() reads
    } else {
      reader.fault(item.key_place, fmt::format("unknown key {} in the texture of {}", shown_name(item.key), name),
                   suggestion(item.key, {"texture", "space", "layer", "scale", "offset", "repeat", "repeat_cm",
                                         "wrap", "under"}));
    }
  }
  if (color && texture.space.empty() && reader.good)
    reader.fault(value.place, fmt::format("the texture of {} does not say in which colour space it is", name),
                 "add \"space\": \"srgb_texture\" for most pictures, \"lin_rec709\" for most OpenEXR files");
  if (repeats && sizes)
    reader.fault(sizes->key_place,
                 fmt::format("the texture of {} has repeat and repeat_cm, expected one of them", name),
                 "repeat counts copies in a unit of the UVs, repeat_cm is the size of one on the cloth");
  if (is_udim(texture.path) &&
      (texture.repeat != std::array<float, 2>{1, 1} || sizes || texture.wrap != TextureWrap::repeat))
    reader.fault(value.place, fmt::format("the texture of {} has <UDIM> and repeat, repeat_cm or wrap, expected one "
                                          "of them",
                                          name));
  if (reader.good) to = std::move(texture);
  return reader.good;
}

}  // namespace sateen
