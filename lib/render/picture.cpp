#include "render/picture.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "base/nearest_name.h"
#include "base/parallel.h"
#include "film/develop.h"
#include "look/json.h"

namespace sateen {

namespace fs = std::filesystem;

namespace {
std::string extension_of(const fs::path& path) {
  std::string extension = path.extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

// Display light and code values: a plain 2.2 power, near enough to sRGB and Rec.1886 for mixing at an edge.
float light(float code) {
  return std::pow(code, 2.2f);
}
float code(float light) {
  return std::pow(std::max(light, 0.0f), 1 / 2.2f);
}
}  // namespace

DisplaySettings settle_display(DisplaySettings settings, const ColorManager& colors) {
  if (settings.display.empty()) settings.display = colors.default_display();
  if (settings.view.empty()) settings.view = colors.default_view(settings.display);
  Image probe(1, 1, 3);
  colors.to_display(probe, settings.display, settings.view, 0);
  return settings;
}

float paper_code(float x, float y) {
  // Tuned by eye on all shipped looks: dark enough for ivory to stand out, light enough for black to have an outline.
  constexpr float middle = 0.36f, corner = 0.17f;
  const float dx = (x - 0.5f) / 0.72f, dy = (y - 0.46f) / 0.72f;
  const float t = std::min(std::sqrt(dx * dx + dy * dy), 1.0f);
  return middle + (corner - middle) * t * t * (3 - 2 * t);
}

Image develop_display(const Image& beauty, const ColorManager& colors, const DisplaySettings& settings,
                      float exposure_ev) {
  Image cloth = beauty;
  for (size_t i = 0; i < cloth.pixels.size(); i += 4)
    if (const float alpha = cloth.pixels[i + 3]; alpha > 0)
      for (size_t c = 0; c < 3; ++c) cloth.pixels[i + c] /= alpha;
  colors.to_display(cloth, settings.display, settings.view, exposure_ev);
  if (settings.transparent) return cloth;

  Image out(cloth.width, cloth.height, 3);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      const float* from = cloth.at(x, y);
      float* to = out.at(x, y);
      const float alpha = std::clamp(from[3], 0.0f, 1.0f);
      const float paper = paper_code((float(x) + 0.5f) / float(out.width), (float(y) + 0.5f) / float(out.height));
      for (int c = 0; c < 3; ++c) {
        const float ground = settings.ground ? (*settings.ground)[c] : paper;
        to[c] = alpha >= 1   ? from[c]
                : alpha <= 0 ? ground
                             : code(light(from[c]) * alpha + light(ground) * (1 - alpha));
      }
    }
  return out;
}

void lay_over(Image& picture, const Image& overlay) {
  for (size_t i = 0; i < picture.pixels.size(); i += 4) {
    const float left = 1 - overlay.pixels[i + 3];
    for (size_t c = 0; c < 4; ++c) picture.pixels[i + c] = picture.pixels[i + c] * left + overlay.pixels[i + c];
  }
}

Image crop_image(const Image& image, const Crop& window) {
  if (window.x1 <= window.x0 || window.y1 <= window.y0) return image;
  const int x0 = std::clamp(window.x0, 0, image.width), x1 = std::clamp(window.x1, x0, image.width);
  const int y0 = std::clamp(window.y0, 0, image.height), y1 = std::clamp(window.y1, y0, image.height);
  Image out(x1 - x0, y1 - y0, image.channels);
  for (int y = y0; y < y1; ++y)
    std::copy_n(image.at(x0, y), size_t(x1 - x0) * size_t(image.channels), out.at(0, y - y0));
  return out;
}

bool is_exr(const fs::path& path) {
  return extension_of(path) == "exr";
}

const std::vector<std::string>& picture_extensions() {
  static const std::vector<std::string> all{"exr", "png", "jpg", "jpeg", "tif", "tiff"};
  return all;
}

void check_picture_path(const fs::path& path, bool try_it) {
  const auto& known = picture_extensions();
  const std::string extension = extension_of(path);
  if (extension.empty())
    throw InputError(fmt::format("{} has no extension, which picks the format", shown_name(path.string())),
                     "add .png, .exr, .jpg or .tif");
  if (std::find(known.begin(), known.end(), extension) == known.end())
    throw InputError(fmt::format("{}: pictures of kind .{} are not written", shown_name(path.string()), extension),
                     suggestion(extension, known));
  check_can_write(path, try_it);
}

void check_can_write(const fs::path& path, bool try_it) {
  const auto refuse = [&](const std::string& why) {
    throw OperationError(fmt::format("{} cannot be written ({}); nothing was rendered", path.string(), why));
  };
  std::error_code error;
  if (fs::exists(path, error) && !fs::is_regular_file(path, error)) refuse("it is there and is no regular file");
  if (!try_it) return;
  if (path.has_parent_path()) fs::create_directories(path.parent_path(), error);
  if (error) refuse(fmt::format("its folder cannot be made: {}", error.message()));
  fs::path probe = path;
  probe.replace_filename(fmt::format(".{}.{}-probe", path.stem().string(), ::getpid()));
  const int descriptor = ::open(probe.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
  if (descriptor < 0) refuse(std::strerror(errno));
  ::close(descriptor);
  fs::remove(probe, error);
}

const std::vector<std::string>& layer_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const ImageLayer& layer : develop_layers(Film(1, 1, true)))
      if (!layer.name.empty()) all.push_back(layer.name);
    return all;
  }();
  return names;
}

WrittenPicture write_picture(const fs::path& path, const PictureContent& content, const ColorManager& colors) {
  WrittenPicture written;
  written.path = path;
  if (is_exr(path)) {
    std::vector<ImageLayer> layers;
    for (ImageLayer& layer : develop_layers(*content.film)) {
      const auto& wanted = content.layers;
      if (!layer.name.empty() && std::find(wanted.begin(), wanted.end(), layer.name) == wanted.end()) continue;
      if (layer.name.empty() && content.overlay) lay_over(layer.image, *content.overlay);
      layer.image = crop_image(layer.image, content.crop);
      layers.push_back(std::move(layer));
    }
    written.layers = int(layers.size());
    written.width = layers[0].image.width;
    written.height = layers[0].image.height;
    written.clamped = write_exr(path, layers, content.attributes, colors.working_chromaticities());
  } else {
    Image beauty = develop_beauty(*content.film);
    if (content.overlay) lay_over(beauty, *content.overlay);
    const Image image =
        crop_image(develop_display(beauty, colors, content.display, content.exposure_ev), content.crop);
    written.width = image.width;
    written.height = image.height;
    const bool srgb = content.display.display.find("sRGB") != std::string::npos;
    write_display_image(path, image, content.attributes, 8, srgb);
  }
  std::error_code error;
  const auto bytes = fs::file_size(path, error);
  written.bytes = error ? 0 : (long long)(bytes);
  return written;
}

std::vector<WrittenPicture> write_pictures(const std::vector<std::string>& paths, const PictureContent& content,
                                           const ColorManager& colors, int threads) {
  std::vector<WrittenPicture> written(paths.size());
  parallel_for(int(paths.size()), threads,
               [&](int i) { written[size_t(i)] = write_picture(paths[size_t(i)], content, colors); });
  return written;
}

}  // namespace sateen
