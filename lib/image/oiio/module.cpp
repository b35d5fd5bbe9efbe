#include "image/oiio/functions.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <optional>

#include "base/error.h"
#include "base/files.h"
#include "image/attributes.h"
#include "image/bands.h"
#include "image/dither.h"
#include "image/oiio/checked_proxy.h"

namespace sateen {

namespace fs = std::filesystem;

namespace {
using Input = std::unique_ptr<OIIO::ImageInput>;

[[noreturn]] void refuse(const fs::path& path, const std::string& message, const std::string& help = {},
                         InputError::Kind kind = InputError::Kind::unreadable) {
  Diagnostic d;
  d.file = path.string();
  d.message = message;
  d.help = help;
  throw InputError(kind, {d});
}

// The library's own words, on one line, after ours.
std::string because(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  for (char& c : text)
    if (c == '\n') c = ' ';
  return text.empty() ? text : fmt::format(" ({})", text);
}

Input open(const fs::path& path) {
  // Else the library multiplies colours by alpha while they are still encoded.
  OIIO::ImageSpec as_stored;
  as_stored.attribute("oiio:UnassociatedAlpha", 1);
  Input input = OIIO::ImageInput::open(path.string(), &as_stored);
  if (!input) refuse(path, "is not a picture that can be read" + because(OIIO::geterror()));
  return input;
}

// Moves to the first part that holds flat pixels, full resolution.
void seek_flat_part(OIIO::ImageInput& input, const fs::path& path) {
  for (int part = 0; input.seek_subimage(part, 0); ++part)
    if (!input.spec().deep) return;
  input.geterror();
  refuse(path, "holds deep pixels only, expected a part with flat ones", "flatten it first");
}

int orientation_of(const OIIO::ImageInput& input) {
  const int said = input.spec().get_int_attribute("Orientation", 1);
  // The library names the two quarter turns of Radiance files (-X -Y and +X +Y) the wrong way round.
  if ((said == 6 || said == 8) && std::string(input.format_name()) == "hdr") return 14 - said;
  return said;
}

ImageFileInfo info_of(const OIIO::ImageInput& input) {
  const OIIO::ImageSpec& spec = input.spec();
  ImageFileInfo info;
  info.width = spec.full_width > 0 ? spec.full_width : spec.width;
  info.height = spec.full_height > 0 ? spec.full_height : spec.height;
  if (const int orientation = orientation_of(input); orientation >= 5 && orientation <= 8)
    std::swap(info.width, info.height);
  info.channels = spec.nchannels;
  // A picture of one channel is numbers, whatever the channel is called.
  if (spec.nchannels > 1 && spec.alpha_channel < spec.nchannels) info.alpha_channel = spec.alpha_channel;
  info.colors_times_alpha = info.alpha_channel >= 0 && !spec.get_int_attribute("oiio:UnassociatedAlpha");
  info.channel_names = spec.channelnames;
  info.format = input.format_name();
  info.pixel_type = spec.format.c_str();
  info.color_space = spec.get_string_attribute("oiio:ColorSpace");
  // OpenImageIO says "Linear" of every OpenEXR and Radiance file: that is the format's habit, not the file's word.
  if (info.color_space == "Linear" || info.color_space == "linear") info.color_space.clear();
  if (const auto* p = spec.find_attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8))) {
    const auto* xy = static_cast<const float*>(p->data());
    info.chromaticities =
        ColorManager::Chromaticities{{xy[0], xy[1]}, {xy[2], xy[3]}, {xy[4], xy[5]}, {xy[6], xy[7]}};
  }
  return info;
}

void check_limits(const OIIO::ImageSpec& spec, const fs::path& path, const ImageLimits& limits) {
  if (spec.nchannels < 1) refuse(path, "has no channels");
  if (spec.depth > 1) refuse(path, "is a volume, expected a flat picture");
  check_image_size(path, "data window", spec.width, spec.height, spec.nchannels, limits);
  if (spec.full_width > 0 && spec.full_height > 0)
    check_image_size(path, "picture", spec.full_width, spec.full_height, spec.nchannels, limits);
}

// Places the data window in the display window; outside it is black.
Image place(Image data, const OIIO::ImageSpec& spec) {
  const int width = spec.full_width > 0 ? spec.full_width : spec.width;
  const int height = spec.full_height > 0 ? spec.full_height : spec.height;
  const long long left = (long long)(spec.x) - spec.full_x, top = (long long)(spec.y) - spec.full_y;
  if (left == 0 && top == 0 && width == data.width && height == data.height) return data;
  Image placed(width, height, data.channels);
  const long long x0 = std::max(0ll, left), x1 = std::min<long long>(width, left + data.width);
  for (long long y = std::max(0ll, top); y < std::min<long long>(height, top + data.height) && x0 < x1; ++y)
    std::copy_n(data.at(int(x0 - left), int(y - top)), size_t(x1 - x0) * size_t(data.channels),
                placed.at(int(x0), int(y)));
  return placed;
}

// Reads the pixels of the current part; false (with the library's words) where the library reports a failure by
// either of its two ways.
template <class Pixel>
bool read_pixels(OIIO::ImageInput& input, OIIO::TypeDesc type, std::vector<Pixel>& pixels, std::string& error) {
  const bool read = input.read_image(input.current_subimage(), 0, 0, input.spec().nchannels, type, pixels.data());
  error = input.geterror();
  return read && error.empty();
}
ImageFileInfo read_info(const fs::path& path) {
  const Input input = open(path);
  seek_flat_part(*input, path);
  return info_of(*input);
}

Image read_pixels(const fs::path& path, const ImageLimits& limits, ImageFileInfo* info) {
  const Input input = open(path);
  seek_flat_part(*input, path);
  const OIIO::ImageSpec spec = input->spec();
  check_limits(spec, path, limits);
  if (info) *info = info_of(*input);
  Image image(spec.width, spec.height, spec.nchannels);
  std::string error;
  if (!read_pixels(*input, OIIO::TypeDesc::FLOAT, image.pixels, error))
    refuse(path, "its pixels cannot be read: the file is damaged or cut short" + because(error));
  return apply_orientation(place(std::move(image), spec), orientation_of(*input));
}

Attributes read_texts(const fs::path& path) {
  const Input input = open(path);
  Attributes attributes;
  for (const auto& entry : input->spec().extra_attribs) {
    const std::string name = entry.name().string();
    if (name == "ImageDescription" && entry.type() == OIIO::TypeDesc::STRING)
      attributes.merge(attributes_from_text(entry.get_string()));
    if (name.rfind("sateen:", 0) != 0 && name != "Software") continue;
    if (entry.type() == OIIO::TypeDesc::STRING) {
      attributes[name] = entry.get_string();
    } else if (entry.type() == OIIO::TypeDesc::INT) {
      attributes[name] = entry.get_int();
    } else if (entry.type() == OIIO::TypeDesc::DOUBLE) {
      attributes[name] = *static_cast<const double*>(entry.data());
    } else if (entry.type() == OIIO::TypeDesc::FLOAT) {
      attributes[name] = double(entry.get_float());
    }
  }
  return attributes;
}

bool decodes(const fs::path& path) {
  const Input input = open(path);
  seek_flat_part(*input, path);
  const OIIO::ImageSpec& spec = input->spec();
  // In the file's own kind of number: what is asked is whether the pixels are there.
  const OIIO::stride_t row = OIIO::stride_t(spec.scanline_bytes(true));
  const int step = spec.tile_width > 0 ? spec.tile_height : band_rows(row);
  std::vector<char> band(size_t(row) * size_t(step));
  for (int y = 0; y < spec.height; y += step) {
    const int y0 = spec.y + y, y1 = spec.y + std::min(y + step, spec.height);
    const bool read = spec.tile_width > 0
                          ? input->read_tiles(0, 0, spec.x, spec.x + spec.width, y0, y1, 0, 1, 0, spec.nchannels,
                                              OIIO::TypeDesc::UNKNOWN, band.data())
                          : input->read_scanlines(input->current_subimage(), 0, y0, y1, 0, 0, spec.nchannels,
                                                  OIIO::TypeDesc::UNKNOWN, band.data());
    if (!read || !input->geterror().empty()) return false;
  }
  return true;
}

/// A display picture as the file holds it: alpha left out where the format has none, real numbers as codes.
template <class Code>
struct CodeRows {
  const DisplayPicture& picture;
  int channels;
  bool dithered;

  size_t row() const { return size_t(picture.width) * size_t(channels); }
  int step() const { return band_rows(std::int64_t(row() * sizeof(float))); }

  std::vector<Code> at(int y0, int y1) const {
    constexpr float largest = float(std::numeric_limits<Code>::max());
    const Image image = picture.rows(y0, y1);
    if (image.width != picture.width || image.height != y1 - y0 || image.channels != picture.channels)
      throw OperationError("rows of another size than the picture");
    std::vector<Code> codes(row() * size_t(y1 - y0));
    Code* to = codes.data();
    for (int y = y0; y < y1; ++y)
      for (int x = 0; x < image.width; ++x)
        for (int c = 0; c < channels; ++c) {
          const float v = image.at(x, y - y0)[c], value = v > 0 ? std::min(v, 1.0f) : 0.0f;
          const float threshold = dithered && c < 3 ? dither_threshold(x, y, c) : 0.5f;
          *to++ = Code(std::min(value * largest + threshold, largest));
        }
    return codes;
  }
};

// Lossless files must give back every code; a JPEG, which may not, must give back the picture.
template <class Code>
void verify_display(const fs::path& path, const CodeRows<Code>& rows, OIIO::TypeDesc type, bool lossless) {
  OIIO::ImageSpec as_stored;
  as_stored.attribute("oiio:UnassociatedAlpha", 1);
  Input input = OIIO::ImageInput::open(path.string(), &as_stored);
  if (!input) throw OperationError("the file written cannot be read back" + because(OIIO::geterror()));
  const OIIO::ImageSpec& spec = input->spec();
  const int height = rows.picture.height;
  if (spec.width != rows.picture.width || spec.height != height || spec.nchannels != rows.channels)
    throw OperationError("the file written has another size than the picture");
  double difference = 0;
  for (int y0 = 0; y0 < height; y0 += rows.step()) {
    const int y1 = std::min(y0 + rows.step(), height);
    const std::vector<Code> codes = rows.at(y0, y1);
    std::vector<Code> back(codes.size());
    const bool read = input->read_scanlines(0, 0, y0, y1, 0, 0, spec.nchannels, type, back.data());
    const std::string error = input->geterror();
    if (!read || !error.empty()) throw OperationError("the pixels written cannot be read back" + because(error));
    if (lossless && back != codes) throw OperationError("the pixels read back differ from those written");
    for (size_t i = 0; i < codes.size(); ++i) difference += std::abs(double(back[i]) - double(codes[i]));
  }
  const double largest = double(std::numeric_limits<Code>::max());
  if (difference > 0.1 * largest * double(rows.row()) * double(height))
    throw OperationError("the picture read back differs from the one written");
}

template <class Code>
void write_codes(const fs::path& path, const OIIO::ImageSpec& spec, const CodeRows<Code>& rows, OIIO::TypeDesc type,
                 bool lossless) {
  write_file_whole(
      path,
      [&](const fs::path& temporary) {
        const auto output = OIIO::ImageOutput::create(temporary.string());
        if (!output) throw OperationError("no writer for this kind of file" + because(OIIO::geterror()));
        std::optional<CheckedProxy> file;
        // libtiff reads what it has written, and its failures do not end the program.
        if (std::string(output->format_name()) != "tiff") output->set_ioproxy(&file.emplace(temporary));
        if (!output->open(temporary.string(), spec))
          throw OperationError("cannot be opened for writing" + because(output->geterror()));
        // Some failures are reported as success by all calls and only leave a text behind.
        bool wrote = true;
        std::string error;
        errno = 0;
        for (int y0 = 0; y0 < spec.height && wrote && error.empty(); y0 += rows.step()) {
          const int y1 = std::min(y0 + rows.step(), spec.height);
          wrote = output->write_scanlines(y0, y1, 0, type, rows.at(y0, y1).data());
          error = output->geterror();
        }
        const bool closed = output->close();
        const int system = errno;
        if (error.empty()) error = output->geterror();
        if (file) file->finish();
        if (wrote && closed && error.empty()) return;
        const bool no_room = system == ENOSPC || system == EFBIG || system == EDQUOT || system == EIO;
        throw OperationError(no_room ? std::strerror(system) : "writing failed" + because(error));
      },
      [&](const fs::path& temporary) { verify_display(temporary, rows, type, lossless); });
}

void write_display(const fs::path& path, const DisplayPicture& picture, const Attributes& attributes, int bits,
                   bool srgb) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
  const bool png = extension == ".png", jpeg = extension == ".jpg" || extension == ".jpeg";
  const bool tiff = extension == ".tif" || extension == ".tiff";
  if (!png && !jpeg && !tiff)
    refuse(path, fmt::format("\"{}\" is no extension of a display picture, expected .png, .jpg or .tif", extension),
           "scene-linear pictures are written as .exr", InputError::Kind::wrong);
  if (bits != 8 && bits != 16)
    refuse(path, fmt::format("{} bits asked, expected 8 or 16", bits), {}, InputError::Kind::wrong);
  if (jpeg && bits == 16)
    refuse(path, "JPEG holds 8 bits, 16 asked", "write a .png or .tif", InputError::Kind::wrong);
  if (picture.width < 1 || picture.height < 1 || (picture.channels != 3 && picture.channels != 4))
    throw OperationError(fmt::format("{}: not written: the picture is {} x {} with {} channels, expected 3 or 4",
                                     path.string(), picture.width, picture.height, picture.channels));
  const int channels = jpeg ? 3 : picture.channels;
  const OIIO::TypeDesc type = bits == 8 ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::UINT16;
  OIIO::ImageSpec spec(picture.width, picture.height, channels, type);
  spec.attribute("oiio:UnassociatedAlpha", 1);  // the numbers as given, not divided by alpha on the way
  if (srgb) spec.attribute("oiio:ColorSpace", "sRGB");
  if (!srgb) spec.attribute("oiio:ColorSpace", "Rec709");
  if (jpeg) {
    spec.attribute("Compression", "jpeg:95");
    spec.attribute("jpeg:subsampling", "4:4:4");
  } else if (tiff) {
    spec.attribute("Compression", "zip");
    spec.attribute("DateTime", "1970:01:01 00:00:00");  // left alone, the writer puts the present time
  }
  if (!attributes.empty()) spec.attribute("ImageDescription", to_text(attributes));
  if (const auto found = attributes.find("Software"); found != attributes.end())
    if (const auto* text = std::get_if<std::string>(&found->second)) spec.attribute("Software", *text);
  if (bits == 8)
    write_codes(path, spec, CodeRows<std::uint8_t>{picture, channels, !jpeg}, type, !jpeg);
  else
    write_codes(path, spec, CodeRows<std::uint16_t>{picture, channels, false}, type, true);
}

}  // namespace

}  // namespace sateen

extern "C" const sateen::ImageFileFunctions* sateen_image_file_functions() {
  static const sateen::ImageFileFunctions functions{
      sateen::read_info, sateen::read_pixels,        sateen::read_texts,    sateen::write_display,
      sateen::decodes,   sateen::oiio::make_texture, sateen::oiio::look_up, sateen::oiio::free_texture};
  return &functions;
}
