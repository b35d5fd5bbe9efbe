#include "image/exr_light.h"

#include <fmt/format.h>

#include "image/exr_cube.h"
#include "image/exr_picture.h"

namespace sateen {

namespace fs = std::filesystem;

namespace {
ExrLayer choose_light(const fs::path& path, const std::vector<ExrPart>& parts, const std::string& wanted) {
  std::vector<ExrLayer> layers = exr_layers(parts);
  const int chosen = choose_layer(parts, wanted, layers);
  if (chosen >= 0) return layers[size_t(chosen)];
  const std::string list = layers_text(parts);
  if (!wanted.empty()) refuse_picture(path, fmt::format("has no layer \"{:.60}\"", wanted), "its layers are " + list);
  refuse_picture(path, "does not say which of its layers is the light: " + list,
                 "choose one with --env-layer NAME; R, G, B without a name, Combined, rgba or beauty go first");
}

void tell(ExrPicture& picture) {
  const ExrLayer& layer = picture.layer;
  LightFileInfo& info = picture.info;
  if (layer.guessed)
    info.doubts.push_back(fmt::format("its {}; --env-layer NAME takes another", guess_text(layer, "the light")));
  else if (!layer.name.empty())
    info.notes.push_back(fmt::format("its layer {:.80} is the light", layer.name));
  if (layer.kind == LayerKind::grey && !layer.guessed)
    info.notes.push_back("it has no colours and is taken as grey light");
  if (layer.kind == LayerKind::chroma) info.notes.push_back("its luminance and chroma were made RGB");
  if (!picture.outside.empty()) info.notes.push_back(picture.outside);
}
}  // namespace

std::unique_ptr<LightFile> open_exr_light(const fs::path& path, const std::string& layer, const ImageLimits& limits) {
  std::unique_ptr<ExrPicture> picture =
      open_exr_picture(path, [&](const std::vector<ExrPart>& parts) { return choose_light(path, parts, layer); });
  tell(*picture);
  const bool cube = picture->cube;
  if (cube) return unfold_cube(path, std::move(picture), limits);
  return picture;
}

}  // namespace sateen
