#include "scene/compile_cloth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "look/fields.h"
#include "look/read.h"

namespace sateen {

namespace {

using Map = FabricMaps::Map;

/// Brings a value into its range; false where it was out of it by more than rounding and gamut conversion leave.
bool clamp_into(float& value, float low, float high) {
  const float slack = 1e-4f * std::max(std::abs(low), std::abs(high)), given = value;
  value = std::clamp(value, low, high);
  return given >= low - slack && given <= high + slack;
}

/// Reads the textures of one look; each picture once for each use.
struct MapReader {
  const Look& look;
  const ColorManager& colors;
  float metres_per_uv;
  std::vector<std::string>& warnings;
  std::map<std::string, Map> read_already = {};

  bool has(const std::string& path) const { return look.textures.contains(path); }

  /// `what`: tells uses of one picture apart, and says in a warning what happened to `count` pixels.
  Map read(const std::string& path, const std::string& what, const PixelUse& use) {
    const auto found = look.textures.find(path);
    if (found == look.textures.end()) return nullptr;
    const TextureValue& value = found->second;
    Map& map = read_already[fmt::format("{}{} {} {} {}", texture_text(value, {}), what, use.under[0], use.under[1],
                                        use.under[2])];
    if (map) return map;
    PixelCounts counts;
    map = std::make_shared<const UvTexture>(read_uv_texture(value, path, colors, use, metres_per_uv, counts));
    const auto warn = [&](long long count, const std::string& text) {
      if (count > 0)
        warnings.push_back(fmt::format("{}: {} of the {} pixels of the texture of {} {}", value.origin, count,
                                       counts.pixels, path, text));
    };
    for (const std::string& doubt : counts.doubts)
      warnings.push_back(
          fmt::format("{}: the texture of {}: {}; \"layer\" beside it takes another", value.origin, path, doubt));
    warn(counts.not_finite, "are not finite and count as 0");
    warn(counts.clamped, "are out of range: " + what);
    if (counts.transparent == counts.pixels)
      warn(counts.transparent, "are transparent: the cloth shows its own; save it without alpha to see its colours");
    return map;
  }

  Map number(const std::string& path, float low, float high, float unit) {
    PixelUse use;
    use.convert = [=](const float* pixel, float* value) {
      *value = *pixel;
      const bool inside = clamp_into(*value, low, high);
      *value *= unit;
      return inside;
    };
    float own = 0;
    visit_member(look, *find_field(path), [&](const auto& member) {
      if constexpr (std::is_same_v<std::decay_t<decltype(member)>, float>) own = member;
    });
    use.convert(&own, use.under.data());
    return read(path, fmt::format("brought into {:g} to {:g}", low, high), use);
  }

  Map number(const std::string& path) {
    const Field& field = *find_field(path);
    return number(path, float(field.low), float(field.high), field.unit == "degrees" ? radians(1) : 1);
  }

  Map angle(const std::string& path, float turn) {
    PixelUse use;
    use.channels = 2;
    use.convert = [=](const float* pixel, float* value) {
      value[0] = std::cos(radians(*pixel + turn));
      value[1] = std::sin(radians(*pixel + turn));
      return true;  // angles go around
    };
    use.convert(&look.warp_angle_deg, use.under.data());
    return read(path, "angle", use);
  }

  /// A of a family as it is without its texture; a colour that the cloth cannot show: the nearest.
  std::array<float, 3> own_scale(const std::string& path, const Albedo& normal) const {
    const ThreadFamily& family = path.starts_with("warp") ? look.warp : look.weft;
    const ColorValue& own = family.color ? *family.color : family.A;
    const Color value = colors.to_working(own.value, own.space.empty() ? look.color_space : own.space);
    const float surface = normal.surface, volume = normal.volume[0] + normal.volume[1];
    std::array<float, 3> scale{};
    for (int c = 0; c < 3; ++c)
      scale[size_t(c)] = !family.color || !(volume > 0) ? std::max(value[c], 0.0f)
                                                        : std::clamp((value[c] - surface) / volume, 0.0f, 1.0f);
    return scale;
  }

  Map raw_scale(const std::string& path, const Albedo& normal) {
    const auto low = float(find_field(path)->low), high = float(find_field(path)->high);
    PixelUse use;
    use.is_color = true;
    use.channels = 3;
    use.convert = [=](const float* pixel, float* value) {
      bool inside = true;
      for (int c = 0; c < 3; ++c) inside &= clamp_into(value[c] = pixel[c], low, high);
      return inside;
    };
    use.under = own_scale(path, normal);
    return read(path, fmt::format("brought into {:g} to {:g}", low, high), use);
  }

  /// A of every pixel so that the cloth shows its colour: color = S + A V (cloth-model.md section 5).
  Map solved_color(const std::string& path, const Albedo& normal) {
    const float surface = normal.surface, volume = normal.volume[0] + normal.volume[1];
    PixelUse use;
    use.is_color = true;
    use.channels = 3;
    use.convert = [=](const float* pixel, float* value) {
      bool inside = true;
      for (int c = 0; c < 3; ++c) {
        float color = pixel[c];
        // What is left after rounding is far below what is seen.
        inside &= clamp_into(color, surface - 1e-4f, surface + volume);
        value[c] = std::clamp((color - surface) / volume, 0.0f, 1.0f);
      }
      return inside;
    };
    use.under = own_scale(path, normal);
    return read(path,
                fmt::format("the nearest that this cloth can show, {:.3g} to {:.3g} in every channel, is taken",
                            surface, surface + volume),
                use);
  }
};

/// Brings the coverage of both families within 1, at every point or by a warning.
void read_coverage(MapReader& reader, FabricMaps& maps) {
  const ThreadFamily* families[2] = {&reader.look.warp, &reader.look.weft};
  const char* paths[2] = {"warp.coverage", "weft.coverage"};
  const bool both = reader.has(paths[0]) && reader.has(paths[1]);
  for (size_t f = 0; f < 2; ++f)
    maps.coverage[f] = reader.number(paths[f], 0, both ? 1 : 1 - families[1 - f]->coverage, 1);
  if (both && maps.coverage[0]->high[0] + maps.coverage[1]->high[0] > 1.0001f)
    reader.warnings.push_back(fmt::format(
        "{}: the coverage of warp and weft reaches {:.3g} and {:.3g}: where they add up to more than 1, both "
        "are made smaller",
        reader.look.textures.at(paths[0]).origin, maps.coverage[0]->high[0], maps.coverage[1]->high[0]));
}

/// The look with the textures' means in their place, and the textures of its numbers.
Look with_mean_numbers(MapReader& reader, FabricMaps& maps, float turn) {
  Look mean = reader.look;
  mean.warp_angle_deg += turn;
  mean.textures.clear();
  read_coverage(reader, maps);
  ThreadFamily* families[2] = {&mean.warp, &mean.weft};
  for (size_t f = 0; f < 2; ++f) {
    const std::string name = f == 0 ? "warp." : "weft.";
    ThreadFamily& family = *families[f];
    const auto take = [](const Map& map, float& value, float unit) {
      if (map) value = map->mean[0] / unit;
    };
    maps.k_d[f] = reader.number(name + "k_d");
    maps.eta[f] = reader.number(name + "eta");
    maps.gamma_s[f] = reader.number(name + "gamma_s_deg");
    maps.gamma_v[f] = reader.number(name + "gamma_v_deg");
    take(maps.coverage[f], family.coverage, 1);
    take(maps.k_d[f], family.k_d, 1);
    take(maps.eta[f], family.eta, 1);
    take(maps.gamma_s[f], family.gamma_s_deg, radians(1));
    take(maps.gamma_v[f], family.gamma_v_deg, radians(1));
  }
  const float sum = mean.warp.coverage + mean.weft.coverage;
  if (sum > 1)
    for (ThreadFamily* family : families) family->coverage /= sum;
  if (!(sum > 0)) throw InputError(reader.look.file + ": the textures of coverage leave no threads at all");
  maps.warp_angle = reader.angle("warp_angle_deg", turn);
  if (maps.warp_angle) mean.warp_angle_deg = degrees(std::atan2(maps.warp_angle->mean[1], maps.warp_angle->mean[0]));
  return mean;
}

/// Widths of the narrowest lobes that any point has.
std::array<float, 2> narrowest_lobes(const FabricMaps& maps) {
  std::array<float, 2> narrowest{10, 10};
  for (size_t f = 0; f < 2; ++f) {
    const auto lower = [&](const Map& map) {
      if (map) narrowest[f] = std::min(narrowest[f], map->low[0]);
    };
    lower(maps.gamma_s[f]);
    lower(maps.gamma_v[f]);
    // A lobe that the means leave out may be there at some points.
    if (maps.eta[f]) narrowest[f] = std::min(narrowest[f], maps.constant.family[f].gamma_s);
    if (maps.k_d[f]) narrowest[f] = std::min(narrowest[f], maps.constant.family[f].gamma_v);
  }
  return narrowest;
}

/// CompiledSide::color_error; `normal`: what A was solved for.
float color_error(const Fabric& fabric, const FabricMaps& maps, const Albedo& normal) {
  constexpr int thetas = 72;  // two digits are told
  const Vec3 above(0, 0, 1);
  Threads<float> threads = fabric.varying->threads;
  float worst = 0;
  for (const NumberMap& number : number_maps)
    for (size_t f = 0; f < 2; ++f) {
      const Map& map = (maps.*number.map)[f];
      if (!map) continue;
      for (const float end : {map->low[0], map->high[0]}) {
        PointValues point = maps.constant;
        point.family[f].*number.value = end;
        settle_gap(point);
        rewrite_threads(*fabric.varying, point, threads);
        const Albedo there = albedo(threads, above, thetas);
        for (size_t c = 0; c < 3; ++c) {
          float error = there.surface - normal.surface;
          for (size_t g = 0; g < 2; ++g)
            error += (maps.A[g] ? maps.A[g]->high[c] : fabric.A[g][int(c)]) * (there.volume[g] - normal.volume[g]);
          worst = std::max(worst, std::abs(error));
        }
      }
    }
  return worst;
}

Fabric compile_mapped(const Look& look, const ColorManager& colors, FabricParts parts, float turn,
                      float metres_per_uv, FabricMaps& maps, CompiledSide& side) {
  const std::string working = colors.working_space();
  const ToWorking to_working = [&](const Color& c, const std::string& space) { return colors.to_working(c, space); };
  MapReader reader{look, colors, metres_per_uv, side.warnings};
  Look mean = with_mean_numbers(reader, maps, turn);
  maps.constant.family = {family_values(mean.warp), family_values(mean.weft)};
  parts.narrowest = narrowest_lobes(maps);

  Albedo normal;
  bool solves = false;
  for (const std::string name : {"warp", "weft"}) {
    solves |= reader.has(name + ".color");
    solves |= reader.has(name + ".A") && (name == "warp" ? look.warp : look.weft).color;
  }
  if (solves) {
    FabricParts threads_alone = parts;
    threads_alone.table = false;
    Look uncolored = mean;
    uncolored.warp.color.reset();
    uncolored.weft.color.reset();
    normal = albedo(compile_fabric(uncolored, to_working, threads_alone).threads, Vec3(0, 0, 1));
  }
  for (size_t f = 0; f < 2; ++f) {
    const std::string name = f == 0 ? "warp" : "weft";
    maps.A[f] = reader.has(name + ".color") ? reader.solved_color(name + ".color", normal)
                                            : reader.raw_scale(name + ".A", normal);
    if (!maps.A[f]) continue;
    const std::array<float, 3>& c = maps.A[f]->mean;
    ThreadFamily& family = f == 0 ? mean.warp : mean.weft;
    family.A = {Color(c[0], c[1], c[2]), working};
    family.color.reset();
  }
  Fabric fabric = compile_fabric(mean, to_working, parts);
  maps.constant.A = fabric.A;
  maps.constant.gap = fabric.gap;
  if (!maps.any_numbers()) return fabric;
  fabric.varying = std::make_shared<const VaryingThreads>(VaryingThreads{fabric.threads, maps.constant.family});
  if (reader.has("warp.color") || reader.has("weft.color"))
    side.color_error = std::max(side.color_error, color_error(fabric, maps, normal));
  return fabric;
}

}  // namespace

CompiledSide compile_side(const Look& look, const ColorManager& colors, const FabricParts& parts, float turn,
                          float metres_per_uv) {
  CompiledSide side;
  SideMaps maps;
  side.fabric = compile_mapped(look, colors, parts, turn, metres_per_uv, maps.own, side);
  if (!look.pattern_look.empty() && (look.pattern_mask > 0 || look.textures.contains("pattern.mask"))) {
    maps.pattern.emplace();
    PatternMaps& pattern = *maps.pattern;
    pattern.fabric = compile_mapped(read_pattern(look), colors, parts, turn, metres_per_uv, pattern.maps, side);
    pattern.share = look.pattern_mask;
    pattern.mask = MapReader{look, colors, metres_per_uv, side.warnings}.number("pattern.mask");
  }
  if (maps.own.any() || maps.pattern) side.maps = std::make_shared<const SideMaps>(std::move(maps));
  return side;
}

bool has_sized_textures(const Look& look) {
  for (const auto& [path, texture] : look.textures)
    if (is_sized(texture)) return true;
  return !look.pattern_look.empty() && has_sized_textures(read_pattern(look));
}

void set_sides(Scene& scene, CompiledSide front, std::optional<CompiledSide> back) {
  const auto sheer = [](const Fabric& fabric, const FabricMaps& maps) {
    return fabric.gap > 0 || maps.coverage[0] || maps.coverage[1];
  };
  const auto has_gaps = [&](const CompiledSide& side) {
    if (!side.maps) return side.fabric.gap > 0;
    const auto& pattern = side.maps->pattern;
    return sheer(side.fabric, side.maps->own) || (pattern && sheer(pattern->fabric, pattern->maps));
  };
  scene.has_gaps = has_gaps(front) || (back && has_gaps(*back));
  scene.has_maps = front.maps || (back && back->maps);
  scene.front = std::move(front.fabric);
  scene.front_maps = std::move(front.maps);
  scene.back.reset();
  scene.back_maps.reset();
  if (!back) return;
  scene.back = std::move(back->fabric);
  scene.back_maps = std::move(back->maps);
}

}  // namespace sateen
