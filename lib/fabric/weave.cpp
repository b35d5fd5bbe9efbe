#include "fabric/weave.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fabric/tangent_curve.h"
#include "fabric/tangent_terms.h"
#include "look/draft.h"
#include "math/angles.h"

namespace sateen {

namespace {

// Places along a yarn at which its thickness is drawn anew, tuned by eye on dupioni and linen [metres].
constexpr double irregular_length = 0.006, slub_length = 0.018;
// Edges that stray by half a spacing would cross their neighbours'.
constexpr double most_stray = 0.49;
// Light that is missing at a yarn's edge, where its neighbour stands in the way, on a float's flanks and at its ends,
// and at the edge of a strand of fibres.
constexpr double flank_dark = 0.5, end_dark = 1, strand_dark = 0.8;

double share_of(std::uint64_t hash) {
  return double(hash >> 11) * 0x1p-53;
}

/// Uniform in [0, 1) by yarn, place and use: SplitMix64's finalizer.
double drawn(long long yarn, long long place, std::uint64_t use) {
  std::uint64_t z = (std::uint64_t(yarn) * 0x9e3779b97f4a7c15u + std::uint64_t(place)) * 0xd1342543de82ef95u + use;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return share_of(z ^ (z >> 31));
}

/// Smooth noise in [0, 1) along a yarn.
double along_yarn(long long yarn, double place, std::uint64_t use) {
  const double cell = std::floor(place), f = place - cell, s = f * f * (3 - 2 * f);
  const auto k = static_cast<long long>(cell);
  return (1 - s) * drawn(yarn, k, use) + s * drawn(yarn, k + 1, use);
}

/// One family's strips: warp yarns counted along y and running along x, or the other way round.
struct Strips {
  const Weave& weave;
  bool warp;
  double width;  // share of the spacing
  double spacing = warp ? weave.warp_spacing : weave.weft_spacing;

  /// How much wider than its spacing a slub makes half of a weft yarn: one place in five is thick.
  double slub(long long yarn, double along) const {
    if (warp || weave.slubs == 0) return 0;
    const double thick = along_yarn(yarn, along / slub_length, 3) * along_yarn(yarn, along / (9 * slub_length), 4);
    const double t = std::clamp((thick - 0.42) / 0.3, 0.0, 1.0);
    return 0.45 * weave.slubs * t * t * (3 - 2 * t);
  }

  /// Where yarn `yarn` begins, in spacings; yarns share their edges, so that all of them together always fill the
  /// cloth.
  double edge(long long yarn, double along) const {
    double stray = 0;
    if (weave.irregularity > 0) {
      const std::uint64_t use = warp ? 1 : 2;
      const double own = drawn(yarn, 0, use + 10), wandering = along_yarn(yarn, along / irregular_length, use);
      stray += weave.irregularity * (own + wandering - 1);
    }
    if (!warp && weave.slubs > 0) stray += slub(yarn - 1, along) - slub(yarn, along);
    return double(yarn) + std::clamp(stray, -most_stray, most_stray);
  }

  long long yarn_at(double place, double along) const {
    auto yarn = static_cast<long long>(std::floor(place));
    if (place < edge(yarn, along)) return yarn - 1;
    if (place >= edge(yarn + 1, along)) return yarn + 1;
    return yarn;
  }

  /// The yarn's strip, in spacings.
  struct Strip {
    double from, to;
  };
  Strip strip(long long yarn, double along) const {
    const double from = edge(yarn, along), to = edge(yarn + 1, along), margin = (to - from) * (1 - width) / 2;
    return {from + margin, to - margin};
  }
};

int wrapped(long long i, int n) {
  return int((i % n + n) % n);
}

bool warp_on_top(const Weave& w, long long end, long long pick) {
  return w.warp_up[size_t(wrapped(pick, w.picks)) * size_t(w.ends) + size_t(wrapped(end, w.ends))] != 0;
}

/// Share of a float that lies behind `place` [spacings of the crossing family] along yarn `yarn` of the strips `own`.
/// A float runs from the strip of one yarn that covers it to the next such strip.
double float_share(const Weave& weave, const Strips& own, const Strips& crossing, long long yarn, long long at,
                   double place, double across) {
  const int repeat = own.warp ? weave.picks : weave.ends, phase = wrapped(at, repeat);
  const size_t family = own.warp ? 0 : 1, index = size_t(wrapped(yarn, own.warp ? weave.ends : weave.picks));
  const std::uint16_t* const covers = weave.covered[family].data() + weave.covered_from[family][index];
  const auto count =
      static_cast<long long>(weave.covered_from[family][index + 1] - weave.covered_from[family][index]);
  // A yarn that nothing covers floats from repeat to repeat.
  double from = double(at - phase), to = from + repeat;
  // The i-th crossing that covers the yarn, counted on over the repeats.
  const auto cover = [&](long long i) {
    const long long turn = i < 0 ? (i + 1) / count - 1 : i / count;
    return at - phase + turn * repeat + covers[i - turn * count];
  };
  const long long behind = std::upper_bound(covers, covers + count, phase) - covers - 1;
  for (long long i = behind; count > 0 && cover(i) >= at - repeat; --i)
    if (const double end = crossing.strip(cover(i), across).to; end <= place) {
      from = end;
      break;
    }
  const long long ahead = std::lower_bound(covers, covers + count, phase) - covers;
  for (long long i = ahead; count > 0 && cover(i) <= at + repeat; ++i)
    if (const double begin = crossing.strip(cover(i), across).from; begin >= place) {
      to = begin;
      break;
    }
  return to > from ? std::clamp((place - from) / (to - from), 0.0, 1.0) : 0.5;
}

}  // namespace

YarnWidths yarn_widths(double warp, double weft, double up) {
  const double gap = std::max(0.0, 1 - warp - weft);
  // Where nothing shows between the yarns one of the two families fills its spacing.
  if (gap < 1e-6) {
    if (weft <= 1 - up) return {1, up < 1 ? weft / (1 - up) : 0};
    return {std::min(1.0, warp / up), 1};
  }
  // warp = w (up + (1 - up) (1 - v)) and gap = (1 - w) (1 - v): a quadratic of which the smaller root is meant.
  const double b = up + (1 - up) * gap + warp;
  const double w = 2 * warp / (b + std::sqrt(std::max(0.0, b * b - 4 * up * warp)));
  return {w, std::clamp(1 - gap / (1 - w), 0.0, 1.0)};
}

Weave compile_weave(const Look& look) {
  Weave weave;
  if (look.weave.draft.empty()) return weave;
  const Draft draft = parse_draft(look.weave.draft);
  weave.ends = draft.ends;
  weave.picks = draft.picks;
  // Drawn with the warp upright, the left end has the largest y and the lowest pick the smallest x.
  int up = 0;
  for (int pick = 0; pick < draft.picks; ++pick)
    for (int end = 0; end < draft.ends; ++end) {
      weave.warp_up.push_back(draft.up(draft.ends - 1 - end, draft.picks - 1 - pick) ? 1 : 0);
      up += weave.warp_up.back();
    }
  weave.up = double(up) / (double(draft.ends) * draft.picks);
  for (size_t family = 0; family < 2; ++family) {
    const int yarns = family == 0 ? weave.ends : weave.picks, across = family == 0 ? weave.picks : weave.ends;
    weave.covered_from[family].push_back(0);
    for (int yarn = 0; yarn < yarns; ++yarn) {
      for (int i = 0; i < across; ++i)
        if (family == 0 ? !warp_on_top(weave, yarn, i) : warp_on_top(weave, i, yarn))
          weave.covered[family].push_back(std::uint16_t(i));
      weave.covered_from[family].push_back(std::uint32_t(weave.covered[family].size()));
    }
  }
  weave.warp_spacing = 0.01 / double(look.weave.warp_per_cm);
  weave.weft_spacing = 0.01 / double(look.weave.weft_per_cm);
  weave.coverage = {double(look.warp.coverage), double(look.weft.coverage)};
  weave.widths = yarn_widths(weave.coverage[0], weave.coverage[1], weave.up);
  weave.irregularity = double(look.weave.irregularity);
  weave.slubs = double(look.weave.slubs);
  for (int family = 0; family < 2; ++family) {
    const ThreadFamily& f = family == 0 ? look.warp : look.weft;
    weave.offsets_deg[size_t(family)] = f.offsets_deg;
    weave.lengths[size_t(family)] = f.lengths;
    // Filaments that lie straight and smooth, as narrow lobes tell, make a smooth yarn with a narrow streak; spun and
    // twisted ones turn their normals every way. Tuned by eye.
    weave.surface_width[size_t(family)] = std::clamp(0.25 + 1.5 * double(radians(f.gamma_s_deg)), 0.3, 1.2);
    weave.volume_width[size_t(family)] = std::clamp(0.9 + 1.0 * double(radians(f.gamma_v_deg)), 1.0, 2.0);
    // And their fibres run round the yarn, at up to 25 degrees.
    const double angle = std::clamp(2.5 * (double(f.gamma_s_deg) - 4), 0.0, 25.0) * std::numbers::pi / 180;
    const double width =
        family == 0 ? weave.widths.warp * weave.warp_spacing : weave.widths.weft * weave.weft_spacing;
    weave.twist[size_t(family)] = width > 0 ? strands_across * std::tan(angle) / width : 0;
  }
  return weave;
}

namespace {

YarnPlace place_at(const Weave& weave, const YarnWidths& widths, double x, double y) {
  const Strips warp{weave, true, widths.warp}, weft{weave, false, widths.weft};
  const double across_warp = y / weave.warp_spacing, across_weft = x / weave.weft_spacing;
  const long long end = warp.yarn_at(across_warp, x), pick = weft.yarn_at(across_weft, y);
  const Strips::Strip warp_strip = warp.strip(end, x), weft_strip = weft.strip(pick, y);
  const bool in_warp = warp_strip.from < across_warp && across_warp < warp_strip.to;
  const bool in_weft = weft_strip.from < across_weft && across_weft < weft_strip.to;
  YarnPlace place;
  if (!in_warp && !in_weft) return place;
  const bool warp_shows = in_warp && (!in_weft || warp_on_top(weave, end, pick));
  place.family = warp_shows ? 0 : 1;
  const auto family = size_t(place.family);
  const Strips::Strip& strip = warp_shows ? warp_strip : weft_strip;
  const double at = warp_shows ? across_warp : across_weft, along = warp_shows ? x : y;
  const double across = (2 * at - strip.from - strip.to) / (strip.to - strip.from);
  const double share = warp_shows ? float_share(weave, warp, weft, end, pick, across_weft, y)
                                  : float_share(weave, weft, warp, pick, end, across_warp, x);
  // A float climbs at its beginning and dives at its end: its curve from the last offset to the first.
  place.offset =
      float(tangent_offset(weave.offsets_deg[family], weave.lengths[family], std::min(1 - share, 1 - 0x1p-53)));
  place.across = float(across);
  const double end_of_float = (2 * share - 1) * (2 * share - 1);
  place.dark = float(flank_dark + (end_dark - flank_dark) * end_of_float * end_of_float);
  const double strand =
      strands_across * (across + 1) / 2 + weave.twist[family] * along + drawn(warp_shows ? end : pick, 0, 5 + family);
  place.fibre = float(2 * (strand - std::floor(strand)) - 1);
  return place;
}

}  // namespace

void close_gaps(Weave& weave) {
  const double sum = weave.coverage[0] + weave.coverage[1];
  if (weave.empty() || !(sum > 0)) return;
  weave.widths = yarn_widths(weave.coverage[0] / sum, weave.coverage[1] / sum, weave.up);
  weave.closed = true;
}

YarnPlace yarn_at(const Weave& weave, double x, double y) {
  YarnPlace place = place_at(weave, weave.widths, x, y);
  if (weave.closed) place.light = float(std::min(weave.coverage[0] + weave.coverage[1], 1.0));
  return place;
}

YarnPlace yarn_at(const Weave& weave, const std::array<double, 2>& coverage, double x, double y) {
  const double sum = coverage[0] + coverage[1], whole = weave.closed || sum > 1 ? sum : 1;
  if (!(sum > 0)) return {};
  YarnPlace place = place_at(weave, yarn_widths(coverage[0] / whole, coverage[1] / whole, weave.up), x, y);
  if (weave.closed) place.light = float(std::min(sum, 1.0));
  return place;
}

double profile(double across, double middle, double width, double dark) {
  // (1 - dark s^2) / (1 + t^2) with s = middle + width t, over its mean for s from -1 to 1 in closed form.
  const double t0 = (-1 - middle) / width, t1 = (1 - middle) / width;
  const double arc = fast_atan2(t1, 1) - fast_atan2(t0, 1);
  const double log = std::log((1 + t1 * t1) / (1 + t0 * t0)) / 2;
  const double mean = width / 2 *
                      (arc * (1 - dark * (middle * middle - width * width)) -
                       dark * (2 * middle * width * log + width * width * (t1 - t0)));
  const double t = (across - middle) / width;
  return (1 - dark * across * across) / (1 + t * t) / mean;
}

void add_yarn(const Weave& weave, const Threads<float>& threads, const YarnPlace& place, const Vec3& wo,
              const Vec3& wi, ThreadSums<float>& parts) {
  for (int family = 0; family < 2; ++family) {
    parts.surface[size_t(family)] *= 1 - place.near;
    parts.volume[size_t(family)] *= 1 - place.near;
  }
  if (place.family < 0 || !(parts.reweight > 0)) return;
  const auto family = size_t(place.family);
  const int index = threads.first[family];
  if (index < 0) return;
  const TangentTerms terms = tangent_terms(threads, index, double(place.offset), wo, wi);
  const double scale = double(place.near) * double(place.light) / double(parts.reweight);
  const double middle = std::clamp(terms.half_azimuth, -1.0, 1.0);
  const auto weight = [&](double width) {
    const double yarn = profile(double(place.across), middle, width, double(place.dark));
    if (place.strands == 0) return yarn;
    return yarn + double(place.strands) * (profile(double(place.fibre), middle, width, strand_dark) - yarn);
  };
  parts.surface[family] += float(scale * terms.surface * weight(weave.surface_width[family]));
  parts.volume[family] += float(scale * terms.volume * weight(weave.volume_width[family]));
}

float passing(float gap, const YarnPlace& place) {
  return gap * (1 - place.near) + (place.family < 0 ? place.near : 0.0f);
}

}  // namespace sateen
