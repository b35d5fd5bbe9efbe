#include "film/develop.h"

#include <algorithm>
#include <cmath>

#include "film/bands.h"
#include "film/error.h"

namespace sateen {

namespace {

void put(const Vec3& v, float* to) {
  for (int c = 0; c < 3; ++c) to[c] = v[c];
}

// A mean over samples, or over hits.
Vec3 mean(const Vec3& sum, std::uint64_t count) {
  return count ? sum / float(count) : Vec3(0);
}

using P = const FilmPixel&;
using L = const LayerPixel&;

/// Rows of a film on their way to layers.
struct Rows {
  const Film& film;
  int y0, y1;
  const std::function<bool(const std::string&)>& wanted;
  std::vector<ImageLayer> all = {};

  size_t first() const { return size_t(y0) * size_t(film.width); }

  ImageLayer* begin(const char* name, std::vector<std::string> channels) {
    if (!wanted(name)) return nullptr;
    const int count = int(channels.size());
    all.push_back({name, std::move(channels), false, Image(film.width, y1 - y0, count)});
    return &all.back();
  }

  template <class Value>
  void add(const char* name, const std::vector<std::string>& channels, const Value& value) {
    ImageLayer* out = begin(name, channels);
    if (!out) return;
    static const LayerPixel none;
    float* to = out->image.pixels.data();
    for (size_t i = first(), end = size_t(y1) * size_t(film.width); i < end; ++i, to += channels.size())
      value(film.pixels[i], film.layers.empty() ? none : film.layers[i], to);
  }

  template <class Sum>
  void light(const char* name, const Sum& sum) {
    add(name, {"R", "G", "B"}, [&](P p, L l, float* to) { put(mean(sum(l), p.samples), to); });
  }
  template <class Sum>
  void geometry(const char* name, const std::vector<std::string>& channels, const Sum& sum) {
    add(name, channels, [&](P, L l, float* to) { put(mean(sum(l), l.hits), to); });
  }

  /// A pixel's variance is known from its neighbours, too: the rows above and below belong to it.
  void error() {
    ImageLayer* out = begin("error", {"R", "G", "B"});
    if (!out) return;
    const int top = std::max(y0 - 1, 0), bottom = std::min(y1 + 1, film.height);
    const std::vector<Vec3d> variances = pooled_variances(film_rows(film, top, bottom));
    const size_t above = size_t(y0 - top) * size_t(film.width);
    float* to = out->image.pixels.data();
    for (size_t i = 0; i < out->image.pixels.size() / 3; ++i)
      for (int c = 0; c < 3; ++c) *to++ = float(std::sqrt(variances[above + i][c]));
  }
};

}  // namespace

Image develop_beauty(const Film& film, int y0, int y1) {
  Image image(film.width, y1 - y0, 4);
  float* to = image.pixels.data();
  for (size_t i = size_t(y0) * size_t(film.width), end = size_t(y1) * size_t(film.width); i < end; ++i, to += 4) {
    const FilmPixel& pixel = film.pixels[i];
    put(pixel_mean(pixel), to);
    // What a catcher catches is a ratio, whose noise passes 1: laid over a plate that would make light negative.
    const double alpha = pixel.samples == 0 ? 0 : film.opaque ? 1 : pixel_coverage(pixel);
    to[3] = float(std::clamp(alpha, 0.0, 1.0));
  }
  return image;
}

Image develop_beauty(const Film& film) {
  return develop_beauty(film, 0, film.height);
}

std::vector<ImageLayer> develop_layers(const Film& film, int y0, int y1,
                                       const std::function<bool(const std::string&)>& wanted) {
  Rows rows{film, y0, y1, wanted};
  rows.all.push_back({"", {"R", "G", "B", "A"}, true, develop_beauty(film, y0, y1)});
  const std::vector<std::string> rgb{"R", "G", "B"}, xyz{"X", "Y", "Z"};
  if (!film.layers.empty()) {
    rows.light("direct", [](L l) { return l.surface[0] + l.surface[1] + l.volume[0] + l.volume[1]; });
    rows.light("indirect", [](L l) { return l.indirect.total(); });
    rows.light("indirect_1", [](L l) { return l.indirect.bounce[0]; });
    rows.light("indirect_2", [](L l) { return l.indirect.bounce[1]; });
    rows.light("indirect_3", [](L l) { return l.indirect.bounce[2]; });
    rows.light("indirect_more", [](L l) { return l.indirect.bounce[3]; });
    rows.light("through_gaps", [](L l) { return l.through_gaps; });
    rows.light("backdrop", [](L l) { return l.backdrop; });
    rows.light("surface", [](L l) { return l.surface[0] + l.surface[1]; });
    rows.light("volume", [](L l) { return l.volume[0] + l.volume[1]; });
    rows.light("warp_surface", [](L l) { return l.surface[0]; });
    rows.light("warp_volume", [](L l) { return l.volume[0]; });
    rows.light("weft_surface", [](L l) { return l.surface[1]; });
    rows.light("weft_volume", [](L l) { return l.volume[1]; });
    rows.geometry("albedo", rgb, [](L l) { return Vec3(l.albedo); });
    rows.geometry("N", xyz, [](L l) { return l.normal; });
    rows.geometry("P", xyz, [](L l) { return l.position; });
    rows.geometry("warp", xyz, [](L l) { return l.warp; });
    rows.add("uv", {"U", "V"}, [](P, L l, float* to) {
      to[0] = l.hits ? l.uv.x / float(l.hits) : 0;
      to[1] = l.hits ? l.uv.y / float(l.hits) : 0;
    });
  }
  rows.error();
  rows.add("samples", {"Y"}, [](P p, L, float* to) { to[0] = float(p.samples); });
  return std::move(rows.all);
}

std::vector<ImageLayer> develop_layers(const Film& film) {
  return develop_layers(film, 0, film.height, [](const std::string&) { return true; });
}

Image composite(const Image& beauty, const Color& ground) {
  Image out(beauty.width, beauty.height, 3);
  for (size_t i = 0; i < size_t(beauty.width) * size_t(beauty.height); ++i)
    for (size_t c = 0; c < 3; ++c)
      out.pixels[i * 3 + c] = beauty.pixels[i * 4 + c] + ground[int(c)] * (1 - beauty.pixels[i * 4 + 3]);
  return out;
}

}  // namespace sateen
