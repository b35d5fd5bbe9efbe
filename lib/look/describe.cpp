#include "look/describe.h"

#include <fmt/format.h>

#include <filesystem>

#include "base/files.h"
#include "look/field_values.h"

namespace sateen {

namespace {

constexpr const char* groups[] = {"pattern", "warp", "weft", "weave"};

// Looks without a pattern are written, and hashed, without a word of one.
bool unused_pattern(const Field& field, const std::string& value) {
  return field.group == "pattern" && value == field_text(Look(), field);
}

std::string joined(const std::vector<std::string>& lines, const std::string& indent) {
  std::string text;
  for (size_t i = 0; i < lines.size(); ++i) {
    text += indent;
    text += lines[i];
    text += i + 1 < lines.size() ? ",\n" : "\n";
  }
  return text;
}

std::string bounds(const Field& field) {
  std::string text;
  if (std::isfinite(field.low)) text += fmt::format(", \"minimum\": {:g}", field.low);
  if (std::isfinite(field.high)) text += fmt::format(", \"maximum\": {:g}", field.high);
  return text;
}

std::string type_schema(const Field& field) {
  const std::string number = fmt::format("{{\"type\": \"number\"{}}}", bounds(field));
  const bool offsets = field.key == "offsets_deg";
  switch (field.kind) {
    case FieldKind::text:
    case FieldKind::look_name:
      return "\"type\": \"string\"";
    case FieldKind::name:
      return "\"type\": \"string\", \"minLength\": 1";
    case FieldKind::draft:
      return "\"anyOf\": [{\"type\": \"string\"}, {\"type\": \"array\", \"minItems\": 1, \"items\": {\"type\": "
             "\"string\", \"pattern\": \"^([xX.10]+|[0-9a-fA-F]+|packed [0-9]+)$\"}}]";
    case FieldKind::number:
      return fmt::format("\"type\": \"number\"{}", bounds(field));
    case FieldKind::numbers:
      return fmt::format("\"type\": \"array\", \"minItems\": {}, \"maxItems\": {}, \"items\": {}",
                         fewest_offsets - (offsets ? 0 : 1), most_offsets - (offsets ? 0 : 1), number);
    case FieldKind::color: {
      const std::string triple =
          fmt::format("{{\"type\": \"array\", \"minItems\": 3, \"maxItems\": 3, \"items\": {}}}", number);
      return fmt::format(
          "\"anyOf\": [{0}, {{\"type\": \"object\", \"properties\": {{\"value\": {0}, \"space\": {{\"type\": "
          "\"string\", "
          "\"minLength\": 1}}}}, \"required\": [\"value\"], \"additionalProperties\": false}}]",
          triple);
    }
  }
  return {};
}

std::string property(const Field& field) {
  const std::string initial = field_text(Look(), field), type = type_schema(field);
  const std::string either = fmt::format("\"anyOf\": [{{{}}}, {{\"$ref\": \"#/$defs/{}\"}}]", type,
                                         field.kind == FieldKind::color ? "color_texture" : "texture");
  return fmt::format("{}: {{\"description\": {}, {}{}}}", json_quote(field.key),
                     json_quote(field.unit.empty() ? field.help : field.help + ", in " + field.unit),
                     field.mappable ? either : type,
                     initial.empty() ? std::string() : fmt::format(", \"default\": {}", initial));
}

}  // namespace

std::string write_look(const Look& look) {
  std::vector<std::string> top;
  for (const Field& field : fields()) {
    const std::string value = field_text(look, field);
    if (field.group.empty() && !value.empty() && value != "\"\"")
      top.push_back(fmt::format("\"{}\": {}", field.key, value));
  }
  for (const std::string group : groups) {
    std::vector<std::string> own;
    bool initial = true;
    for (const Field& field : fields()) {
      if (field.group != group) continue;
      const std::string value = field_text(look, field);
      if (!value.empty() && !unused_pattern(field, value)) own.push_back(fmt::format("\"{}\": {}", field.key, value));
      initial = initial && value == field_text(Look(), field);
    }
    if (own.empty() || (group == "weave" && initial)) continue;
    top.push_back(fmt::format("\"{}\": {{\n{}  }}", group, joined(own, "    ")));
  }
  return fmt::format("{{\n{}}}\n", joined(top, "  "));
}

std::vector<FieldDifference> diff_looks(const Look& a, const Look& b) {
  std::vector<FieldDifference> differences;
  for (const Field& field : fields()) {
    if (!field.appearance) continue;
    std::string in_a = canonical_text(a, field), in_b = canonical_text(b, field);
    if (in_a == in_b) continue;
    // Shown as they are written, unless only the space tells them apart.
    if (field_text(a, field) != field_text(b, field)) in_a = field_text(a, field), in_b = field_text(b, field);
    differences.push_back({field.path, std::move(in_a), std::move(in_b)});
  }
  return differences;
}

std::string look_hash(const Look& look) {
  Hash hash;
  hash.add("look 1\n");
  for (const Field& field : fields()) {
    std::string value = canonical_text(look, field);
    if (unused_pattern(field, value)) continue;
    if (field.kind == FieldKind::look_name)
      value = std::filesystem::path(look.*std::get<std::string Look::*>(field.member)).stem().string();
    if (field.appearance && !value.empty()) hash.add(field.path).add("=").add(value).add("\n");
  }
  return hash.hex();
}

namespace {
std::string texture_schema(bool color) {
  return fmt::format(
      "{{\"description\": \"A texture in place of the value: pixel * scale + offset\", \"type\": \"object\", "
      "\"additionalProperties\": false, \"required\": [\"texture\"{}], \"properties\": {{"
      "\"texture\": {{\"description\": \"Path from this file's folder; <UDIM> stands for 1001, 1002 ...\", "
      "\"type\": \"string\", \"minLength\": 1}}, {}{}"
      "\"layer\": {{\"description\": \"Layer, or one channel, of an OpenEXR file\", \"type\": \"string\", "
      "\"minLength\": 1}}, "
      "\"scale\": {{\"type\": \"number\", \"default\": 1}}, \"offset\": {{\"type\": \"number\", \"default\": 0}}, "
      "\"repeat\": {{\"description\": \"How often over one unit of u and of v\", \"type\": \"array\", "
      "\"minItems\": 2, \"maxItems\": 2, \"items\": {{\"type\": \"number\", \"minimum\": 0.001, \"maximum\": "
      "10000}}}}, \"repeat_cm\": {{\"description\": \"Size of one repeat on the cloth along u and v, in "
      "centimetres\", "
      "\"type\": \"array\", \"minItems\": 2, \"maxItems\": 2, \"items\": {{\"type\": \"number\", \"minimum\": 0.001, "
      "\"maximum\": 100000}}}}, \"wrap\": {{\"enum\": [\"repeat\", \"clamp\", \"mirror\"]}}, "
      "\"under\": {{\"description\": \"What shows where the picture is transparent, instead of what is inherited\", "
      "\"type\": {}}}}}}}",
      color ? ", \"space\"" : "",
      color ? "\"space\": {\"description\": \"Colour space of the pixels\", \"type\": \"string\", \"minLength\": 1}, "
            : "",
      color
          ? "\"under_A\": {\"type\": [\"array\", \"object\"]}, \"under_color\": {\"type\": [\"array\", \"object\"]}, "
          : "",
      color ? "[\"array\", \"object\"]" : "\"number\"");
}
}  // namespace

std::string look_schema() {
  std::vector<std::string> top{
      "\"$schema\": {\"description\": \"Where this schema is, for editors\", \"type\": \"string\"}",
      "\"inherits\": {\"description\": \"Name or path of the look whose values this one starts from\", "
      "\"type\": \"string\", \"minLength\": 1}"};
  std::vector<std::string> family, pattern, weave;
  for (const Field& field : fields()) {
    if (field.group.empty()) top.push_back(property(field));
    if (field.group == "pattern") pattern.push_back(property(field));
    if (field.group == "warp") family.push_back(property(field));
    if (field.group == "weave") weave.push_back(property(field));
  }
  for (const std::string group : {"pattern", "warp", "weft"})
    top.push_back(
        fmt::format("\"{}\": {{\"$ref\": \"#/$defs/{}\"}}", group, group == "pattern" ? "pattern" : "family"));
  top.push_back(
      fmt::format("\"weave\": {{\n      \"description\": \"How the threads cross, for cloth seen from near\",\n"
                  "      \"type\": \"object\",\n      \"additionalProperties\": false,\n"
                  "      \"properties\": {{\n{}      }}\n    }}",
                  joined(weave, "        ")));
  return fmt::format(
      "{{\n  \"$schema\": \"https://json-schema.org/draft/2020-12/schema\",\n  \"title\": \"A look: one cloth\",\n"
      "  \"type\": \"object\",\n  \"additionalProperties\": false,\n  \"properties\": {{\n{}  }},\n"
      "  \"$defs\": {{\n    \"texture\": {},\n    \"color_texture\": {},\n"
      "    \"pattern\": {{\n      \"description\": \"Another look that is woven in\",\n"
      "      \"type\": \"object\",\n      \"additionalProperties\": false,\n      \"properties\": {{\n{}      }}\n   "
      " }},\n"
      "    \"family\": {{\n      \"description\": \"One family of threads\",\n"
      "      \"type\": \"object\",\n      \"additionalProperties\": false,\n"
      "      \"not\": {{\"required\": [\"A\", \"color\"]}},\n      \"properties\": {{\n{}      }}\n    }}\n  "
      "}}\n}}\n",
      joined(top, "    "), texture_schema(false), texture_schema(true), joined(pattern, "        "),
      joined(family, "        "));
}

std::string look_field_help() {
  std::string text;
  size_t widest = 0;
  for (const Field& field : fields()) widest = std::max(widest, field.path.size());
  for (const Field& field : fields()) {
    std::string facts = range_text(field);
    if (!field.unit.empty()) facts += " " + field.unit;
    if (const std::string initial = field_text(Look(), field); !initial.empty() && initial != "\"\"")
      facts += fmt::format("{}default {}", facts.empty() ? "" : ", ", initial);
    text += fmt::format("{:<{}}  {}{}{}\n", field.path, widest, field.help,
                        facts.empty() ? "" : fmt::format(" ({})", facts), field.mappable ? ", or a texture" : "");
  }
  return text;
}

}  // namespace sateen
