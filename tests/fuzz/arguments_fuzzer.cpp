// The words behind `sateen render`, one a line, up to where the first file would be opened. What is refused is
// refused by an error with a text; what is taken lies in its ranges.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "app/console.h"
#include "app/render.h"
#include "base/error.h"

namespace {
using namespace sateen;

/// Nothing reaches the terminal while one lives: help is printed where it is asked for.
struct Silence {
  static std::FILE* nowhere() {
    static std::FILE* const file = std::fopen("/dev/null", "w");
    if (!file) std::abort();
    return file;
  }
  std::FILE* const kept = stdout;
  Silence() { stdout = nowhere(); }
  ~Silence() { stdout = kept; }
};

bool taken(const std::vector<std::string>& words, app::RenderFlags& flags) {
  const Silence silence;
  try {
    return app::read_render_flags(words, flags);
  } catch (const InputError& error) {
    if (error.diagnostics.empty() || *error.what() == '\0') std::abort();
    return false;
  }
}

void require(bool good) {
  if (!good) std::abort();
}
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::string> words;
  std::istringstream lines(std::string(reinterpret_cast<const char*>(data), size));
  for (std::string line; words.size() < 64 && std::getline(lines, line);)
    words.emplace_back(line.substr(0, line.find('\0')));  // as a shell would hand it over
  app::RenderFlags flags;
  if (!taken(words, flags)) return 0;
  const app::PictureFlags& p = flags.picture;
  require(p.scene.width > 0 && p.scene.height > 0 && p.render.stop.spp >= 0 && p.render.stop.error >= 0 &&
          p.render.stop.seconds >= 0 && !p.outputs.empty());
  require(p.render.crop.x1 <= p.scene.width && p.render.crop.y1 <= p.scene.height);
  require(app::recorded_line("render", words).starts_with("render"));
  return 0;
}
