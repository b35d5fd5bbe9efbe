#include "look/overrides.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include "base/error.h"
#include "base/name_distance.h"
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

// "40%" as 0.4: takes the number before it off the end of `json` and puts its hundredth there.
void take_percent(std::string& json) {
  while (!json.empty() && json.back() == ' ') json.pop_back();
  const size_t begin = json.find_last_not_of("0123456789.eE+-") + 1;
  double value = 0;
  const auto [end, code] = std::from_chars(json.data() + begin, json.data() + json.size(), value);
  if (code == std::errc() && end == json.data() + json.size())
    json.replace(begin, std::string::npos, fmt::format("{}", value / 100));
  else
    json += '%';
}

// People type .5 and +5, which JSON does not know, and shares as percentages.
std::string with_json_numbers(std::string_view typed, bool shares) {
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
    if (c == '%' && shares) {
      take_percent(json);
      continue;
    }
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
  if (!is_text) json = with_json_numbers(json, field.low >= 0 && field.high <= 1);
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

std::string_view without_unit(std::string_view name) {
  return name.ends_with("_deg") ? name.substr(0, name.size() - 4) : name;
}

// How far a typed path is from a field: by its whole path or by its key alone, with or without the unit.
size_t path_distance(std::string_view typed, const Field& field) {
  const size_t dot = typed.rfind('.');
  const std::string_view group = dot == std::string_view::npos ? std::string_view() : typed.substr(0, dot);
  const std::string_view key = dot == std::string_view::npos ? typed : typed.substr(dot + 1);
  const size_t by_key = std::min(name_distance(key, field.key), name_distance(key, without_unit(field.key)));
  // A group that was typed tells of two families which; one that was not is no fault of the name.
  const size_t by_group =
      group.empty() || group == field.group ? 0 : std::min<size_t>(name_distance(group, field.group), 3);
  return std::min(by_key + by_group, name_distance(typed, field.path));
}

std::string path_help(const std::string& path) {
  if (path == "inherits") return "choose the look itself instead";
  constexpr size_t most_named = 4;
  std::vector<std::pair<size_t, const Field*>> ranked;
  for (const Field& field : fields()) ranked.emplace_back(path_distance(path, field), &field);
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  const size_t near = std::clamp<size_t>(path.size() / 3, 1, 4);
  std::vector<std::string> named;
  for (const auto& [distance, field] : ranked)
    if (distance == ranked[0].first && distance <= near && named.size() < most_named) named.push_back(field->path);
  if (!named.empty()) return fmt::format("did you mean {}?", fmt::join(named, " or "));
  for (size_t i = 0; i < most_named; ++i) named.push_back(ranked[i].second->path);
  return fmt::format("the nearest are {}; sateen look schema --fields lists all", fmt::join(named, ", "));
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
  bool any_missing = false;
  std::vector<std::pair<std::string, std::string>> set;  // path of a field and the text that set it
  const auto complain = [&](const std::string& text, std::string message, std::string help, bool missing = false) {
    Diagnostic d;
    d.file = "--set " + shown_name(text);
    d.message = std::move(message);
    d.help = std::move(help);
    any_missing = any_missing || missing;
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
    const Report report{[&](const JsonPlace&, std::string message, std::string help, bool missing) {
      complain(text, std::move(message), std::move(help), missing);
    }};
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
        complain(text, fmt::format("there is no look {}", shown_name(named)), error.diagnostics.front().help, true);
      }
    }
    if (field->kind == FieldKind::draft) {
      try {
        settle_draft(changed.weave, {});
      } catch (const InputError& error) {
        complaints.insert(complaints.end(), error.diagnostics.begin(), error.diagnostics.end());
        any_missing = any_missing || error.kind == InputError::Kind::unreadable;
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
  if (!complaints.empty())
    throw InputError(any_missing ? InputError::Kind::unreadable : InputError::Kind::wrong, std::move(complaints));
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
