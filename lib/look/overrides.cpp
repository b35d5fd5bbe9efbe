#include "look/overrides.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "base/error.h"
#include "base/nearest_name.h"
#include "look/consistency.h"
#include "look/field_values.h"
#include "look/json.h"
#include "look/read.h"
#include "look/wif.h"

namespace sateen {

namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

// People type .5 and +5, which JSON does not know.
std::string with_json_numbers(std::string_view typed) {
  std::string json;
  bool quoted = false;
  for (const char c : typed) {
    if (c == '"') quoted = !quoted;
    if (quoted) {
      json += c;
      continue;
    }
    const bool after_digit = !json.empty() && std::isdigit(static_cast<unsigned char>(json.back()));
    const bool after_exponent = !json.empty() && (json.back() == 'e' || json.back() == 'E');
    if (c == '+' && !after_digit && !after_exponent) continue;
    if (c == '.' && !after_digit) json += '0';
    json += c;
  }
  return json;
}

// What the user typed, as a value: texts may come without quotes and lists without brackets.
JsonValue typed_value(const Field& field, std::string_view typed) {
  const bool is_text = field.kind == FieldKind::text || field.kind == FieldKind::name ||
                       field.kind == FieldKind::look_name ||
                       (field.kind == FieldKind::draft && !typed.starts_with('['));
  std::string json(trimmed(typed));
  if (is_text && !json.starts_with('"')) json = json_quote(typed);
  if (!is_text) json = with_json_numbers(json);
  if (!is_text && field.kind != FieldKind::number && !json.starts_with('[') && !json.starts_with('{'))
    json = fmt::format("[{}]", json);
  try {
    JsonDocument document = parse_json(json, {});
    if (!document.problems.empty()) throw InputError(InputError::Kind::wrong, document.problems);
    return document.root;
  } catch (const InputError&) {
    JsonValue value;
    value.kind = is_text ? JsonValue::Kind::null : JsonValue::Kind::text;
    value.text = trimmed(typed);
    return value;
  }
}

// Textures are typed from the folder one stands in, but those beside the look are found too.
JsonValue with_path_from_here(JsonValue value, const std::string& look_file) {
  for (JsonValue& item : value.items) {
    if (item.key != "texture" || item.kind != JsonValue::Kind::text || item.text.empty()) continue;
    std::error_code ignored;
    const auto beside = std::filesystem::absolute(look_file, ignored).parent_path() / item.text;
    const auto here = std::filesystem::absolute(item.text, ignored);
    if (texture_files(beside.string()).empty() && !texture_files(here.string()).empty()) item.text = here.string();
  }
  return value;
}

std::string_view path_of(std::string_view text) {
  return trimmed(text.substr(0, text.find('=')));
}

// As in a file, where colours may stand before the space that they are in.
std::vector<std::string> color_space_first(std::vector<std::string> overrides) {
  std::stable_partition(overrides.begin(), overrides.end(),
                        [](const std::string& text) { return path_of(text) == "color_space"; });
  return overrides;
}

std::string path_help(const std::string& path) {
  std::vector<std::string> paths;
  for (const Field& field : fields()) {
    if (field.family == &Look::warp && (field.key == path || field.key == path + "_deg"))
      return fmt::format("did you mean warp.{0} or weft.{0}?", field.key);
    if (field.path == path + "_deg" || field.path == "weave." + path)
      return fmt::format("did you mean {}?", field.path);
    paths.push_back(field.path);
  }
  if (path == "inherits") return "choose the look itself instead";
  return suggestion(path, paths);
}

}  // namespace

std::string key_help(const std::string& key, const std::string& group) {
  std::vector<std::string> here, elsewhere;
  for (const Field& field : fields()) {
    const bool same_level = field.group == group;
    (same_level ? here : elsewhere).push_back(field.key);
    if (same_level && field.key == key + "_deg") return fmt::format("did you mean {}?", field.key);
  }
  if (group.empty()) here.insert(here.end(), {"inherits", "pattern", "warp", "weft", "weave"});
  if (!group.empty()) elsewhere.push_back("inherits");
  const auto level_of = [&](const std::string& known) {
    for (const Field& field : fields())
      if (field.key == known && field.group != group && !field.is_shorthand())
        return field.group.empty()        ? "at the top level"
               : field.group == "weave"   ? "inside \"weave\""
               : field.group == "pattern" ? "inside \"pattern\""
                                          : "inside \"warp\" or \"weft\"";
    return "at the top level";
  };
  if (std::find(elsewhere.begin(), elsewhere.end(), key) != elsewhere.end())
    return fmt::format("it belongs {}", level_of(key));
  if (nearest_name(key, here).empty())
    if (const std::string near = nearest_name(key, elsewhere); !near.empty())
      return fmt::format("did you mean {}, {}?", near, level_of(near));
  return suggestion(key, here);
}

std::vector<std::string> apply_overrides_naming_fields(Look& look, const std::vector<std::string>& overrides) {
  Look changed = look;
  std::vector<Diagnostic> complaints;
  std::vector<std::pair<std::string, std::string>> set;  // path of a field and the text that set it
  const auto complain = [&](const std::string& text, std::string message, std::string help) {
    Diagnostic d;
    d.file = "--set " + shown_name(text);
    d.message = std::move(message);
    d.help = std::move(help);
    complaints.push_back(std::move(d));
  };
  for (const std::string& text : color_space_first(overrides)) {
    const size_t equals = text.find('=');
    const std::string path(path_of(text));
    const Field* field = find_field(path);
    if (equals == std::string::npos) {
      complain(text, "has no =, expected path=value", "for example warp.gamma_s_deg=4");
      continue;
    }
    if (!field) {
      complain(text, "there is no field " + shown_name(path), path_help(path));
      continue;
    }
    const Report report = [&](const JsonPlace&, std::string message, std::string help) {
      complain(text, std::move(message), std::move(help));
    };
    const Look before = changed;
    const JsonValue typed = typed_value(*field, std::string_view(text).substr(equals + 1));
    if (!set_field(changed, *field, with_path_from_here(typed, changed.file), path, report)) continue;
    for (auto& [name, texture] : changed.textures)
      if (texture.origin.empty()) texture.origin = "--set " + path;
    if (path == "color_space" && changed.color_space != before.color_space) {
      // As in a file that inherits: what was there keeps its meaning, what follows is in the new space.
      const std::string space = changed.color_space;
      changed = before;
      pin_color_spaces(changed);
      changed.color_space = space;
    }
    if (field->kind == FieldKind::look_name) {
      std::string& named = changed.*std::get<std::string Look::*>(field->member);
      try {
        const auto found = named.empty() ? std::filesystem::path() : find_look_beside(named, changed.file);
        if (named.find('/') != std::string::npos)
          named = std::filesystem::absolute(found).lexically_normal().string();
      } catch (const InputError& error) {
        complain(text, fmt::format("there is no look {}", shown_name(named)), error.diagnostics.front().help);
      }
    }
    if (field->kind == FieldKind::draft) {
      try {
        settle_draft(changed.weave.draft, {});
      } catch (const InputError& error) {
        complaints.insert(complaints.end(), error.diagnostics.begin(), error.diagnostics.end());
      }
    }
    if (field->is_shorthand()) {
      set.emplace_back("warp." + field->key, text);
      set.emplace_back("weft." + field->key, text);
    } else {
      set.emplace_back(path, text);
    }
  }
  if (complaints.empty())
    check_consistency(changed, [&](const std::vector<std::string>& paths, std::string message, std::string help) {
      std::string culprit;
      for (const auto& [path, text] : set)
        if (std::find(paths.begin(), paths.end(), path) != paths.end()) culprit = text;
      complain(culprit, std::move(message), std::move(help));
    });
  if (!complaints.empty()) throw InputError(InputError::Kind::wrong, std::move(complaints));
  look = std::move(changed);
  std::vector<std::string> paths;
  for (const auto& [path, text] : set) paths.push_back(path);
  return paths;
}

void apply_overrides(Look& look, const std::vector<std::string>& overrides) {
  apply_overrides_naming_fields(look, overrides);
}

void apply_override(Look& look, const std::string& text) {
  apply_overrides_naming_fields(look, {text});
}

}  // namespace sateen
