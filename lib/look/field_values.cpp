#include "look/field_values.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "base/nearest_name.h"
#include "look/draft.h"
#include "look/read_texture.h"

namespace sateen {

namespace {

using Kind = JsonValue::Kind;

std::string found(const JsonValue& value) {
  switch (value.kind) {
    case Kind::null:
      return "null";
    case Kind::boolean:
      return value.boolean ? "true" : "false";
    case Kind::number:
      return shown_name(value.text);
    case Kind::text:
      return "the text " +
             (shown_name(value.text).starts_with('"') ? shown_name(value.text) : '"' + shown_name(value.text) + '"');
    case Kind::list:
      return fmt::format("a list of {}", value.items.size());
    case Kind::object:
      return "an object";
  }
  return {};
}

// A slipped decimal point, a lost sign, percent, or radians where degrees are meant.
std::string nearby(const Field& field, double value) {
  const auto inside = [&](double x) { return x >= field.low && x <= field.high; };
  if (field.unit == "degrees" && value > 0 && value < field.low)
    if (const double degrees_meant = value * 180 / std::numbers::pi; inside(degrees_meant))
      return fmt::format("did you mean {:.3g}? ({:g} radians)", degrees_meant, value);
  for (const double candidate : {value / 10, value * 10, value / 100, value * 100, -value})
    if (inside(candidate) && candidate != 0) return fmt::format("did you mean {:.6g}?", candidate);
  return {};
}

// The number as the nearest float, not rounded twice. -0 becomes 0.
float nearest_float(const JsonValue& value) {
  float number = 0;
  const auto result = std::from_chars(value.text.data(), value.text.data() + value.text.size(), number);
  if (result.ec != std::errc()) number = float(value.number);
  return number + 0.0f;
}

std::string as_range(const Field& field) {
  const std::string range = range_text(field);
  return range.ends_with("more") ? "of " + range : "from " + range;
}

bool read_number(float& to, const Field& field, const JsonValue& value, std::string_view name, const Report& report) {
  if (value.kind != Kind::number) {
    report(value.place, fmt::format("{} is {}, expected a number {}", name, found(value), as_range(field)), {});
    return false;
  }
  if (!(value.number >= field.low && value.number <= field.high)) {
    report(value.place, fmt::format("{} is {}, expected {}", name, shown_name(value.text), range_text(field)),
           nearby(field, value.number));
    return false;
  }
  to = nearest_float(value);
  return true;
}

bool read_numbers(std::vector<float>& to, const Field& field, const JsonValue& value, std::string_view name,
                  const Report& report) {
  // The number of lengths follows from that of the offsets; here only a count that can never be right.
  const size_t fewest = field.key == "offsets_deg" ? fewest_offsets : fewest_offsets - 1;
  const size_t most = field.key == "offsets_deg" ? most_offsets : most_offsets - 1;
  if (value.kind != Kind::list || value.items.size() < fewest || value.items.size() > most) {
    report(value.place,
           fmt::format("{} is {}, expected a list of {} to {} numbers", name, found(value), fewest, most), {});
    return false;
  }
  std::vector<float> read(value.items.size());
  bool good = true;
  for (size_t i = 0; i < read.size(); ++i)
    good = read_number(read[i], field, value.items[i], fmt::format("{}[{}]", name, i), report) && good;
  if (good) to = std::move(read);
  return good;
}

bool read_triple(Color& to, const Field& field, const JsonValue& value, std::string_view name, const Report& report) {
  if (value.kind != Kind::list || value.items.size() != 3) {
    report(value.place, fmt::format("{} is {}, expected three numbers [red, green, blue]", name, found(value)), {});
    return false;
  }
  constexpr const char* channels[] = {"red", "green", "blue"};
  bool good = true;
  for (int i = 0; i < 3; ++i) {
    const JsonValue& item = value.items[size_t(i)];
    const Report with_help{[&](const JsonPlace& place, std::string message, std::string help, bool) {
      if (item.kind == Kind::number && field.high == 1 && item.number > 1 && item.number <= 255)
        help = "colours go from 0 to 1, not to 100 or 255";
      report(place, std::move(message), std::move(help));
    }};
    good = read_number(to[i], field, item, fmt::format("{} of {}", channels[i], name), with_help) && good;
  }
  return good;
}

bool read_color(ColorValue& to, const Field& field, const JsonValue& value, std::string_view name,
                const Report& report) {
  ColorValue read;
  bool good = true;
  if (value.kind == Kind::object) {
    const JsonValue* triple = value.find("value");
    if (!triple) {
      report(value.place,
             fmt::format("{} has no \"value\", expected {{\"value\": [red, green, blue], \"space\": ...}}", name),
             {});
      good = false;
    }
    for (const JsonValue& item : value.items) {
      if (item.key == "value") {
        good = read_triple(read.value, field, item, name, report) && good;
      } else if (item.key == "space") {
        if (item.kind == Kind::text && !item.text.empty()) {
          read.space = item.text;
        } else {
          report(item.place, fmt::format("space of {} is {}, expected the name of a colour space", name, found(item)),
                 {});
          good = false;
        }
      } else {
        report(item.key_place, fmt::format("unknown key {} in {}", shown_name(item.key), name),
               suggestion(item.key, {"value", "space"}));
        good = false;
      }
    }
  } else {
    good = read_triple(read.value, field, value, name, report);
  }
  if (good) to = std::move(read);
  return good;
}

bool read_text(std::string& to, const Field& field, const JsonValue& value, std::string_view name,
               const Report& report) {
  if (value.kind != Kind::text || (field.kind == FieldKind::name && value.text.empty())) {
    const char* expected = field.kind == FieldKind::name        ? "a name"
                           : field.kind == FieldKind::look_name ? "the name of a look"
                                                                : "a text";
    report(value.place, fmt::format("{} is {}, expected {}", name, found(value), expected), {});
    return false;
  }
  to = value.text;
  return true;
}

bool read_draft(std::vector<std::string>& to, const JsonValue& value, std::string_view name, const Report& report) {
  std::vector<std::string> read;
  if (value.kind == Kind::text)
    read.push_back(value.text);
  else if (value.kind == Kind::list)
    for (const JsonValue& item : value.items)
      if (item.kind == Kind::text) read.push_back(item.text);
  if (read.empty() || (value.kind == Kind::list && read.size() != value.items.size())) {
    report(value.place,
           fmt::format("{} is {}, expected a text such as \"satin 5/2\", or a list of rows of x and .", name,
                       found(value)),
           {});
    return false;
  }
  if (read.size() == 1 && read[0].empty()) read.clear();  // no draft
  try {
    if (!read.empty() && !is_draft_file(read)) parse_draft(read);
  } catch (const InputError& error) {
    report(value.place, error.diagnostics.front().message, error.diagnostics.front().help);
    return false;
  }
  to = std::move(read);
  return true;
}

struct MemberText {
  std::string operator()(const std::string& text) const { return json_quote(text); }
  std::string operator()(float number) const { return fmt::format("{}", number + 0.0f); }
  std::string operator()(const ColorValue& color) const {
    const std::string triple =
        fmt::format("[{}, {}, {}]", (*this)(color.value.x), (*this)(color.value.y), (*this)(color.value.z));
    if (color.space.empty()) return triple;
    return fmt::format("{{\"value\": {}, \"space\": {}}}", triple, json_quote(color.space));
  }
  std::string operator()(const std::optional<ColorValue>& color) const {
    return color ? (*this)(*color) : std::string();
  }
  std::string operator()(const std::vector<float>& numbers) const {
    std::string text = "[";
    for (size_t i = 0; i < numbers.size(); ++i) {
      if (i) text += ", ";
      text += (*this)(numbers[i]);
    }
    return text + "]";
  }
  std::string operator()(const std::vector<std::string>& texts) const {
    if (texts.size() < 2) return json_quote(texts.empty() ? "" : texts[0]);
    std::string text = "[";
    for (size_t i = 0; i < texts.size(); ++i) text += (i ? ", " : "") + json_quote(texts[i]);
    return text + "]";
  }
};

}  // namespace

namespace {

/// Members of a texture that say what lies under it: of the field's own kind, and a family's other way to say a
/// colour.
constexpr std::string_view under_key = "under", under_scale_key = "under_A", under_color_key = "under_color";

/// A texture in place of a value: the field keeps what it is without, for where the picture is transparent.
bool set_texture(Look& look, const Field& field, const JsonValue& value, std::string_view name,
                 const Report& report) {
  TextureValue read;
  if (!read_texture(read, field, value, name, look.file, report)) return false;
  Look changed = look;
  for (const JsonValue& item : value.items) {
    const bool other = item.key == under_scale_key || item.key == under_color_key;
    if (!other && item.key != under_key) continue;
    if (item.find("texture")) {
      report(item.place, fmt::format("{} of the texture of {} is a texture, expected a plain value", item.key, name),
             {});
      return false;
    }
    const std::string group = field.group.empty() ? "" : field.group + ".";
    const Field* under = &field;
    if (other) under = find_field(group + (item.key == under_scale_key ? "A" : "color"));
    if (!set_field(changed, *under, item, fmt::format("{} of the texture of {}", item.key, name), report))
      return false;
  }
  look = std::move(changed);
  const auto put = [&](const std::string& group, bool color) {
    for (const char* key : {".A", ".color"})
      if (color) look.textures.erase(group + key);
    look.textures[group.empty() ? field.key : group + "." + field.key] = read;
  };
  if (field.is_shorthand()) {
    put("warp", true);
    put("weft", true);
  } else {
    put(field.group, field.family && field.kind == FieldKind::color);
  }
  return true;
}

/// The member of a texture's text that says what lies under it; empty where that is a field's default.
std::string under_text(const Look& look, const Field& field) {
  std::string text, initial;
  std::string_view key = under_key;
  if (field.kind == FieldKind::color) {
    const ThreadFamily& family = look.*field.family;
    if (!family.color && family.A.value == ThreadFamily().A.value) return {};
    text = family.color ? MemberText()(*family.color) : MemberText()(family.A);
    if (field.key == "A" && family.color) key = under_color_key;
    if (field.key != "A" && !family.color) key = under_scale_key;
  } else {
    const Look defaults;
    visit_member(look, field, [&](const auto& member) { text = MemberText()(member); });
    visit_member(defaults, field, [&](const auto& member) { initial = MemberText()(member); });
    if (text == initial) return {};
  }
  return fmt::format(", \"{}\": {}", key, text);
}

std::string with_under(std::string texture, const Look& look, const Field& field) {
  texture.insert(texture.size() - 1, under_text(look, field));
  return texture;
}

}  // namespace

bool set_field(Look& look, const Field& field, const JsonValue& value, std::string_view name, const Report& report) {
  if (value.kind == Kind::object && value.find("texture")) return set_texture(look, field, value, name, report);
  if (const auto* both = std::get_if<OfBothFamilies>(&field.member)) {
    ColorValue read;
    if (!read_color(read, field, value, name, report)) return false;
    for (ThreadFamily* family : {&look.warp, &look.weft}) {
      family->*(both->member) = read;
      family->A = ThreadFamily().A;
    }
    for (const char* path : {"warp.A", "warp.color", "weft.A", "weft.color"}) look.textures.erase(path);
    return true;
  }
  bool good = false;
  visit_member(look, field, [&](auto& member) {
    using Member = std::decay_t<decltype(member)>;
    if constexpr (std::is_same_v<Member, std::string>) {
      good = read_text(member, field, value, name, report);
    } else if constexpr (std::is_same_v<Member, float>) {
      good = read_number(member, field, value, name, report);
    } else if constexpr (std::is_same_v<Member, std::vector<float>>) {
      good = read_numbers(member, field, value, name, report);
    } else if constexpr (std::is_same_v<Member, std::vector<std::string>>) {
      good = read_draft(member, value, name, report);
    } else if constexpr (std::is_same_v<Member, ColorValue>) {
      good = read_color(member, field, value, name, report);
      if (good) (look.*field.family).color.reset();
    } else {
      ColorValue read;
      good = read_color(read, field, value, name, report);
      if (good) {
        member = std::move(read);
        (look.*field.family).A = ThreadFamily().A;
      }
    }
  });
  if (good) look.textures.erase(field.path);
  if (good && field.family && field.kind == FieldKind::color)
    for (const char* key : {".A", ".color"}) look.textures.erase(field.group + key);
  return good;
}

std::string field_text(const Look& look, const Field& field) {
  if (field.is_shorthand()) return {};
  if (const auto texture = look.textures.find(field.path); texture != look.textures.end())
    return with_under(texture_text(texture->second, look.file), look, field);
  if (std::holds_alternative<ColorValue ThreadFamily::*>(field.member) &&
      ((look.*field.family).color || look.textures.contains(field.group + ".color")))
    return {};
  if (std::holds_alternative<std::optional<ColorValue> ThreadFamily::*>(field.member) &&
      look.textures.contains(field.group + ".A"))
    return {};
  std::string text;
  visit_member(look, field, [&](const auto& member) { text = MemberText()(member); });
  return text;
}

std::string canonical_text(const Look& look, const Field& field) {
  Look pinned = look;
  pin_color_spaces(pinned);
  if (const auto texture = look.textures.find(field.path); texture != look.textures.end())
    return with_under(texture_identity(texture->second), pinned, field);
  if (field.kind != FieldKind::color) return field_text(look, field);
  return field_text(pinned, field);
}

std::string range_text(const Field& field) {
  if (std::isinf(field.low)) return {};
  if (std::isinf(field.high)) return fmt::format("{:g} or more", field.low);
  return fmt::format("{:g} to {:g}", field.low, field.high);
}

void pin_color_spaces(Look& look) {
  for (const Field& field : fields())
    visit_member(look, field, [&](auto& member) {
      using Member = std::decay_t<decltype(member)>;
      if constexpr (std::is_same_v<Member, ColorValue>) {
        if (member.space.empty()) member.space = look.color_space;
      } else if constexpr (std::is_same_v<Member, std::optional<ColorValue>>) {
        if (member && member->space.empty()) member->space = look.color_space;
      }
    });
}

}  // namespace sateen
