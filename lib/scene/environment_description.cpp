#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/files.h"
#include "base/nearest_name.h"
#include "image/chromaticities.h"
#include "look/json.h"
#include "scene/environment_make.h"

namespace sateen {

namespace {
using Kind = JsonValue::Kind;

const char* kind_name(Kind kind) {
  switch (kind) {
    case Kind::null:
      return "null";
    case Kind::boolean:
      return "a boolean";
    case Kind::number:
      return "a number";
    case Kind::text:
      return "a text";
    case Kind::list:
      return "a list";
    case Kind::object:
      return "an object";
  }
  return "nothing";
}

// Reads the members of one object and collects what is wrong with them.
class Reader {
 public:
  Reader(const JsonDocument& document, std::vector<Diagnostic>& problems)
      : document_(document), problems_(problems) {}

  void complain(const JsonPlace& place, std::string message, std::string help = {}) {
    problems_.push_back(diagnostic_at(document_, place, std::move(message), std::move(help)));
  }

  bool is(const JsonValue& value, Kind expected) {
    if (value.kind == expected) return true;
    complain(value.place,
             fmt::format("{} is {}, expected {}", label(value), kind_name(value.kind), kind_name(expected)));
    return false;
  }

  void check_keys(const JsonValue& object, const std::vector<std::string>& known) {
    for (const JsonValue& member : object.items)
      if (std::find(known.begin(), known.end(), member.key) == known.end())
        complain(member.key_place, fmt::format("unknown key \"{}\"", shown_name(member.key)),
                 suggestion(member.key, known));
  }

  void number(const JsonValue& object, const char* key, float& out, double low, double high) {
    const JsonValue* value = object.find(key);
    if (value && is(*value, Kind::number) && in_range(*value, low, high)) out = float(value->number);
  }

  void text(const JsonValue& object, const char* key, std::string& out) {
    const JsonValue* value = object.find(key);
    if (value && is(*value, Kind::text)) out = value->text;
  }

  std::optional<Color> color(const JsonValue& value) {
    if (!is(value, Kind::list)) return std::nullopt;
    if (value.items.size() != 3) {
      complain(value.place, fmt::format("{} has {} numbers, expected 3", label(value), value.items.size()));
      return std::nullopt;
    }
    Color c;
    for (size_t i = 0; i < 3; ++i) {
      if (!is(value.items[i], Kind::number) || !in_range(value.items[i], 0, 1e6)) return std::nullopt;
      c[int(i)] = float(value.items[i].number);
    }
    return c;
  }

  bool in_range(const JsonValue& value, double low, double high) {
    if (value.number >= low && value.number <= high) return true;
    complain(value.place, fmt::format("{} is {}, expected {} to {}", label(value), value.text, low, high));
    return false;
  }

  static std::string label(const JsonValue& value) { return value.key.empty() ? "this value" : value.key; }

 private:
  const JsonDocument& document_;
  std::vector<Diagnostic>& problems_;
};

struct KindFields {
  const char* name;
  MapLight::Kind kind;
  std::vector<std::string> keys;
};

const std::vector<KindFields>& kinds() {
  static const std::vector<KindFields> all{
      {"uniform", MapLight::Kind::uniform, {"color", "kelvin", "intensity"}},
      {"gradient", MapLight::Kind::gradient, {"stops", "intensity"}},
      {"softbox",
       MapLight::Kind::softbox,
       {"color", "kelvin", "intensity", "azimuth_deg", "elevation_deg", "width_deg", "height_deg", "roll_deg", "edge",
        "hot"}},
      {"disc",
       MapLight::Kind::disc,
       {"color", "kelvin", "intensity", "azimuth_deg", "elevation_deg", "width_deg", "edge"}},
      {"glow", MapLight::Kind::glow, {"color", "kelvin", "intensity", "azimuth_deg", "elevation_deg", "width_deg"}}};
  return all;
}

void read_stops(Reader& reader, const JsonValue& light, MapLight& out) {
  const JsonValue* stops = light.find("stops");
  if (!stops) {
    reader.complain(light.place, "a gradient needs stops, a list of {\"elevation_deg\": ..., \"color\": [...]}");
    return;
  }
  if (!reader.is(*stops, Kind::list)) return;
  for (const JsonValue& item : stops->items) {
    if (!reader.is(item, Kind::object)) continue;
    reader.check_keys(item, {"elevation_deg", "color"});
    MapLight::Stop stop;
    reader.number(item, "elevation_deg", stop.elevation_deg, -90, 90);
    if (const JsonValue* color = item.find("color")) stop.color = reader.color(*color).value_or(stop.color);
    if (!out.stops.empty() && stop.elevation_deg <= out.stops.back().elevation_deg)
      reader.complain(item.place, fmt::format("elevation_deg is {}, expected above the stop before it, {}",
                                              stop.elevation_deg, out.stops.back().elevation_deg));
    out.stops.push_back(stop);
  }
  if (stops->items.empty()) reader.complain(stops->place, "stops is empty, expected at least one");
}

void read_color(Reader& reader, const JsonValue& light, const std::string& space, MapLight& out) {
  const JsonValue *color = light.find("color"), *kelvin = light.find("kelvin");
  if (color && kelvin) reader.complain(kelvin->key_place, "color and kelvin are both given, expected one of them");
  if (color) out.color = reader.color(*color).value_or(out.color);
  if (!kelvin || !reader.is(*kelvin, Kind::number) || !reader.in_range(*kelvin, 1000, 15000)) return;
  out.color = black_body_rec709(float(kelvin->number));
  if (space != "acescg") return;
  const Matrix3 m = multiply(inverse(to_aces2065_1(ap1_chromaticities)), to_aces2065_1(rec709_chromaticities));
  const Color c = out.color;
  for (int i = 0; i < 3; ++i)
    out.color[i] =
        float(m[size_t(i)][0] * double(c.x) + m[size_t(i)][1] * double(c.y) + m[size_t(i)][2] * double(c.z));
}

void read_light(Reader& reader, const JsonValue& value, MapDescription& out) {
  if (!reader.is(value, Kind::object)) return;
  const JsonValue* kind = value.find("kind");
  std::vector<std::string> names;
  for (const KindFields& k : kinds()) names.push_back(k.name);
  if (!kind) {
    reader.complain(value.place, "a light needs a kind", suggestion("", names));
    return;
  }
  if (!reader.is(*kind, Kind::text)) return;
  const auto found =
      std::find_if(kinds().begin(), kinds().end(), [&](const KindFields& k) { return kind->text == k.name; });
  if (found == kinds().end()) {
    reader.complain(kind->place, fmt::format("unknown kind of light \"{}\"", shown_name(kind->text)),
                    suggestion(kind->text, names));
    return;
  }
  std::vector<std::string> keys = found->keys;
  keys.insert(keys.end(), {"kind", "comment"});
  reader.check_keys(value, keys);
  MapLight light;
  light.kind = found->kind;
  reader.number(value, "azimuth_deg", light.azimuth_deg, -360, 360);
  reader.number(value, "elevation_deg", light.elevation_deg, -90, 90);
  reader.number(value, "width_deg", light.width_deg, 0.01, 170);
  reader.number(value, "height_deg", light.height_deg, 0.01, 170);
  reader.number(value, "roll_deg", light.roll_deg, -360, 360);
  reader.number(value, "edge", light.edge, 0, 1);
  reader.number(value, "hot", light.hot, 0, 1);
  reader.number(value, "intensity", light.intensity, 0, 1e9);
  if (light.kind == MapLight::Kind::gradient)
    read_stops(reader, value, light);
  else
    read_color(reader, value, out.color_space, light);
  out.lights.push_back(std::move(light));
}

void read_size(Reader& reader, const JsonValue& size, MapDescription& out) {
  if (!reader.is(size, Kind::list)) return;
  if (size.items.size() != 2) {
    reader.complain(size.place, fmt::format("size has {} numbers, expected 2, width and height", size.items.size()));
    return;
  }
  int* const sides[2] = {&out.width, &out.height};
  for (size_t i = 0; i < 2; ++i) {
    const JsonValue& side = size.items[i];
    if (!reader.is(side, Kind::number) || !reader.in_range(side, 1, i == 0 ? 16384 : 8192)) continue;
    if (side.number != std::floor(side.number))
      reader.complain(side.place, fmt::format("size is {}, expected a whole number", side.text));
    else
      *sides[i] = int(side.number);
  }
}
}  // namespace

MapDescription parse_map_description(const std::string& text, const std::string& file) {
  const JsonDocument document = parse_json(text, file);
  std::vector<Diagnostic> problems = document.problems;
  Reader reader(document, problems);
  MapDescription out;
  const JsonValue& root = document.root;
  if (reader.is(root, Kind::object)) {
    reader.check_keys(root, {"title", "description", "size", "color_space", "metered", "lights"});
    reader.text(root, "title", out.title);
    reader.text(root, "description", out.description);
    reader.text(root, "color_space", out.color_space);
    if (out.color_space != "lin_rec709" && out.color_space != "acescg")
      reader.complain(
          root.find("color_space")->place,
          fmt::format("color_space is \"{}\", expected \"lin_rec709\" or \"acescg\"", shown_name(out.color_space)));
    if (const JsonValue* size = root.find("size")) read_size(reader, *size, out);
    if (const JsonValue* metered = root.find("metered"); metered && reader.is(*metered, Kind::boolean))
      out.metered = metered->boolean;
    const JsonValue* lights = root.find("lights");
    if (!lights)
      reader.complain(root.place, "a map needs lights, a list");
    else if (reader.is(*lights, Kind::list))
      for (const JsonValue& light : lights->items) read_light(reader, light, out);
  }
  std::stable_sort(problems.begin(), problems.end(), [](const Diagnostic& a, const Diagnostic& b) {
    return std::pair(a.line, a.column) < std::pair(b.line, b.column);
  });
  if (!problems.empty()) throw InputError(InputError::Kind::wrong, std::move(problems));
  return out;
}

MapDescription read_map_description(const std::filesystem::path& path) {
  return parse_map_description(read_text_file(path, json_most_bytes), path.string());
}

}  // namespace sateen
