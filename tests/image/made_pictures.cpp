#include "image/made_pictures.h"

#include <algorithm>

#include "image/made_files.h"

namespace sateen_test {

namespace {

std::string big(std::uint32_t value, int bytes) {
  std::string text;
  for (int i = bytes - 1; i >= 0; --i) text += char(value >> (8 * i) & 255);
  return text;
}

std::string little(std::uint32_t value, int bytes) {
  std::string text = big(value, bytes);
  std::reverse(text.begin(), text.end());
  return text;
}

std::uint32_t crc(const std::string& bytes) {
  std::uint32_t c = ~0u;
  for (const char byte : bytes) {
    c ^= std::uint8_t(byte);
    for (int i = 0; i < 8; ++i) c = c >> 1 ^ (c & 1 ? 0xedb88320u : 0);
  }
  return ~c;
}

std::string chunk(const std::string& kind, const std::string& data) {
  return big(std::uint32_t(data.size()), 4) + kind + data + big(crc(kind + data), 4);
}

// zlib's frame around blocks that are not packed.
std::string stored(const std::string& data) {
  std::string out = "\x78\x01";
  for (size_t at = 0; at < data.size(); at += 65535) {
    const size_t size = std::min<size_t>(65535, data.size() - at);
    out += char(at + size == data.size());
    out += little(std::uint32_t(size), 2) + little(std::uint32_t(~size & 65535), 2) + data.substr(at, size);
  }
  std::uint32_t a = 1, b = 0;
  for (const char byte : data) {
    a = (a + std::uint8_t(byte)) % 65521;
    b = (b + a) % 65521;
  }
  return out + big(b << 16 | a, 4);
}

std::string png(int width, int height, int bits, int kind, const std::string& between, const std::string& rows) {
  return "\x89PNG\r\n\x1a\n" +
         chunk("IHDR", big(std::uint32_t(width), 4) + big(std::uint32_t(height), 4) + char(bits) + char(kind) +
                           std::string(3, '\0')) +
         between + chunk("IDAT", stored(rows)) + chunk("IEND", "");
}

}  // namespace

void write_png(const std::filesystem::path& path, const Samples& samples, int bits,
               const std::vector<std::uint16_t>& transparent_code) {
  constexpr int kinds[] = {0, 4, 2, 6};
  std::string rows, code;
  const size_t row = size_t(samples.width) * size_t(samples.channels);
  for (size_t i = 0; i < samples.values.size(); ++i) {
    if (i % row == 0) rows += '\0';
    rows += big(samples.values[i], bits / 8);
  }
  for (const std::uint16_t value : transparent_code) code += big(value, 2);
  write_bytes(path, png(samples.width, samples.height, bits, kinds[samples.channels - 1],
                        code.empty() ? "" : chunk("tRNS", code), rows));
}

void write_palette_png(const std::filesystem::path& path, int width, int height,
                       const std::vector<std::uint8_t>& indices,
                       const std::vector<std::array<std::uint8_t, 4>>& palette) {
  std::string rows, colours, alphas;
  for (size_t i = 0; i < indices.size(); ++i) {
    if (i % size_t(width) == 0) rows += '\0';
    rows += char(indices[i]);
  }
  for (const auto& entry : palette) {
    for (size_t c = 0; c < 3; ++c) colours += char(entry[c]);
    alphas += char(entry[3]);
  }
  write_bytes(path, png(width, height, 8, 3, chunk("PLTE", colours) + chunk("tRNS", alphas), rows));
}

void write_tiff(const std::filesystem::path& path, const Samples& samples, TiffAlpha alpha, int orientation) {
  const auto channels = std::uint32_t(samples.channels);
  const bool colour = channels >= 3;
  std::string pixels;
  for (const std::uint16_t value : samples.values) pixels += char(value);
  std::vector<std::string> entries;
  const auto entry = [&](int tag, int type, std::uint32_t count, std::uint32_t value) {
    entries.push_back(little(std::uint32_t(tag), 2) + little(std::uint32_t(type), 2) + little(count, 4) +
                      little(value, 4));
  };
  constexpr int short_type = 3, long_type = 4;
  constexpr std::uint32_t pixels_at = 16;
  // Bits of each sample: 8, written after the pixels where they do not fit into the entry.
  const std::uint32_t bits_at = pixels_at + std::uint32_t(pixels.size());
  entry(256, long_type, 1, std::uint32_t(samples.width));
  entry(257, long_type, 1, std::uint32_t(samples.height));
  if (channels <= 2)
    entry(258, short_type, channels, channels == 2 ? 8u << 16 | 8u : 8u);
  else
    entry(258, short_type, channels, bits_at);
  entry(259, short_type, 1, 1);
  entry(262, short_type, 1, colour ? 2 : 1);
  entry(273, long_type, 1, pixels_at);
  if (orientation) entry(274, short_type, 1, std::uint32_t(orientation));
  entry(277, short_type, 1, channels);
  entry(278, long_type, 1, std::uint32_t(samples.height));
  entry(279, long_type, 1, std::uint32_t(pixels.size()));
  if (alpha != TiffAlpha::none) entry(338, short_type, 1, alpha == TiffAlpha::associated ? 1 : 2);
  std::string bits;
  for (std::uint32_t c = 0; c < channels; ++c) bits += little(8, 2);
  std::string body = pixels + bits;
  if (body.size() % 2) body += '\0';
  std::string directory = little(std::uint32_t(entries.size()), 2);
  for (const std::string& one : entries) directory += one;
  write_bytes(path, "II" + little(42, 2) + little(pixels_at + std::uint32_t(body.size()), 4) + std::string(8, '\0') +
                        body + directory + little(0, 4));
}

void set_jpeg_orientation(const std::filesystem::path& path, int orientation) {
  const std::string file = read_bytes(path);
  const std::string tiff = "II" + little(42, 2) + little(8, 4) + little(1, 2) + little(274, 2) + little(3, 2) +
                           little(1, 4) + little(std::uint32_t(orientation), 4) + little(0, 4);
  const std::string exif = std::string("Exif\0\0", 6) + tiff;
  write_bytes(path, file.substr(0, 2) + "\xff\xe1" + big(std::uint32_t(exif.size() + 2), 2) + exif + file.substr(2));
}

}  // namespace sateen_test
