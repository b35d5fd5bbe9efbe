#include "image/exr_texture.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/file_identity.h"
#include "image/bands.h"
#include "image/exr_header.h"
#include "image/exr_picture.h"

namespace sateen {

namespace fs = std::filesystem;

namespace {
struct Choice {
  ExrLayer layer;
  std::string alpha;
};

Choice choose_texture(const fs::path& path, const std::vector<ExrPart>& parts, const std::string& wanted,
                      bool number) {
  std::vector<ExrLayer> layers = exr_layers(parts);
  const int chosen = (number ? choose_number : choose_layer)(parts, wanted, layers);
  if (chosen >= 0) {
    const ExrLayer& layer = layers[size_t(chosen)];
    const std::vector<std::string>& whole = parts[size_t(layer.part)].whole_numbers;
    if (wanted.empty() && std::find(whole.begin(), whole.end(), layer.channels[0]) != whole.end())
      refuse_picture(
          path,
          fmt::format("its channel {:.60} holds integers, names of objects as a rule, expected half or "
                      "float",
                      layer.channels[0]),
          fmt::format("\"layer\": \"{:.60}\" beside \"texture\" takes them as they are", layer.channels[0]));
    return {layer, layer.alone && !wanted.empty() ? "" : alpha_of(parts, layer)};
  }
  const std::string list = layers_text(parts);
  if (!wanted.empty())
    refuse_picture(path, fmt::format("has no layer \"{:.60}\"{}", wanted, number ? " that holds a number" : ""),
                   "its layers are " + list);
  refuse_picture(path,
                 fmt::format("does not say which of its layers is the {}: {}", number ? "number" : "colour", list),
                 "choose one by \"layer\": \"NAME\" beside \"texture\", or a channel by its whole name");
}

/// `channels` of the picture's three go to every pixel of `image`, from its channel `first` on.
void copy_rows(LightFile& from, Image& image, int first, int channels) {
  const int step = band_rows(std::int64_t(image.width) * 3 * std::int64_t(sizeof(float)));
  std::vector<float> band;
  for (int y = 0; y < image.height; y += step) {
    const int rows = std::min(step, image.height - y);
    band.resize(size_t(3) * size_t(image.width) * size_t(rows));
    from.read_rows(y, rows, band.data());
    for (size_t i = 0; i < band.size() / 3; ++i)
      std::copy_n(&band[3 * i], channels, image.at(0, y) + i * size_t(image.channels) + first);
  }
}
}  // namespace

ExrTexture read_exr_texture(const fs::path& path, const std::string& wanted, bool number, const ImageLimits& limits) {
  note_file_read(path);
  check_exr_header(path);
  Choice choice;
  const auto picture = open_exr_picture(path, [&](const std::vector<ExrPart>& parts) {
    choice = choose_texture(path, parts, wanted, number);
    return choice.layer;
  });
  const ExrLayer& layer = choice.layer;
  const bool alpha = !choice.alpha.empty();
  const int colours = layer.kind == LayerKind::grey ? 1 : 3;
  ExrTexture texture;
  check_image_size(path, "picture", picture->info.width, picture->info.height, colours + alpha, limits);
  texture.image = Image(picture->info.width, picture->info.height, colours + alpha);
  copy_rows(*picture, texture.image, 0, colours);
  if (alpha) {
    const auto other = open_exr_picture(path, [&](const std::vector<ExrPart>&) {
      return ExrLayer{choice.alpha, LayerKind::grey, layer.part, false, false, {choice.alpha, "", ""}, true};
    });
    copy_rows(*other, texture.image, colours, 1);
  }
  ImageFileInfo& info = texture.info;
  info.width = texture.image.width;
  info.height = texture.image.height;
  info.channels = texture.image.channels;
  info.channel_names.assign(layer.channels.begin(), layer.channels.begin() + colours);
  if (alpha) info.channel_names.push_back(choice.alpha);
  info.format = picture->info.format;
  info.pixel_type = picture->info.pixel_type;
  info.chromaticities = picture->info.chromaticities;
  info.alpha_channel = alpha ? colours : -1;
  info.colors_times_alpha = alpha;
  texture.xyz = picture->info.xyz;
  if (layer.guessed) texture.doubt = "its " + guess_text(layer, number ? "the number" : "the colour");
  return texture;
}

}  // namespace sateen
