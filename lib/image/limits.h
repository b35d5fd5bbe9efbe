#pragma once
#include <filesystem>
#include <string>

namespace sateen {

/// How large a picture may be that is read. Checked in 64 bit and before anything is allocated.
struct ImageLimits {
  int side = 32768;                     ///< pixels
  long long decoded_bytes = 2ll << 30;  ///< as float: a map of 16384 x 8192 takes 1.5 GiB
};

/// What is read a band of rows at a time: what becomes of them is the caller's to limit.
inline constexpr ImageLimits read_in_bands{1000000, 1ll << 62};

/// The flag of the program that raises the limits, as messages name it.
inline constexpr const char* image_limit_flag = "--image-limit";

/// The limits that hold where a reader is given none, for textures and maps alike; to be said before files are read.
void set_image_limits(const ImageLimits& limits);
const ImageLimits& image_limits();

/// Limits that let a picture of so many GiB pass, of any side that a map can have.
ImageLimits image_limits_of(double gibibytes);

/// InputError (unreadable) for a picture beyond the limits. `what`: "data window", "picture"; `channels`: that are
/// held at once; `otherwise`: what helps besides a higher limit, an end of "make it smaller, ...".
void check_image_size(const std::filesystem::path& path, const std::string& what, long long width, long long height,
                      int channels, const ImageLimits& limits, const std::string& otherwise = {});

}  // namespace sateen
