#include "image/exr_layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace sateen {

namespace {
// How renderers call the picture itself, the best first: Blender, Nuke and many, Arnold and V-Ray.
constexpr const char* picture_names[] = {"combined", "rgba", "beauty", "rgb"};

std::string lower(std::string text) {
  for (char& c : text) c = char(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::string before_dot(const std::string& channel) {
  const size_t dot = channel.rfind('.');
  return dot == std::string::npos ? "" : channel.substr(0, dot);
}
std::string behind_dot(const std::string& name) {
  const size_t dot = name.rfind('.');
  return dot == std::string::npos ? name : name.substr(dot + 1);
}

/// Channels of one part with the same name before the dot.
struct Group {
  int part = 0;
  std::string prefix;
  std::vector<std::string> channels;
};
std::vector<Group> groups_of(const std::vector<ExrPart>& parts) {
  std::vector<Group> groups;
  for (size_t p = 0; p < parts.size(); ++p) {
    if (parts[p].deep) continue;
    const size_t first = groups.size();
    for (const std::string& channel : parts[p].channels) {
      const std::string prefix = before_dot(channel);
      const auto same = std::find_if(groups.begin() + std::ptrdiff_t(first), groups.end(),
                                     [&](const Group& g) { return g.prefix == prefix; });
      if (same == groups.end())
        groups.push_back({int(p), prefix, {channel}});
      else
        same->channels.push_back(channel);
    }
  }
  return groups;
}

std::string name_of(const std::vector<ExrPart>& parts, const Group& group) {
  const std::string& part = parts[size_t(group.part)].name;
  if (parts.size() < 2 || part.empty()) return group.prefix;
  // Writers that name a part after its layer repeat it before the channels.
  if (group.prefix.empty() || group.prefix == part) return part;
  return group.prefix.rfind(part + ".", 0) == 0 ? group.prefix : part + "." + group.prefix;
}

/// The channel whose last word is one of these, in any case.
std::string find_channel(const Group& group, std::initializer_list<const char*> words) {
  for (const char* word : words)
    for (const std::string& channel : group.channels)
      if (lower(behind_dot(channel)) == word) return channel;
  return {};
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_alpha(const std::string& channel) {
  const std::string name = lower(behind_dot(channel));
  return name == "a" || name == "alpha";
}

/// What files of mattes, depths, names of objects and the like call them, without signs and numbers.
bool names_no_light(const std::string& word) {
  static const std::vector<std::string> names{"a",       "alpha",    "z",        "zback",     "depth",
                                              "zdepth",  "id",       "objectid", "objid",     "materialid",
                                              "matid",   "assetid",  "index",    "indexob",   "indexma",
                                              "u",       "v",        "uv",       "mask",      "matte",
                                              "holdout", "coverage", "ao",       "occlusion", "ambientocclusion"};
  std::string name;
  for (const char c : lower(word))
    if (std::isalpha(static_cast<unsigned char>(c))) name += c;
  return contains(names, name) || name.find("crypto") != std::string::npos;
}

/// By the channel's own word and the layer's: "Depth.Z", "AO.Y".
bool is_no_light(const ExrPart& part, const std::string& channel) {
  return contains(part.whole_numbers, channel) || names_no_light(behind_dot(channel)) ||
         names_no_light(behind_dot(before_dot(channel)));
}
bool is_no_light(const std::vector<ExrPart>& parts, const ExrLayer& layer) {
  const ExrPart& part = parts[size_t(layer.part)];
  return names_no_light(behind_dot(before_dot(layer.channels[0]))) || contains(part.whole_numbers, layer.channels[0]);
}

ExrLayer one_channel(int part, const std::string& channel) {
  return {channel, LayerKind::grey, part, false, false, {channel, "", ""}, true};
}

/// A file's only channel beside alpha, or its alpha; part -1 where there are more.
ExrLayer only_channel(const std::vector<ExrPart>& parts) {
  ExrLayer only = one_channel(-1, {});
  int count = 0, alphas = 0;
  for (size_t p = 0; p < parts.size(); ++p)
    for (const std::string& channel : parts[p].channels) {
      if (parts[p].deep) continue;
      const bool alpha = is_alpha(channel);
      (alpha ? alphas : count) += 1;
      if (!alpha || count == 0) only = one_channel(int(p), channel);
    }
  return count == 1 || (count == 0 && alphas == 1) ? only : one_channel(-1, {});
}

bool whole(const std::array<std::string, 3>& channels) {
  return !channels[0].empty() && !channels[1].empty() && !channels[2].empty();
}

int only_one(const std::vector<ExrLayer>& layers, auto&& fits) {
  const auto first = std::find_if(layers.begin(), layers.end(), fits);
  if (first == layers.end() || std::find_if(first + 1, layers.end(), fits) != layers.end()) return -1;
  return int(first - layers.begin());
}

int first_one(const std::vector<ExrLayer>& layers, auto&& fits) {
  const auto first = std::find_if(layers.begin(), layers.end(), fits);
  return first == layers.end() ? -1 : int(first - layers.begin());
}

int by_name(const std::vector<ExrPart>& parts, const std::string& wanted, std::vector<ExrLayer>& layers) {
  const std::string name = lower(wanted);
  if (const int i = first_one(layers, [&](const ExrLayer& l) { return lower(l.name) == name; }); i >= 0) return i;
  const auto ends = [&](const ExrLayer& l) {
    const std::string full = lower(l.name);
    return full.size() > name.size() && full.ends_with("." + name);
  };
  if (const int i = only_one(layers, ends); i >= 0) return i;
  for (size_t p = 0; p < parts.size(); ++p)
    for (const std::string& channel : parts[p].channels)
      if (!parts[p].deep && lower(channel) == name) {
        layers.push_back(one_channel(int(p), channel));
        return int(layers.size()) - 1;
      }
  return -1;
}
}  // namespace

std::vector<ExrLayer> exr_layers(const std::vector<ExrPart>& parts) {
  std::vector<ExrLayer> layers;
  for (const Group& group : groups_of(parts)) {
    ExrLayer layer;
    layer.name = name_of(parts, group);
    layer.part = group.part;
    layer.plain = group.prefix.empty();
    const std::string y = find_channel(group, {"y"}), ry = find_channel(group, {"ry"}),
                      by = find_channel(group, {"by"});
    const std::array<std::string, 3> rgb{find_channel(group, {"r", "red"}), find_channel(group, {"g", "green"}),
                                         find_channel(group, {"b", "blue"})},
        xyz{find_channel(group, {"x"}), y, find_channel(group, {"z"})};
    if (whole(rgb)) {
      layer.channels = rgb;
    } else if (whole(xyz)) {
      layer.kind = LayerKind::xyz;
      layer.channels = xyz;
    } else if (!y.empty()) {
      layer.kind = !ry.empty() && !by.empty() ? LayerKind::chroma : LayerKind::grey;
      layer.channels[0] = y;
      if (layer.kind == LayerKind::chroma) layer.channels = {y, ry, by};
    } else {
      continue;
    }
    layers.push_back(layer);
  }
  return layers;
}

int choose_layer(const std::vector<ExrPart>& parts, const std::string& wanted, std::vector<ExrLayer>& layers) {
  if (!wanted.empty()) return by_name(parts, wanted, layers);
  const auto called = [](const char* name) {
    return [=](const ExrLayer& l) { return l.kind == LayerKind::rgb && lower(behind_dot(l.name)) == name; };
  };
  const auto plain = [](LayerKind kind) { return [=](const ExrLayer& l) { return l.kind == kind && l.plain; }; };
  // The names of parts tell which of several plain ones is the picture.
  for (const char* name : picture_names)
    if (const int i = first_one(layers, [&](const ExrLayer& l) { return l.plain && called(name)(l); }); i >= 0)
      return i;
  if (const int i = first_one(layers, plain(LayerKind::rgb)); i >= 0) {
    layers[size_t(i)].guessed = only_one(layers, plain(LayerKind::rgb)) < 0;
    return i;
  }
  for (const char* name : picture_names)
    if (const int i = first_one(layers, called(name)); i >= 0) return i;
  const auto coloured = [](const ExrLayer& l) { return l.kind == LayerKind::rgb; };
  if (const int i = only_one(layers, coloured); i >= 0 && !is_no_light(parts, layers[size_t(i)])) {
    layers[size_t(i)].guessed = true;
    return i;
  }
  if (first_one(layers, coloured) >= 0) return -1;
  for (const LayerKind kind : {LayerKind::xyz, LayerKind::chroma, LayerKind::grey})
    if (const int i = first_one(layers, plain(kind)); i >= 0) return i;
  const auto chroma = [&](const ExrLayer& l) { return l.kind == LayerKind::chroma && !is_no_light(parts, l); };
  if (const int i = only_one(layers, chroma); i >= 0) {
    layers[size_t(i)].guessed = true;
    return i;
  }
  ExrLayer only = only_channel(parts);
  if (only.part < 0 || is_no_light(parts[size_t(only.part)], only.name)) return -1;
  const std::string word = lower(behind_dot(only.name));
  only.guessed = word != "y" && word != "l" && word != "luminance" && word != "grey" && word != "gray";
  layers.push_back(only);
  return int(layers.size()) - 1;
}

int choose_number(const std::vector<ExrPart>& parts, const std::string& wanted, std::vector<ExrLayer>& layers) {
  ExrLayer only = only_channel(parts);
  if (wanted.empty() && only.part >= 0) {
    layers.push_back(only);
    return int(layers.size()) - 1;
  }
  const int chosen = choose_layer(parts, wanted, layers);
  if (chosen >= 0) {
    ExrLayer& layer = layers[size_t(chosen)];
    if (layer.kind == LayerKind::xyz) return -1;
    layer.kind = LayerKind::grey;
    layer.channels = {layer.channels[0], "", ""};
    return chosen;
  }
  for (size_t p = 0; wanted.empty() && p < parts.size(); ++p)
    if (!parts[p].deep && contains(parts[p].channels, "R")) {
      layers.push_back({"R", LayerKind::grey, int(p), true, true, {"R", "", ""}, false});
      return int(layers.size()) - 1;
    }
  return -1;
}

std::string alpha_of(const std::vector<ExrPart>& parts, const ExrLayer& layer) {
  for (const std::string& channel : parts[size_t(layer.part)].channels)
    if (channel != layer.channels[0] && is_alpha(channel) && before_dot(channel) == before_dot(layer.channels[0]))
      return channel;
  return {};
}

std::string guess_text(const ExrLayer& layer, const char* what) {
  if (layer.kind == LayerKind::grey)
    return fmt::format("{} {:.80} is taken as {}, in grey, though its name does not say what it is",
                       layer.alone ? "only channel" : "channel", layer.name, what);
  return fmt::format("layer {:.80} is taken as {}, {}", layer.name, what,
                     layer.plain ? "the first with colours" : "the only one with colours");
}

std::string layers_text(const std::vector<ExrPart>& parts) {
  constexpr size_t most = 20;
  std::string text;
  const std::vector<Group> groups = groups_of(parts);
  for (size_t i = 0; i < std::min(groups.size(), most); ++i) {
    std::string channels;
    for (const std::string& channel : groups[i].channels)
      channels += (channels.empty() ? "" : ", ") + behind_dot(channel);
    const std::string name = name_of(parts, groups[i]);
    text += fmt::format("{}{}{}({:.80})", i ? ", " : "", name, name.empty() ? "" : " ", channels);
  }
  if (groups.size() > most) text += fmt::format(" and {} more", groups.size() - most);
  return text;
}

}  // namespace sateen
