#include "image/png_chunks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "image/light_file.h"

namespace sateen {

namespace {
constexpr char signature[] = "\x89PNG\r\n\x1a\n";
constexpr const char* damaged = "the file is damaged or cut short: write it again";

/// CRC-32 of ISO 3309, as PNG takes it over a chunk's name and bytes.
class CheckSum {
 public:
  void add(const char* bytes, size_t count) {
    static const std::array<std::uint32_t, 256> table = [] {
      std::array<std::uint32_t, 256> made{};
      for (std::uint32_t n = 0; n < 256; ++n) {
        made[n] = n;
        for (int bit = 0; bit < 8; ++bit) made[n] = made[n] & 1 ? 0xedb88320u ^ made[n] >> 1 : made[n] >> 1;
      }
      return made;
    }();
    for (size_t i = 0; i < count; ++i)
      state_ = table[(state_ ^ static_cast<unsigned char>(bytes[i])) & 255] ^ state_ >> 8;
  }
  std::uint32_t value() const { return ~state_; }

 private:
  std::uint32_t state_ = ~0u;
};

std::uint32_t number_at(const char* bytes) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}
}  // namespace

void check_png_chunks(const std::filesystem::path& path) {
  if (first_bytes(path, 8) != std::string(signature, 8)) return;
  std::ifstream in(path, std::ios::binary);
  in.seekg(8);
  std::vector<char> bytes(1 << 16);
  for (std::array<char, 8> head{};;) {
    if (!in.read(head.data(), 8)) refuse_picture(path, "ends before its last chunk, IEND", damaged);
    const std::string name(head.data() + 4, 4);
    const bool is_name = std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalpha(c); });
    if (!is_name) refuse_picture(path, "has something between its chunks that is none", damaged);
    CheckSum sum;
    sum.add(name.data(), 4);
    for (std::uint64_t left = number_at(head.data()); left > 0;) {
      const auto step = std::streamsize(std::min<std::uint64_t>(left, bytes.size()));
      if (!in.read(bytes.data(), step)) refuse_picture(path, fmt::format("ends within its chunk {}", name), damaged);
      sum.add(bytes.data(), size_t(step));
      left -= std::uint64_t(step);
    }
    if (!in.read(head.data(), 4)) refuse_picture(path, fmt::format("ends within its chunk {}", name), damaged);
    // A small first letter says that the picture is whole without the chunk.
    if (std::isupper(static_cast<unsigned char>(name[0])) && number_at(head.data()) != sum.value())
      refuse_picture(path, fmt::format("the check sum of its chunk {} is wrong", name), damaged);
    if (name == "IEND") return;
  }
}

}  // namespace sateen
