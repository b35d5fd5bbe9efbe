#include "image/exr_header.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <string>

#include "base/printable.h"
#include "image/light_file.h"

namespace sateen {

namespace {

constexpr std::array<unsigned char, 4> magic{0x76, 0x2f, 0x31, 0x01};
constexpr std::uint32_t multi_part = 1u << 12;
constexpr size_t longest_name = 255;

struct Reader {
  std::ifstream file;
  std::uint64_t left;

  bool number(std::uint32_t& value) {
    std::array<unsigned char, 4> b{};
    if (left < 4 || !file.read(reinterpret_cast<char*>(b.data()), 4)) return false;
    left -= 4;
    value = std::uint32_t(b[0]) | std::uint32_t(b[1]) << 8 | std::uint32_t(b[2]) << 16 | std::uint32_t(b[3]) << 24;
    return true;
  }
  /// Up to its closing 0.
  bool name(std::string& text) {
    text.clear();
    for (char c = 0; left > 0 && text.size() <= longest_name && file.get(c); text += c) {
      --left;
      if (c == 0) return true;
    }
    return false;
  }
};

}  // namespace

void check_exr_header(const std::filesystem::path& path) {
  std::error_code none;
  const std::uintmax_t size = std::filesystem::file_size(path, none);
  if (none) return;
  Reader in{std::ifstream(path, std::ios::binary), std::uint64_t(size)};
  std::uint32_t found = 0, version = 0, bytes = 0;
  const std::uint32_t wanted = magic[0] | magic[1] << 8 | magic[2] << 16 | std::uint32_t(magic[3]) << 24;
  const auto refuse_short = [&] {
    refuse_picture(path, "ends within its header", "the file is damaged or cut short: write it again");
  };
  if (!in.number(found) || found != wanted) return;
  if (!in.number(version)) refuse_short();
  std::string name, type;
  for (bool begins = true;;) {
    if (!in.name(name)) return in.left == 0 ? refuse_short() : void();
    if (name.empty()) {  // the end of a header; of several parts an empty one ends them all
      if (begins || !(version & multi_part)) return;
      begins = true;
      continue;
    }
    begins = false;
    if (!in.name(type) || !in.number(bytes)) return in.left < 4 ? refuse_short() : void();
    if (bytes > in.left)
      refuse_picture(path,
                     fmt::format("its attribute {} claims {} bytes, and {} are left of the file", printable(name),
                                 bytes, in.left),
                     "the file is damaged or cut short: write it again");
    in.file.seekg(std::streamoff(bytes), std::ios::cur);
    in.left -= bytes;
  }
}

}  // namespace sateen
