#include "image/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace sateen {

namespace {
ImageLimits limits_in_force;

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& message, const std::string& help) {
  Diagnostic d;
  d.file = path.string();
  d.message = message;
  d.help = help;
  throw InputError(InputError::Kind::unreadable, {d});
}

std::string shown(double gibibytes) {
  return gibibytes < 0.1 ? fmt::format("{:.2g}", gibibytes) : fmt::format("{:.1f}", gibibytes);
}
}  // namespace

void set_image_limits(const ImageLimits& limits) {
  limits_in_force = limits;
}
const ImageLimits& image_limits() {
  return limits_in_force;
}

ImageLimits image_limits_of(double gibibytes) {
  // Look-ups count a map's columns up to a million.
  return {1000000, (long long)(std::min(gibibytes, 1e6) * 0x1p30)};
}

void check_image_size(const std::filesystem::path& path, const std::string& what, long long width, long long height,
                      int channels, const ImageLimits& limits, const std::string& otherwise) {
  if (width < 1 || height < 1)
    refuse(path, fmt::format("its {} is {} x {} pixels, expected at least 1 x 1", what, width, height), {});
  // Sides below 2^32 each and a channel count below 2^31 could pass 64 bits: a quotient cannot.
  const long long pixel = 4ll * std::max(channels, 1);
  const double gibibytes = double(width) * double(height) * double(pixel) / 0x1p30;
  const auto help = [&] {
    return fmt::format("make it smaller{}, or raise the limit: {} {:.0f} (GiB)", otherwise, image_limit_flag,
                       std::ceil(std::max(gibibytes, double(limits_in_force.decoded_bytes) / 0x1p30)));
  };
  if (width > limits.side || height > limits.side)
    refuse(path,
           fmt::format("its {} is {} x {} pixels, expected at most {} a side", what, width, height, limits.side),
           limits.side < 1000000 ? help() : "make it smaller");
  if (width > limits.decoded_bytes / pixel / height)
    refuse(path,
           fmt::format("its {} of {} x {} pixels with {} channels takes {} GiB decoded, expected at most {}", what,
                       width, height, channels, shown(gibibytes), shown(double(limits.decoded_bytes) / 0x1p30)),
           help());
}

}  // namespace sateen
