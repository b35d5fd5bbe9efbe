#include "image/radiance.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>

namespace sateen {

namespace fs = std::filesystem;

namespace {
using Pixel = std::array<std::uint8_t, 4>;  // three mantissas and their exponent

// The new encoding states a length of 15 bits and is not used for shorter lines.
constexpr int shortest_encoded = 8, longest_encoded = 0x7fff;

/// The scanlines one after the other.
class Scanlines {
 public:
  Scanlines(const fs::path& path, const RadianceHeader& header)
      : path_(path), header_(header), in_(path, std::ios::binary), buffer_(1 << 18) {
    rewind();
  }

  int next() const { return next_; }

  void rewind() {
    in_.clear();
    in_.seekg(header_.pixels_at);
    filled_ = at_ = 0;
    next_ = 0;
  }

  void read(Pixel* line) {
    Pixel first = pixel();
    const int length = header_.length;
    const bool encoded =
        length >= shortest_encoded && length <= longest_encoded && first[0] == 2 && first[1] == 2 && first[2] < 128;
    if (!encoded)
      read_old(first, line);
    else if ((first[2] << 8 | first[3]) == length)
      for (size_t c = 0; c < 4; ++c) read_component(c, line);
    else
      damaged(fmt::format("is said to have {} pixels instead of {}", first[2] << 8 | first[3], length));
    ++next_;
  }

 private:
  [[noreturn]] void damaged(const std::string& what) const {
    refuse_picture(path_,
                   fmt::format("its pixels cannot be read: the file is damaged or cut short (scanline {} of {} "
                               "{})",
                               next_ + 1, header_.scanlines, what));
  }

  std::uint8_t byte() {
    if (at_ == filled_) {
      in_.read(buffer_.data(), std::streamsize(buffer_.size()));
      filled_ = size_t(in_.gcount());
      at_ = 0;
      if (filled_ == 0) damaged("ends early");
    }
    return std::uint8_t(buffer_[at_++]);
  }

  Pixel pixel() {
    Pixel p;
    for (std::uint8_t& b : p) b = byte();
    return p;
  }

  // Flat pixels, among which 1 1 1 n repeats the one before n times, and the next such one n * 256 times.
  void read_old(Pixel p, Pixel* line) {
    const int length = header_.length;
    int x = 0, shift = 0;
    while (true) {
      if (p[0] == 1 && p[1] == 1 && p[2] == 1) {
        const long long run = shift < 32 ? (long long)(p[3]) << shift : 0;
        if (x == 0) damaged("begins with a repetition");
        if (run > length - x) damaged("has a run that is longer than the line");
        std::fill_n(line + x, run, line[x - 1]);
        x += int(run);
        shift += 8;
      } else {
        line[x++] = p;
        shift = 0;
      }
      if (x >= length) return;
      p = pixel();
    }
  }

  // Above 128: that many less 128 of one value; else so many values.
  void read_component(size_t c, Pixel* line) {
    for (int x = 0; x < header_.length;) {
      const int code = byte(), count = code > 128 ? code - 128 : code;
      if (count == 0 || count > header_.length - x) damaged("has a run that does not fit");
      const std::uint8_t value = code > 128 ? byte() : 0;
      for (int i = 0; i < count; ++i) line[x++][c] = code > 128 ? value : byte();
    }
  }

  fs::path path_;
  RadianceHeader header_;
  std::ifstream in_;
  std::vector<char> buffer_;
  size_t filled_ = 0, at_ = 0;
  int next_ = 0;
};

class RadianceFile : public LightFile {
 public:
  RadianceFile(const fs::path& path, const RadianceHeader& header, const ImageLimits& limits)
      : header_(header), lines_(path, header), line_(size_t(header.length)) {
    info.width = header.columns ? header.scanlines : header.length;
    info.height = header.columns ? header.length : header.scanlines;
    info.format = "hdr";
    info.pixel_type = "float";
    info.chromaticities = header.primaries;
    info.xyz = header.xyz;
    describe();
    for (size_t e = 1; e < scale_.size(); ++e) scale_[e] = std::ldexp(1.0f, int(e) - 136);
    if (!(header.columns || header.right_to_left || header.bottom_up)) return;
    info.whole = true;
    check_image_size(path, "picture", info.width, info.height, 3, limits);
    turned_.resize(size_t(info.width) * size_t(info.height));
    for (int i = 0; i < header.scanlines; ++i) {
      lines_.read(line_.data());
      for (int k = 0; k < header.length; ++k) turned_[place(i, k)] = line_[size_t(k)];
    }
  }

  void read_rows(int y, int count, float* rgb) override {
    if (turned_.empty() && y < lines_.next()) lines_.rewind();
    for (int row = turned_.empty() ? lines_.next() : y; row < y + count; ++row) {
      if (turned_.empty()) lines_.read(line_.data());
      if (row < y) continue;
      const Pixel* from = turned_.empty() ? line_.data() : &turned_[size_t(row) * size_t(info.width)];
      for (int x = 0; x < info.width; ++x, rgb += 3) decode(from[x], rgb);
    }
  }

 private:
  size_t place(int scanline, int k) const {
    const int across = header_.columns ? scanline : k, down = header_.columns ? k : scanline;
    const int x = header_.right_to_left ? info.width - 1 - across : across;
    const int y = header_.bottom_up ? info.height - 1 - down : down;
    return size_t(y) * size_t(info.width) + size_t(x);
  }

  void decode(const Pixel& p, float* rgb) const {
    for (size_t c = 0; c < 3; ++c) {
      rgb[c] = float(p[c]) * scale_[p[3]];
      if (header_.gamma != 1) rgb[c] = float(std::pow(double(rgb[c]), header_.gamma));
      if (header_.exposure[c] != 1) rgb[c] = float(double(rgb[c]) / header_.exposure[c]);
    }
  }

  void describe() {
    if (header_.columns || header_.right_to_left || header_.bottom_up)
      info.notes.push_back(
          fmt::format("turned as its resolution string says: {}{}{}", header_.columns ? "by columns" : "by rows",
                      header_.bottom_up ? ", bottom up" : "", header_.right_to_left ? ", right to left" : ""));
    const double* e = header_.exposure;
    if (e[0] != 1 || e[1] != 1 || e[2] != 1)
      info.notes.push_back(
          e[0] == e[1] && e[1] == e[2]
              ? fmt::format("divided by {:.6g}, the exposure that its header says is in the pixels", e[0])
              : fmt::format("red, green and blue divided by {:.6g}, {:.6g}, {:.6g}, the exposure and "
                            "colour correction that its header says are in the pixels",
                            e[0], e[1], e[2]));
    if (header_.gamma != 1) info.notes.push_back(fmt::format("gamma {:.4g} of its header undone", header_.gamma));
  }

  RadianceHeader header_;
  Scanlines lines_;
  std::vector<Pixel> line_, turned_;
  std::array<float, 256> scale_{};  // of each exponent; 0 stands for black
};
}  // namespace

std::unique_ptr<LightFile> open_radiance(const fs::path& path, const ImageLimits& limits) {
  const RadianceHeader header = read_radiance_header(path);
  // What a line needs is allocated by the claim: it is held against the limits first.
  const int width = header.columns ? header.scanlines : header.length;
  const int height = header.columns ? header.length : header.scanlines;
  check_image_size(path, "data window", width, height, 3, read_in_bands);
  return std::make_unique<RadianceFile>(path, header, limits);
}

}  // namespace sateen
