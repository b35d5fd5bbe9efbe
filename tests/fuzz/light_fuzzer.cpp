#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "base/error.h"
#include "image/color.h"
#include "scene/environment_file.h"

// Any bytes as an OpenEXR or Radiance map through the reader of lights, to a compiled environment: whole, shrunk, and
// by a layer asked for. InputError is the one way out. Other formats are the picture library's own affair.

namespace {
// What a file claims must not be what is allocated.
constexpr double most_gibibytes = 1.0 / 256;

/// The bytes under a path that readers can open; in memory.
struct MemoryFile {
  int descriptor = memfd_create("light", MFD_CLOEXEC);
  std::string path = "/proc/self/fd/" + std::to_string(descriptor);

  void write(const std::uint8_t* data, std::size_t size) const {
    if (ftruncate(descriptor, 0) != 0 || pwrite(descriptor, data, size, 0) != ssize_t(size)) std::abort();
  }
};

void read(const std::string& path, const sateen::ColorManager& colors,
          const sateen::EnvironmentFileOptions& options) {
  try {
    const sateen::Environment map = sateen::read_environment(path, colors, options);
    for (int y = 0; y < map.height; ++y)
      for (int x = 0; x < map.width; ++x)
        for (int c = 0; c < 3; ++c)
          if (!(map.radiance_at(x, y)[c] >= 0 && map.radiance_at(x, y)[c] < 2e35f)) std::abort();
  } catch (const sateen::InputError&) {
  }
}
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const sateen::ColorManager colors("built-in");
  static const MemoryFile file;
  const std::string start(reinterpret_cast<const char*>(data), size < 4 ? size : 4);
  if (start.rfind("#?", 0) != 0 && start != "\x76\x2f\x31\x01") return 0;
  file.write(data, size);
  sateen::EnvironmentFileOptions options;
  options.limits = sateen::image_limits_of(most_gibibytes);
  options.limits.side = 4096;
  read(file.path, colors, options);
  options.width = 8;
  options.layer = start[0] == '#' ? "" : "AO";
  read(file.path, colors, options);
  return 0;
}
