#include "scene/environment_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "base/error.h"
#include "base/files.h"
#include "base/memory.h"
#include "base/nearest_name.h"
#include "base/parallel.h"
#include "image/chromaticities.h"
#include "image/light_file.h"
#include "image/space_names.h"
#include "scene/environment_build.h"
#include "scene/environment_repair.h"
#include "scene/environment_rows.h"

namespace sateen {

namespace fs = std::filesystem;

namespace {
// Rows are converted so many pixels at a time: what that takes is small beside any map, and calls are few.
constexpr int band_pixels = 1 << 20;

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

// XYZ says nothing of what it takes for white; D65 is what tools that write it mean, unless the file states another.
void xyz_to_working(Image& map, const LightFileInfo& info, const ColorManager& colors) {
  ColorManager::Chromaticities rgb = rec709_chromaticities;
  if (info.chromaticities) std::copy_n(info.chromaticities->white, 2, rgb.white);
  const Matrix3 m = inverse(rgb_to_xyz(rgb));
  for (size_t i = 0; i < map.pixels.size(); i += 3) {
    const double xyz[3] = {double(map.pixels[i]), double(map.pixels[i + 1]), double(map.pixels[i + 2])};
    for (size_t c = 0; c < 3; ++c) map.pixels[i + c] = float(m[c][0] * xyz[0] + m[c][1] * xyz[1] + m[c][2] * xyz[2]);
  }
  colors.chromaticities_to_working(map, rgb);
}

// The file's word for its colours, where it has one that counts and nobody knows it.
std::string unknown_space(const LightFileInfo& info, const ColorManager& colors, const std::string& flag) {
  const std::string& name = info.color_space;
  if (!flag.empty() || info.xyz || info.chromaticities || name.empty() || says_nothing(name)) return {};
  if (name == "sRGB" || colors.has_space(name) || !own_space_called(name).empty()) return {};
  return fmt::format("the file says that its colour space is {:.60}, which is not known", name);
}

// Converts in place and says what was used and why.
std::string convert(Image& map, const fs::path& path, const LightFileInfo& info, const ColorManager& colors,
                    const std::string& flag) {
  const auto by_name = [&](const std::string& space, const char* why) {
    colors.to_working(map, space);
    return fmt::format("{} ({})", space, why);
  };
  if (!flag.empty()) return by_name(flag, "as asked");
  try {
    if (info.xyz) {
      xyz_to_working(map, info, colors);
      return info.chromaticities ? "CIE XYZ, white of the file's chromaticities" : "CIE XYZ, D65 as white";
    }
    if (info.chromaticities) {
      colors.chromaticities_to_working(map, *info.chromaticities);
      return "linear, primaries and white of the file's chromaticities";
    }
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", path.string(), error.diagnostics.at(0).message),
                     "--env-space NAME says what its colours are");
  }
  const bool integer = info.pixel_type.rfind("uint", 0) == 0 || info.pixel_type.rfind("int", 0) == 0;
  if (info.color_space == "sRGB")
    return by_name("srgb_texture", integer ? "the file says sRGB" : "the file's metadata");
  if (!info.color_space.empty() && colors.has_space(info.color_space))
    return by_name(info.color_space, "the file's metadata");
  if (const std::string own = own_space_called(info.color_space); !own.empty())
    return by_name(own, fmt::format("the file says {:.60}", info.color_space).c_str());
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

namespace {
void check_memory(const fs::path& path, int width, int height) {
  const double bytes = double(width) * height * double(sizeof(Color));
  const MemoryRoom room = memory_room();
  if (bytes > double(room.bytes))
    refuse_picture(path,
                   fmt::format("its picture of {} x {} pixels takes more than {}, and {}", width, height,
                               memory_text(std::int64_t(bytes)), room.limit),
                   "--map-size N makes it smaller while it is read");
}

Environment read_found(const fs::path& path, const ColorManager& colors, const EnvironmentFileOptions& options,
                       std::string* used_space) {
  const std::unique_ptr<LightFile> file = open_light_file(path, options.layer, options.limits);
  const LightFileInfo& info = file->info;
  int width = info.width, height = info.height;
  if (options.width > 0 && options.width < width) {
    height = std::clamp(int(std::lround(double(height) * options.width / width)), 1, height);
    width = options.width;
  }
  check_image_size(path, "picture", width, height, 3, options.limits, " (--map-size N does while it is read)");
  check_memory(path, width, height);

  EnvironmentOptions build;
  build.rotation = radians(options.rotation_deg);
  build.name = path.stem().string();
  build.luminance = colors.luminance_weights();
  Environment environment = begin_environment(width, height, build);
  environment.notes = info.notes;
  environment.doubts = info.doubts;
  RadianceMender mender(info.height);
  EnvironmentRows rows(info.width, info.height, environment);
  EnvironmentRepairs::Kind held;
  const float gain = std::exp2(options.exposure_ev);
  Image black(1, 1, 3);
  std::string space = convert(black, path, info, colors, options.color_space);
  EnvironmentRepairs::Kind none;
  const bool stays_black = scaled_radiance(black.at(0, 0), gain, 0, 0, none) == Color(0);
  const int band_rows = std::max(1, band_pixels / info.width);
  std::vector<Color> row(size_t(info.width), Color(0));
  do {
    held = {};
    for (int y = 0; y < info.height; y += band_rows) {
      const int count = std::min(band_rows, info.height - y);
      if (stays_black && (y + count <= info.first_row || y >= info.end_row)) {
        for (int k = 0; k < count; ++k) rows.add_black(y + k);
        continue;
      }
      Image band(info.width, count, 3);
      file->read_rows(y, band.height, band.pixels.data());
      mender.mend_in_file_space(band, y);
      space = convert(band, path, info, colors, options.color_space);
      mender.mend_in_working_space(band, y);
      for (int k = 0; k < band.height; ++k) {
        for (int x = 0; x < info.width; ++x) row[size_t(x)] = scaled_radiance(band.at(x, k), gain, x, y + k, held);
        rows.add(y + k, row);
      }
    }
    // What is infinite becomes the largest value, and that is known only now: such a map is read twice.
  } while (mender.again());
  if (used_space) *used_space = space;
  finish_environment(environment);
  environment.repairs = mender.repairs();
  // What was infinite is as bright as what is held, and told already.
  if (!environment.repairs.infinite.count) tell_held(environment, held);
  if (const std::string doubt = unknown_space(info, colors, options.color_space); !doubt.empty())
    environment.doubts.push_back(fmt::format("{}; taken as {}; --env-space NAME says what it is", doubt, space));
  return environment;
}
}  // namespace

Environment read_environment(const std::string& path_or_name, const ColorManager& colors,
                             const EnvironmentFileOptions& options, std::string* used_space) {
  // Lossy EXRs are decoded in floating point: whoever calls, denormals are flushed as everywhere.
  flush_denormals();
  const fs::path path = find_environment(path_or_name);
  return name_where_memory_ends(path, [&] { return read_found(path, colors, options, used_space); });
}

}  // namespace sateen
