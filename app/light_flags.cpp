#include "light_flags.h"

#include <fmt/format.h>

#include "image/limits.h"

namespace sateen::app {

void add_layer_flag(Command& command, std::string& layer) {
  command.text("--env-layer", "NAME", layer,
               "layer or channel of an EXR map (default: R, G, B without a name, else Combined, rgba or beauty)");
}

void add_image_limit(Command& command) {
  command.custom(
      image_limit_flag, "GIB", 1, 1,
      [](const auto& words) {
        set_image_limits(image_limits_of(read_number(image_limit_flag, words.back(), 0.001, 1024)));
      },
      fmt::format("largest map or texture that is read, in GiB of floats (default: {})",
                  ImageLimits().decoded_bytes >> 30));
}

}  // namespace sateen::app
