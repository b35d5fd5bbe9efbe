#include "render/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/files.h"
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

std::string display_fault(const DisplaySettings& settled, const ColorManager& colors) {
  Image greys(11, 1, 3);
  for (int x = 0; x < greys.width; ++x) std::fill_n(greys.at(x, 0), 3, std::exp2(float(x - 10)));
  colors.to_display(greys, settled.display, settled.view, 0);
  constexpr const char* names[] = {"red", "green", "blue"};
  std::string same;
  for (int c = 0; c < 3; ++c) {
    const float first = greys.at(0, 0)[c];
    bool constant = true;
    for (int x = 1; x < greys.width; ++x) constant = constant && greys.at(x, 0)[c] == first;
    if (constant) same += fmt::format("{}{} {:.3g}", same.empty() ? "" : ", ", names[c], first);
  }
  if (same.empty()) return {};
  return fmt::format(
      "the view {} of the display {} gives every grey from dark to white the same code ({}): its "
      "transform is faulty, or is not meant for pictures; an EXR does not go through it",
      settled.view, settled.display, same);
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
  return develop_display(beauty, colors, settings, exposure_ev, 0, beauty.height);
}

Image develop_display(const Image& beauty, const ColorManager& colors, const DisplaySettings& settings,
                      float exposure_ev, int y0, int height) {
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
      const float paper = paper_code((float(x) + 0.5f) / float(out.width), (float(y0 + y) + 0.5f) / float(height));
      for (int c = 0; c < 3; ++c) {
        const float ground = settings.ground ? (*settings.ground)[c] : paper;
        to[c] = alpha >= 1   ? from[c]
                : alpha <= 0 ? ground
                             : code(light(from[c]) * alpha + light(ground) * (1 - alpha));
      }
    }
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
  try {
    try_to_write(path);
  } catch (const OperationError& cause) {
    refuse(cause.what());
  }
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

namespace {

/// The window of a film that a file shows, and bands of its rows as they are developed.
struct Window {
  const PictureContent& content;
  const ColorManager& colors;
  Crop window = clipped(content.crop, content.film->width, content.film->height);

  int width() const { return window.x1 - window.x0; }
  int height() const { return window.y1 - window.y0; }

  // `rows` as wide as the film, from row `y` of it on.
  void lay_over(Image& rows, int y) const {
    if (!content.overlay) return;
    const float* over = content.overlay->at(0, y);
    for (size_t i = 0; i < rows.pixels.size(); i += 4) {
      const float left = 1 - over[i + 3];
      for (size_t c = 0; c < 4; ++c) rows.pixels[i + c] = rows.pixels[i + c] * left + over[i + c];
    }
  }

  Image columns(Image rows) const {
    if (width() == rows.width) return rows;
    Image out(width(), rows.height, rows.channels);
    for (int y = 0; y < rows.height; ++y)
      std::copy_n(rows.at(window.x0, y), size_t(width()) * size_t(rows.channels), out.at(0, y));
    return out;
  }

  std::vector<ImageLayer> layers(int y0, int y1) const {
    const auto wanted = [&](const std::string& name) {
      return std::find(content.layers.begin(), content.layers.end(), name) != content.layers.end();
    };
    std::vector<ImageLayer> all = develop_layers(*content.film, window.y0 + y0, window.y0 + y1, wanted);
    lay_over(all[0].image, window.y0 + y0);
    for (ImageLayer& layer : all) layer.image = columns(std::move(layer.image));
    return all;
  }

  Image display(int y0, int y1) const {
    Image beauty = develop_beauty(*content.film, window.y0 + y0, window.y0 + y1);
    lay_over(beauty, window.y0 + y0);
    return columns(
        develop_display(beauty, colors, content.display, content.exposure_ev, window.y0 + y0, content.film->height));
  }
};

}  // namespace

WrittenPicture write_picture(const fs::path& path, const PictureContent& content, const ColorManager& colors) {
  const Window window{content, colors};
  WrittenPicture written;
  written.path = path;
  written.width = window.width();
  written.height = window.height();
  if (is_exr(path)) {
    written.layers = int(window.layers(0, 0).size());
    written.range = write_exr(
        path, written.width, written.height, [&](int y0, int y1) { return window.layers(y0, y1); },
        content.attributes, colors.working_chromaticities());
  } else {
    const bool srgb = content.display.display.find("sRGB") != std::string::npos;
    write_display_image(
        path, written.width, written.height, content.display.transparent ? 4 : 3,
        [&](int y0, int y1) { return window.display(y0, y1); }, content.attributes, 8, srgb);
  }
  std::error_code error;
  const auto bytes = fs::file_size(path, error);
  written.bytes = error ? 0 : (long long)(bytes);
  return written;
}

WrittenPictures write_pictures(const std::vector<std::string>& paths, const PictureContent& content,
                               const ColorManager& colors, int threads) {
  std::vector<WrittenPicture> written(paths.size());
  std::vector<std::string> failures(paths.size());
  parallel_for(int(paths.size()), threads, [&](int i) {
    const std::string& path = paths[size_t(i)];
    try {
      written[size_t(i)] = write_picture(path, content, colors);
    } catch (const std::bad_alloc&) {
      failures[size_t(i)] = path + ": not written: not enough memory";
    } catch (const std::exception& error) {
      failures[size_t(i)] = error.what();
    }
  });
  WrittenPictures all;
  for (size_t i = 0; i < paths.size(); ++i)
    if (failures[i].empty())
      all.written.push_back(std::move(written[i]));
    else
      all.failures.push_back(std::move(failures[i]));
  return all;
}

}  // namespace sateen
