#include "scene/environment_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "base/error.h"
#include "base/files.h"
#include "base/nearest_name.h"
#include "base/parallel.h"

namespace sateen {

namespace fs = std::filesystem;

namespace {
constexpr const char* extensions[] = {".exr", ".hdr", ".tif", ".tiff", ".png", ".jpg"};

bool is_file(const fs::path& path) {
  std::error_code code;
  return fs::is_regular_file(path, code);
}

void add_folder(std::vector<fs::path>& folders, const fs::path& folder) {
  std::error_code code;
  if (fs::is_directory(folder, code)) folders.push_back(folder);
}

std::vector<fs::path> children(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code code;
  for (fs::directory_iterator it(folder, code), end; !code && it != end; it.increment(code))
    found.push_back(it->path());
  std::sort(found.begin(), found.end());
  return found;
}

// Newer Blenders lie in a folder of their version or keep datafiles at the top.
void add_blender(std::vector<fs::path>& folders, const fs::path& root) {
  add_folder(folders, root / "datafiles/studiolights/world");
  add_folder(folders, root / "studiolights/world");
  for (const fs::path& version : children(root)) add_folder(folders, version / "datafiles/studiolights/world");
}

// A channel order that reads as R, G, B whatever stands around it: "beauty.R" or a leading Z do not confuse it.
void bring_colours_first(Image& image, const std::vector<std::string>& names) {
  if (image.channels < 3 || int(names.size()) != image.channels) return;
  int places[3];
  const char* wanted[3] = {"R", "G", "B"};
  for (int c = 0; c < 3; ++c) {
    const auto found = std::find(names.begin(), names.end(), wanted[c]);
    if (found == names.end()) return;
    places[c] = int(found - names.begin());
  }
  if (places[0] == 0 && places[1] == 1 && places[2] == 2) return;
  for (size_t i = 0; i < size_t(image.width) * size_t(image.height); ++i) {
    float* p = image.pixels.data() + i * size_t(image.channels);
    const float rgb[3] = {p[places[0]], p[places[1]], p[places[2]]};
    std::copy_n(rgb, 3, p);
  }
}

Image as_colour(Image image) {
  if (image.channels == 3) return image;
  Image colour(image.width, image.height, 3);
  for (size_t i = 0; i < size_t(image.width) * size_t(image.height); ++i)
    for (size_t c = 0; c < 3; ++c)
      colour.pixels[3 * i + c] = image.pixels[i * size_t(image.channels) + (image.channels < 3 ? 0 : c)];
  return colour;
}

// Converts in place and says what was used and why.
std::string convert(Image& map, const fs::path& path, const ImageFileInfo& info, const ColorManager& colors,
                    const std::string& flag) {
  const auto by_name = [&](const std::string& space, const char* why) {
    colors.to_working(map, space);
    return fmt::format("{} ({})", space, why);
  };
  if (!flag.empty()) return by_name(flag, "as asked");
  if (info.chromaticities) {
    colors.chromaticities_to_working(map, *info.chromaticities);
    return "linear, primaries and white of the file's chromaticities";
  }
  const bool integer = info.pixel_type.rfind("uint", 0) == 0 || info.pixel_type.rfind("int", 0) == 0;
  if (info.color_space == "sRGB")
    return by_name("srgb_texture", integer ? "the file says sRGB" : "the file's metadata");
  if (!info.color_space.empty() && colors.has_space(info.color_space))
    return by_name(info.color_space, "the file's metadata");
  if (const auto rule = colors.space_of_file(path.string()))
    return by_name(*rule, "a file rule of the colour config");
  return integer ? by_name("srgb_texture", "usual for integer pixels")
                 : by_name("lin_rec709", "usual for float pixels");
}
}  // namespace

std::vector<fs::path> environment_folders() {
  std::vector<fs::path> folders{"."};
  if (const char* list = std::getenv("SATEEN_PATH")) {
    std::string rest = list;
    while (!rest.empty()) {
      const size_t colon = std::min(rest.find(':'), rest.size());
      const fs::path folder = rest.substr(0, colon);
      rest.erase(0, colon + 1);
      if (folder.empty()) continue;
      add_folder(folders, folder);
      add_folder(folders, folder / "envmaps");
    }
  }
  try {
    add_folder(folders, data_folder() / "envmaps");
  } catch (const InputError&) {
    // A program moved away from its data still reads maps by their path.
  }
  add_blender(folders, "/usr/share/blender");
  return folders;
}

std::vector<std::string> environment_names() {
  std::set<std::string> names;
  const auto folders = environment_folders();
  for (size_t i = 1; i < folders.size(); ++i)  // not ".": a picture lying about is no map
    for (const fs::path& file : children(folders[i]))
      if (std::find(std::begin(extensions), std::end(extensions), file.extension().string()) != std::end(extensions))
        names.insert(file.stem().string());
  return {names.begin(), names.end()};
}

fs::path find_environment(const std::string& name) {
  std::error_code code;
  if (!name.empty() && fs::exists(name, code) && !fs::is_directory(name, code)) return name;
  const auto folders = environment_folders();
  if (!name.empty() && !fs::path(name).is_absolute())
    for (const fs::path& folder : folders) {
      if (is_file(folder / name)) return folder / name;
      for (const char* extension : extensions)
        if (is_file(folder / (name + extension))) return folder / (name + extension);
    }
  if (!name.empty() && fs::is_directory(name, code))
    throw InputError(fmt::format("{}: is a folder, expected an HDR map", name), "name a file in it",
                     InputError::Kind::unreadable);
  std::string searched;
  for (const fs::path& folder : folders) searched += (searched.empty() ? "" : ", ") + folder.string();
  throw InputError(fmt::format("no environment map \"{}\" (searched: {})", name, searched),
                   suggestion(fs::path(name).stem().string(), environment_names()), InputError::Kind::unreadable);
}

Environment read_environment(const std::string& path_or_name, const ColorManager& colors,
                             const EnvironmentFileOptions& options, std::string* used_space) {
  // Lossy EXRs are decoded in floating point: whoever calls, denormals are flushed as everywhere.
  flush_denormals();
  const fs::path path = find_environment(path_or_name);
  ImageFileInfo info;
  Image map = read_image(path, options.limits, &info);
  bring_colours_first(map, info.channel_names);
  map = as_colour(std::move(map));
  // Before the conversion, which would spread one bad channel over all three.
  EnvironmentRepairs repairs = repair_radiance(map);
  const std::string space = convert(map, path, info, colors, options.color_space);
  if (used_space) *used_space = space;

  EnvironmentOptions build;
  build.rotation = radians(options.rotation_deg);
  build.exposure_ev = options.exposure_ev;
  build.name = path.stem().string();
  build.luminance = colors.luminance_weights();
  Environment environment = build_environment(std::move(map), build);
  repairs.out_of_gamut = environment.repairs.negative;
  if (!repairs.infinite.count) repairs.infinite = environment.repairs.infinite;
  environment.repairs = repairs;
  return environment;
}

}  // namespace sateen
