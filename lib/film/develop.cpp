#include "film/develop.h"

#include <cmath>
#include <functional>

#include "film/error.h"

namespace sateen {

namespace {

ImageLayer layer(const Film& film, const char* name, std::vector<std::string> channels,
                 const std::function<void(const FilmPixel&, const LayerPixel&, float*)>& value) {
  ImageLayer out;
  out.name = name;
  out.image = Image(film.width, film.height, int(channels.size()));
  out.channels = std::move(channels);
  static const LayerPixel none;
  for (size_t i = 0; i < film.pixels.size(); ++i)
    value(film.pixels[i], film.layers.empty() ? none : film.layers[i],
          out.image.pixels.data() + i * size_t(out.image.channels));
  return out;
}

void put(const Vec3& v, float* to) {
  for (int c = 0; c < 3; ++c) to[c] = v[c];
}

// A mean over samples, or over hits.
Vec3 mean(const Vec3& sum, std::uint64_t count) {
  return count ? sum / float(count) : Vec3(0);
}

}  // namespace

Image develop_beauty(const Film& film) {
  Image image(film.width, film.height, 4);
  for (size_t i = 0; i < film.pixels.size(); ++i) {
    const FilmPixel& pixel = film.pixels[i];
    put(pixel_mean(pixel), &image.pixels[i * 4]);
    image.pixels[i * 4 + 3] = pixel.samples == 0 ? 0 : film.opaque ? 1 : float(pixel_coverage(pixel));
  }
  return image;
}

std::vector<ImageLayer> develop_layers(const Film& film) {
  std::vector<ImageLayer> all;
  ImageLayer beauty;
  beauty.channels = {"R", "G", "B", "A"};
  beauty.half = true;
  beauty.image = develop_beauty(film);
  all.push_back(std::move(beauty));

  const std::vector<std::string> rgb{"R", "G", "B"}, xyz{"X", "Y", "Z"};
  using P = const FilmPixel&;
  using L = const LayerPixel&;
  if (!film.layers.empty()) {
    const auto light = [&](const char* name, const std::function<Color(L)>& sum) {
      all.push_back(layer(film, name, rgb, [&](P p, L l, float* to) { put(mean(sum(l), p.samples), to); }));
    };
    light("direct", [](L l) { return l.surface[0] + l.surface[1] + l.volume[0] + l.volume[1]; });
    light("indirect", [](L l) { return l.indirect.total(); });
    light("indirect_1", [](L l) { return l.indirect.bounce[0]; });
    light("indirect_2", [](L l) { return l.indirect.bounce[1]; });
    light("indirect_3", [](L l) { return l.indirect.bounce[2]; });
    light("indirect_more", [](L l) { return l.indirect.bounce[3]; });
    light("through_gaps", [](L l) { return l.through_gaps; });
    light("backdrop", [](L l) { return l.backdrop; });
    light("surface", [](L l) { return l.surface[0] + l.surface[1]; });
    light("volume", [](L l) { return l.volume[0] + l.volume[1]; });
    light("warp_surface", [](L l) { return l.surface[0]; });
    light("warp_volume", [](L l) { return l.volume[0]; });
    light("weft_surface", [](L l) { return l.surface[1]; });
    light("weft_volume", [](L l) { return l.volume[1]; });
    const auto geometry = [&](const char* name, const std::vector<std::string>& channels,
                              const std::function<Vec3(L)>& sum) {
      all.push_back(layer(film, name, channels, [&](P, L l, float* to) { put(mean(sum(l), l.hits), to); }));
    };
    geometry("albedo", rgb, [](L l) { return Vec3(l.albedo); });
    geometry("N", xyz, [](L l) { return l.normal; });
    geometry("P", xyz, [](L l) { return l.position; });
    geometry("warp", xyz, [](L l) { return l.warp; });
    all.push_back(layer(film, "uv", {"U", "V"}, [](P, L l, float* to) {
      to[0] = l.hits ? l.uv.x / float(l.hits) : 0;
      to[1] = l.hits ? l.uv.y / float(l.hits) : 0;
    }));
  }
  all.push_back(layer(film, "error", rgb, [](P, L, float*) {}));
  const std::vector<Vec3d> variances = pooled_variances(film);
  for (size_t i = 0; i < variances.size(); ++i)
    for (size_t c = 0; c < 3; ++c) all.back().image.pixels[3 * i + c] = float(std::sqrt(variances[i][int(c)]));
  all.push_back(layer(film, "samples", {"Y"}, [](P p, L, float* to) { to[0] = float(p.samples); }));
  return all;
}

Image composite(const Image& beauty, const Color& ground) {
  Image out(beauty.width, beauty.height, 3);
  for (size_t i = 0; i < size_t(beauty.width) * size_t(beauty.height); ++i)
    for (size_t c = 0; c < 3; ++c)
      out.pixels[i * 3 + c] = beauty.pixels[i * 4 + c] + ground[int(c)] * (1 - beauty.pixels[i * 4 + 3]);
  return out;
}

}  // namespace sateen
