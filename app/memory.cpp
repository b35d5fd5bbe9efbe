#include "memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/memory.h"
#include "base/parallel.h"
#include "console.h"
#include "film/develop.h"
#include "render/memory.h"

namespace sateen::app {

namespace {

bool writes_exr(const PictureFlags& f) {
  return f.outputs.empty() ||
         std::any_of(f.outputs.begin(), f.outputs.end(), [](const auto& o) { return is_exr(o); });
}

PictureSize size_of(const PictureFlags& f, bool with_layers) {
  PictureSize size;
  size.width = f.scene.width;
  size.height = f.scene.height;
  size.layers = with_layers;
  size.references = f.stage.references;
  size.outputs = f.outputs;
  size.threads = thread_count(f.render.threads);
  if (!writes_exr(f)) return size;
  const Film smallest(1, 1, with_layers);
  const auto wanted = [&](const std::string& name) {
    return std::find(f.layer_list.begin(), f.layer_list.end(), name) != f.layer_list.end();
  };
  for (const ImageLayer& layer : develop_layers(smallest, 0, 1, wanted)) size.exr_channels += layer.image.channels;
  return size;
}

/// What helps, by how much each takes.
std::string remedy(const PictureFlags& f, const PictureSize& size, std::int64_t bytes, std::int64_t room) {
  std::vector<std::string> ways;
  if (size.layers) {
    PictureSize less = size;
    less.layers = false;
    less.exr_channels = 4;
    ways.push_back(fmt::format("--aov none takes {} less", memory_text(bytes - picture_bytes(less))));
  }
  // Some of it does not shrink with the picture, and the next run finds a little more or less room.
  PictureSize fits = size;
  double low = 0, high = 1;
  for (int step = 0; step < 20; ++step) {
    const double share = (low + high) / 2;
    fits.width = std::int64_t(f.scene.width * share), fits.height = std::int64_t(f.scene.height * share);
    (double(picture_bytes(fits)) < 0.93 * double(room) ? low : high) = share;
  }
  if (low > 0.02)
    ways.push_back(fmt::format("--res {} {} fits", int(f.scene.width * low), int(f.scene.height * low)));
  return ways.empty() ? "a lower --level, a smaller map (--map-size) or more memory"
                      : fmt::format("{}", fmt::join(ways, "; "));
}

[[noreturn]] void refuse(const PictureFlags& f, const PictureSize& size, std::int64_t bytes, std::int64_t held,
                         const MemoryRoom& room, std::int64_t still_to_come = 0) {
  throw InputError(fmt::format("--res {} {} takes {} to render and to write{}, and {}, of which {} are left",
                               f.scene.width, f.scene.height, memory_text(bytes),
                               held > 0 ? fmt::format(" beside a scene of {}", memory_text(held)) : "", room.limit,
                               memory_text(std::max<std::int64_t>(room.bytes, 0))),
                   remedy(f, size, bytes, room.bytes - still_to_come));
}

}  // namespace

void check_film_memory(const PictureFlags& f) {
  const PictureSize size = size_of(f, writes_exr(f) && !f.layer_list.empty());
  const MemoryRoom room = memory_room();
  if (film_bytes(size) <= room.bytes) return;
  constexpr std::int64_t usual_scene = 400 << 20;  // with the address space of libraries and threads
  refuse(f, size, picture_bytes(size), 0, room, usual_scene);
}

void check_picture_memory(const PictureFlags& f, bool with_layers, bool film_there) {
  const PictureSize size = size_of(f, with_layers);
  // What will be needed at the end had better fail now, and counts; the display's colours were tried (display_fault).
  for (const std::string& output : f.outputs)
    if (!is_exr(output)) load_display_writer();
  const MemoryRoom room = memory_room();
  const std::int64_t bill = f.bill || !f.stats.empty() ? std::int64_t(2) << 20 : 0;  // small pictures
  const std::int64_t bytes = picture_bytes(size) + bill - (film_there ? film_bytes(size) : 0);
  const MemoryUse use = memory_use();
  print_detail(fmt::format("memory: {} now, {} at most so far, {} foreseen", memory_text(use.resident),
                           memory_text(use.peak), memory_text(std::max(use.resident + bytes, use.peak))));
  if (bytes > room.bytes) refuse(f, size, bytes, use.resident, room);
}

void check_merge_memory(const std::vector<std::string>& checkpoints) {
  std::int64_t largest = 0;
  for (const std::string& path : checkpoints) {
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(path, error);
    if (!error) largest = std::max(largest, std::int64_t(bytes));
  }
  const MemoryRoom room = memory_room();
  if (2 * largest > room.bytes)
    throw InputError(
        fmt::format("to join two checkpoints takes {}, and {}, of which {} are left", memory_text(2 * largest),
                    room.limit, memory_text(std::max<std::int64_t>(room.bytes, 0))),
        "merge them on a machine with more memory");
}

}  // namespace sateen::app
