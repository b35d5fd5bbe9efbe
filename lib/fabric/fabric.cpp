#include "fabric/fabric.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace sateen {

namespace {

// The narrower lobe that is there at all sets how closely the curve must be sampled.
double narrowest_lobe(const ThreadFamily& f) {
  float gamma = 90;
  if (f.eta > 1) gamma = std::min(gamma, f.gamma_s_deg);
  if (f.k_d < 1) gamma = std::min(gamma, f.gamma_v_deg);
  return double(radians(gamma));
}

// Whether the curve is its own mirror image: the offsets' density at alpha and at -alpha is the same.
bool symmetric(const ThreadFamily& f, const std::vector<Tangent>& tangents) {
  if (!(f.coverage > 0)) return true;
  return std::all_of(tangents.begin(), tangents.end(), [&](const Tangent& t) {
    double here = 0, there = 0;
    for (const Tangent& o : tangents) {
      if (std::abs(o.offset() - t.offset()) < 1e-9) here += o.weight;
      if (std::abs(o.offset() + t.offset()) < 1e-9) there += o.weight;
    }
    return std::abs(here - there) < 1e-9;
  });
}

// A_j so that a cloth of this family's threads alone in both directions would show `color` at normal view:
// color = S + A (V_0 + V_1) in every channel (cloth-model.md section 5).
Color solve_volume_color(const Color& color, const Albedo& normal, const std::string& family) {
  const float volume = normal.volume[0] + normal.volume[1];
  Color A;
  for (int c = 0; c < 3; ++c) {
    A[c] = (color[c] - normal.surface) / volume;
    if (!(A[c] >= 0) || !(A[c] <= 1))
      throw InputError(
          fmt::format("{}.color is ({:.4g}, {:.4g}, {:.4g}) in the working space, reachable is {:.4g} to {:.4g} in "
                      "every channel",
                      family, color.x, color.y, color.z, normal.surface, normal.surface + volume),
          A[c] < 0 ? "the surface lobe alone is brighter: raise the colour, or lower eta"
                   : "lower the colour, or raise k_d");
  }
  return A;
}

}  // namespace

Color same_space(const Color& value, const std::string&) {
  return value;
}

Albedo albedo(const Threads<float>& threads, const Vec3& wo, int thetas) {
  const int phis = thetas / 2;
  ThreadView<float> view;
  prepare_view<float>(threads, wo.x, wo.y, wo.z, view);
  double surface = 0, surface_of[2] = {0, 0}, volume[2] = {0, 0};
  const double step = double(pi) / thetas, step_phi = double(pi) / phis;
  for (int i = 0; i < thetas; ++i)
    for (int j = 0; j < phis; ++j) {
      const double theta = (i + 0.5) * step - pi / 2.0, phi = (j + 0.5) * step_phi - pi / 2.0;
      const double c = std::cos(theta), weight = c * step * step_phi;
      const ThreadSums<float> s =
          scatter<float>(threads, view, float(std::sin(theta)), float(c * std::sin(phi)), float(c * std::cos(phi)));
      surface += weight * (double(s.surface[0]) + s.surface[1]);
      for (int family = 0; family < 2; ++family) {
        surface_of[family] += weight * s.surface[family];
        volume[family] += weight * s.volume[family];
      }
    }
  return {float(surface), {float(volume[0]), float(volume[1])}, {float(surface_of[0]), float(surface_of[1])}};
}

Color albedo_color(const Fabric& fabric, const Vec3& wo, int thetas) {
  const Albedo a = albedo(fabric.threads, wo, thetas);
  return Color(a.surface) + fabric.A[0] * a.volume[0] + fabric.A[1] * a.volume[1];
}

Fabric compile_fabric(const Look& look, const ToWorking& to_working, const FabricParts& parts) {
  Fabric fabric;
  fabric.name = look.name;
  const auto quadrature = [&](const ThreadFamily& f, float narrowest) {
    return render_quadrature(f.offsets_deg, f.lengths, std::min(narrowest_lobe(f), double(narrowest)),
                             double(radians(look.masking_width_deg)), double(parts.quadrature));
  };
  const std::vector<Tangent> warp = quadrature(look.warp, parts.narrowest[0]),
                             weft = quadrature(look.weft, parts.narrowest[1]);
  fabric.threads = compile_threads<float>(look, warp, weft);
  fabric.gap = fabric.threads.gap;
  fabric.warp_angle = radians(look.warp_angle_deg);
  fabric.talk = compile_talk(look, warp, weft);
  fabric.weave = compile_weave(look);

  const bool solve = look.warp.color || look.weft.color;
  const Albedo normal = solve ? albedo(fabric.threads, Vec3(0, 0, 1)) : Albedo();
  for (int family = 0; family < 2; ++family) {
    const ThreadFamily& f = family == 0 ? look.warp : look.weft;
    const ColorValue& authored = f.color ? *f.color : f.A;
    const Color value = to_working(authored.value, authored.space.empty() ? look.color_space : authored.space);
    fabric.A[family] =
        f.color && f.coverage > 0 ? solve_volume_color(value, normal, family == 0 ? "warp" : "weft") : value;
    // A wide-gamut conversion may leave a hair below zero.
    for (int c = 0; c < 3; ++c) fabric.A[family][c] = std::max(fabric.A[family][c], 0.0f);
  }
  if (parts.table) {
    const auto coarse = [](const ThreadFamily& f) {
      return table_quadrature(f.offsets_deg, f.lengths, narrowest_lobe(f));
    };
    Threads<float> threads = compile_threads<float>(look, coarse(look.warp), coarse(look.weft));
    threads.grazing.clear();
    fabric.table = tabulate_directions(threads, mean_component(fabric.A[0]), mean_component(fabric.A[1]),
                                       symmetric(look.warp, warp), symmetric(look.weft, weft), parts.threads,
                                       double(parts.table_size));
  }
  return fabric;
}

void prepare_threads(const Fabric& fabric, const Vec3& wo, FabricView& view, const PointValues* point) {
  view.fabric = &fabric;
  view.A = point ? point->A : fabric.A;
  view.own_threads = &fabric.threads;
  if (point && fabric.varying) {
    if (view.rewritten_from != fabric.varying) {
      view.rewritten = fabric.varying->threads;
      view.rewritten_from = fabric.varying;
    }
    rewrite_threads(*fabric.varying, *point, view.rewritten);
    view.own_threads = &view.rewritten;
  }
  prepare_view<float>(*view.own_threads, wo.x, wo.y, wo.z, view.threads);
}

void prepare_sampler(const Fabric& fabric, const Vec3& wo, FabricSampler sampler, SamplerView& view) {
  view.fabric = &fabric;
  view.sampler = sampler;
  if (sampler == FabricSampler::table) view.table = prepare_table(fabric.table, wo);
  if (sampler == FabricSampler::talk) prepare_talk(fabric.talk, wo, view.talk);
}

void prepare_view(const Fabric& fabric, const Vec3& wo, FabricSampler sampler, FabricView& view,
                  const PointValues* point) {
  prepare_threads(fabric, wo, view, point);
  prepare_sampler(fabric, wo, sampler, view.sampler);
}

ThreadSums<float> evaluate_parts(const FabricView& view, const Vec3& wi) {
  return scatter<float>(*view.own_threads, view.threads, wi.x, wi.y, wi.z);
}

ThreadSums<float> evaluate_parts(const FabricView& view, const YarnPlace& yarn, const Vec3& wi) {
  ThreadSums<float> parts = evaluate_parts(view, wi);
  if (yarn.near > 0) {
    const float* wo = view.threads.wo;
    add_yarn(view.fabric->weave, *view.own_threads, yarn, Vec3(wo[0], wo[1], wo[2]), wi, parts);
  }
  return parts;
}

Color combine_parts(const FabricView& view, const ThreadSums<float>& s) {
  return Color(s.surface[0] + s.surface[1]) + view.A[0] * s.volume[0] + view.A[1] * s.volume[1];
}

Color evaluate(const FabricView& view, const Vec3& wi) {
  return combine_parts(view, evaluate_parts(view, wi));
}

float pdf(const SamplerView& view, const Vec3& wi) {
  switch (view.sampler) {
    case FabricSampler::uniform:
      return wi.z > 0 ? 1 / (2 * pi) : 0;
    case FabricSampler::talk:
      return talk_pdf(view.fabric->talk, view.talk, wi);
    case FabricSampler::table:
      return table_pdf(view.table, wi);
  }
  return 0;
}

BsdfValue evaluate_with_pdf(const FabricView& view, const Vec3& wi) {
  return {evaluate(view, wi), pdf(view.sampler, wi)};
}

std::optional<Vec3> sample(const SamplerView& view, const FabricRandom& u) {
  switch (view.sampler) {
    case FabricSampler::uniform: {
      const float z = std::max(1 - float(u.direction[0]), 1e-9f), r = std::sqrt(std::max(1 - z * z, 0.0f));
      const float angle = 2 * pi * float(u.direction[1]);
      return Vec3(r * std::cos(angle), r * std::sin(angle), z);
    }
    case FabricSampler::talk: {
      const Vec3 wi = sample_talk(view.fabric->talk, view.talk, u.thread, u.direction);
      return wi.z > 0 ? std::optional<Vec3>(wi) : std::nullopt;
    }
    case FabricSampler::table:
      return sample_table(view.table, u.choice, u.direction[0], u.direction[1]);
  }
  return std::nullopt;
}

}  // namespace sateen
