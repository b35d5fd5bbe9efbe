#include "look/read.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/files.h"
#include "base/nearest_name.h"
#include "look/consistency.h"
#include "look/field_values.h"
#include "look/json.h"
#include "look/overrides.h"
#include "look/wif.h"

namespace sateen {

namespace fs = std::filesystem;

namespace {

constexpr size_t most_complaints = 1000;  // 20 are printed, the rest counted; a hostile file could hold millions
constexpr size_t most_parents = 32;

struct Layer {
  Look look;
  std::vector<std::string> origins = std::vector<std::string>(fields().size(), "default");
  std::vector<std::string> files;
};

struct Reading {
  const std::vector<fs::path>& extra_folders;
  std::vector<fs::path> chain;  // canonical paths of the files being read, the first child first
};

Layer read_layer(Reading& reading, std::string text, const std::string& file);

class LayerReader {
 public:
  LayerReader(Reading& reading, std::string text, const std::string& file)
      : reading_(reading), document_(parse_json(std::move(text), file)), complaints_(document_.problems) {}

  Layer read() {
    const JsonValue& root = document_.root;
    if (root.kind != JsonValue::Kind::object) {
      complain(root.place, "a look is an object, expected { at the beginning", {});
      finish();
    }
    read_parent();
    layer_.look.file = document_.file;
    layer_.look.name = fs::path(document_.file).stem().string();
    layer_.files.insert(layer_.files.begin(), document_.file);
    pin_inherited_colors();
    for (const JsonValue& item : root.items)
      if (complaints_.size() < most_complaints) read_top_level(item);
    read_shorthands();
    if (complaints_.empty() && parent_complaints_.empty()) check();
    finish();
    return std::move(layer_);
  }

 private:
  void complain(const JsonPlace& place, std::string message, std::string help, bool missing = false) {
    if (complaints_.size() == most_complaints) return;
    complaints_.push_back(diagnostic_at(document_, place, std::move(message), std::move(help)));
    any_missing_ = any_missing_ || missing;
  }

  void finish() {
    std::stable_sort(complaints_.begin(), complaints_.end(), [](const Diagnostic& a, const Diagnostic& b) {
      return std::pair(a.line, a.column) < std::pair(b.line, b.column);
    });
    complaints_.insert(complaints_.end(), parent_complaints_.begin(), parent_complaints_.end());
    if (!complaints_.empty())
      throw InputError(any_missing_ ? InputError::Kind::unreadable : InputError::Kind::wrong, std::move(complaints_));
  }

  void read_parent() {
    const JsonValue* parent = document_.root.find("inherits");
    if (!parent) return;
    if (parent->kind != JsonValue::Kind::text || parent->text.empty())
      return complain(parent->place, "inherits is no name, expected the name or path of one look", {});
    fs::path path;
    try {
      path = find_look_beside(parent->text, document_.file, reading_.extra_folders);
    } catch (const InputError& error) {
      return complain(parent->place,
                      fmt::format("inherits from {}, but there is no such look", shown_name(parent->text)),
                      error.diagnostics.front().help, true);
    }
    std::error_code ignored;
    const fs::path canonical = fs::weakly_canonical(path, ignored);
    if (const auto seen = std::find(reading_.chain.begin(), reading_.chain.end(), canonical);
        seen != reading_.chain.end()) {
      std::string circle;
      for (auto at = seen; at != reading_.chain.end(); ++at) circle += at->stem().string() + " -> ";
      return complain(parent->place, fmt::format("inherits in a circle: {}{}", circle, canonical.stem().string()),
                      {});
    }
    if (reading_.chain.size() > most_parents)
      return complain(parent->place, fmt::format("has more than {} parents", most_parents), {});
    try {
      layer_ = read_layer(reading_, read_text_file(path, json_most_bytes), path.string());
    } catch (const InputError& error) {
      parent_complaints_ = error.diagnostics;
      any_missing_ = error.kind == InputError::Kind::unreadable;
    }
    const Look defaults;
    for (size_t i = 0; i < fields().size(); ++i) {
      if (fields()[i].inherited) continue;
      layer_.origins[i] = "default";
      visit_member(layer_.look, fields()[i], [&](auto& member) {
        visit_member(defaults, fields()[i], [&](const auto& initial) {
          if constexpr (std::is_same_v<std::decay_t<decltype(initial)>, std::decay_t<decltype(member)>>)
            member = initial;
        });
      });
    }
  }

  void pin_inherited_colors() {
    const JsonValue* space = document_.root.find("color_space");
    if (space && space->text != layer_.look.color_space && layer_.files.size() > 1) pin_color_spaces(layer_.look);
  }

  void read_top_level(const JsonValue& item) {
    if (item.key == "$schema" || item.key == "inherits") return;
    if (item.key == "warp" || item.key == "weft" || item.key == "pattern" || item.key == "weave")
      return read_group(item);
    const Field* field = find_field(item.key);
    if (!field || !field->group.empty())
      return complain(item.key_place, "unknown key " + shown_name(item.key), key_help(item.key, {}));
    if (field->is_shorthand())
      shorthands_.push_back({field, &item});
    else
      read_field(*field, item);
  }

  void read_group(const JsonValue& group) {
    if (group.kind != JsonValue::Kind::object)
      return complain(group.place, fmt::format("{} holds no fields, expected an object {{ ... }}", group.key), {});
    for (const JsonValue& item : group.items) {
      if (complaints_.size() == most_complaints) break;
      const Field* field = find_field(group.key + "." + item.key);
      if (field)
        read_field(*field, item);
      else
        complain(item.key_place, "unknown key " + shown_name(item.key), key_help(item.key, group.key));
    }
    const JsonValue *color = group.find("color"), *scale = group.find("A");
    if (color && scale)
      complain(std::max(color, scale)->key_place,
               fmt::format("{} gives both color and A, expected one of them", group.key),
               "A is solved from color; drop A, or drop color to keep the raw scale");
  }

  void read_field(const Field& field, const JsonValue& item) {
    const Report report{[&](const JsonPlace& place, std::string message, std::string help, bool missing) {
      complain(place, std::move(message), std::move(help), missing);
    }};
    given_.push_back({field.path, item.place});
    if (!set_field(layer_.look, field, item, field.key, report)) return;
    if (field.kind == FieldKind::look_name) settle_look_name(field, item);
    for (auto& [path, texture] : layer_.look.textures)
      if (texture.origin.empty()) texture.origin = fmt::format("{}:{}", document_.file, item.place.line);
    if (field.kind == FieldKind::draft) try {
        settle_draft(layer_.look.weave, document_.file);
      } catch (const InputError& error) {
        for (const Diagnostic& fault : error.diagnostics)
          if (fault.line > 0)
            parent_complaints_.push_back(fault);
          else
            complain(item.place, (fault.file.empty() ? "" : fault.file + ": ") + fault.message, fault.help,
                     error.kind == InputError::Kind::unreadable);
      }
    set_origin(field.path, item.place);
  }

  void set_origin(const std::string& path, const JsonPlace& place) {
    for (size_t i = 0; i < fields().size(); ++i)
      if (fields()[i].path == path) layer_.origins[i] = fmt::format("{}:{}", document_.file, place.line);
  }

  // A path is kept whole, so that a child in another folder means the same file by it.
  void settle_look_name(const Field& field, const JsonValue& item) {
    if (item.text.empty()) return;
    try {
      const fs::path path = find_look_beside(item.text, document_.file, reading_.extra_folders);
      if (item.text.find('/') != std::string::npos)
        visit_member(layer_.look, field, [&](auto& member) {
          if constexpr (std::is_same_v<std::decay_t<decltype(member)>, std::string>)
            member = fs::absolute(path).lexically_normal().string();
        });
    } catch (const InputError& error) {
      complain(item.place, fmt::format("{} is {}, but there is no such look", field.key, shown_name(item.text)),
               error.diagnostics.front().help, true);
    }
  }

  // Each family that says in this file what its colour is keeps that.
  void read_shorthands() {
    for (const auto& [field, item] : shorthands_) {
      const Look before = layer_.look;
      read_field(*field, *item);
      for (const auto& [name, family] : {std::pair("warp", &Look::warp), std::pair("weft", &Look::weft)}) {
        const JsonValue* own = document_.root.find(name);
        if (own && (own->find("color") || own->find("A"))) {
          // What both families are said to be lies under a texture of one, unless that says it itself.
          const JsonValue* texture = own->find("color") ? own->find("color") : own->find("A");
          const bool over = texture->find("texture") && !texture->find("under") && !texture->find("under_A") &&
                            !texture->find("under_color");
          if (!over) layer_.look.*family = before.*family;
          for (const char* key : {".A", ".color"}) {
            layer_.look.textures.erase(name + std::string(key));
            if (const auto kept = before.textures.find(name + std::string(key)); kept != before.textures.end())
              layer_.look.textures.insert(*kept);
          }
        } else
          set_origin(fmt::format("{}.color", name), item->place);
      }
    }
  }

  void check() {
    check_consistency(layer_.look, [&](const std::vector<std::string>& paths, std::string message, std::string help) {
      JsonPlace place;
      for (const auto& [path, where] : given_)
        if (std::find(paths.begin(), paths.end(), path) != paths.end() &&
            std::pair(where.line, where.column) > std::pair(place.line, place.column))
          place = where;
      complain(place, std::move(message), std::move(help));
    });
  }

  Reading& reading_;
  JsonDocument document_;
  std::vector<Diagnostic> complaints_, parent_complaints_;
  bool any_missing_ = false;  // a file that the look names
  Layer layer_;
  std::vector<std::pair<std::string, JsonPlace>> given_;
  std::vector<std::pair<const Field*, const JsonValue*>> shorthands_;
};

Layer read_layer(Reading& reading, std::string text, const std::string& file) {
  std::error_code ignored;
  reading.chain.push_back(fs::weakly_canonical(file, ignored));
  Layer layer = LayerReader(reading, std::move(text), file).read();
  reading.chain.pop_back();
  return layer;
}

}  // namespace

ResolvedLook resolve_look(const std::string& name, const std::vector<std::string>& overrides,
                          const std::vector<fs::path>& extra_folders) {
  const fs::path path = find_look(name, extra_folders);
  Reading reading{extra_folders, {}};
  Layer layer = read_layer(reading, read_text_file(path, json_most_bytes), path.string());
  const std::vector<std::string> changed = apply_overrides_naming_fields(layer.look, overrides);
  ResolvedLook resolved{std::move(layer.look), {}, std::move(layer.files)};
  for (size_t i = 0; i < fields().size(); ++i) {
    const Field& field = fields()[i];
    const std::string value = field_text(resolved.look, field);
    if (value.empty()) continue;
    const bool set = std::find(changed.begin(), changed.end(), field.path) != changed.end();
    resolved.values.push_back({field.path, value, set ? "--set" : layer.origins[i]});
  }
  return resolved;
}

Look read_look(const std::string& name, const std::vector<std::string>& overrides,
               const std::vector<fs::path>& extra_folders) {
  return resolve_look(name, overrides, extra_folders).look;
}

Look parse_look(const std::string& text, const std::string& file, const std::vector<fs::path>& extra_folders) {
  Reading reading{extra_folders, {}};
  return read_layer(reading, text, file).look;
}

Look read_back(const Look& look, const std::vector<fs::path>& extra_folders) {
  return read_look(find_look_beside(look.back, look.file, extra_folders).string(), {}, extra_folders);
}

Look read_pattern(const Look& look, const std::vector<fs::path>& extra_folders) {
  Look woven = read_look(find_look_beside(look.pattern_look, look.file, extra_folders).string(), {}, extra_folders);
  if (!woven.pattern_look.empty())
    throw InputError(
        fmt::format("{}: its pattern weaves in {}, which has a pattern of its own", look.file, woven.name),
        "name a look without one");
  return woven;
}

}  // namespace sateen
