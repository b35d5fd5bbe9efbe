#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "image/radiance.h"

namespace sateen {

namespace fs = std::filesystem;

namespace {
// Programs append their command lines: real headers reach some kilobytes.
constexpr size_t longest_header = 1 << 20;

/// The next line without its end; false where the file ends first.
bool next_line(std::istream& in, std::string& line, size_t& left, const fs::path& path) {
  line.clear();
  for (int c = in.get(); c != std::char_traits<char>::eof(); c = in.get()) {
    if (left-- == 0) refuse_picture(path, "its header does not end within 1 MiB, expected an empty line");
    if (c == '\n') {
      if (!line.empty() && line.back() == '\r') line.pop_back();
      return true;
    }
    line += char(c);
  }
  return false;
}

/// What a line sets, where it is `name=...`. A line behind a tab belongs to a picture that this one was made from.
std::optional<std::string> value_of(const std::string& line, const char* name) {
  const std::string start = std::string(name) + "=";
  if (line.rfind(start, 0) != 0) return std::nullopt;
  const size_t from = line.find_first_not_of(" \t", start.size());
  if (from == std::string::npos) return std::string();
  return line.substr(from, line.find_last_not_of(" \t") + 1 - from);
}

std::vector<double> numbers_of(const fs::path& path, const char* name, const std::string& value, size_t count) {
  std::istringstream in(value);
  in.imbue(std::locale::classic());
  std::vector<double> numbers;
  for (double number; numbers.size() < count && in >> number;) numbers.push_back(number);
  bool good = numbers.size() == count;
  for (const double number : numbers) good = good && std::isfinite(number) && std::abs(number) < 1e30;
  if (!good)
    refuse_picture(path, fmt::format("its header says {}={:.60}, expected {} number{}", name, value, count,
                                     count == 1 ? "" : "s"));
  return numbers;
}

double positive(const fs::path& path, const char* name, const std::string& value, double number) {
  if (!(number > 1e-30 && number < 1e30))
    refuse_picture(path, fmt::format("its header says {}={:.60}, expected a number from 1e-30 to 1e30", name, value));
  return number;
}

/// One of -Y, +Y, -X, +X and a number of pixels.
struct Axis {
  char sign = 0, name = 0;
  long long count = 0;
};
bool parse_axis(std::istringstream& in, Axis& axis) {
  in >> std::ws;
  axis.sign = char(in.get());
  axis.name = char(in.get());
  return (axis.sign == '-' || axis.sign == '+') && (axis.name == 'X' || axis.name == 'Y') && bool(in >> axis.count);
}

bool parse_resolution(const std::string& line, RadianceHeader& header, Axis& major, Axis& minor) {
  std::istringstream in(line);
  if (!parse_axis(in, major) || !parse_axis(in, minor) || major.name == minor.name) return false;
  header.columns = major.name == 'X';
  const Axis &x = header.columns ? major : minor, &y = header.columns ? minor : major;
  header.right_to_left = x.sign == '-';
  header.bottom_up = y.sign == '+';
  return true;
}

void read_line(const fs::path& path, const std::string& line, RadianceHeader& header) {
  if (const auto format = value_of(line, "FORMAT")) {
    header.xyz = *format == "32-bit_rle_xyze";
    if (!header.xyz && *format != "32-bit_rle_rgbe")
      refuse_picture(path, fmt::format("its pixels are in the format {:.60}, expected 32-bit_rle_rgbe or "
                                       "32-bit_rle_xyze",
                                       *format));
  } else if (const auto exposure = value_of(line, "EXPOSURE")) {
    const double factor = positive(path, "EXPOSURE", *exposure, numbers_of(path, "EXPOSURE", *exposure, 1)[0]);
    for (double& e : header.exposure) e *= factor;
  } else if (const auto correction = value_of(line, "COLORCORR")) {
    const std::vector<double> factors = numbers_of(path, "COLORCORR", *correction, 3);
    for (size_t i = 0; i < 3; ++i) header.exposure[i] *= positive(path, "COLORCORR", *correction, factors[i]);
  } else if (const auto gamma = value_of(line, "GAMMA")) {
    header.gamma = positive(path, "GAMMA", *gamma, numbers_of(path, "GAMMA", *gamma, 1)[0]);
    if (header.gamma < 0.05 || header.gamma > 20)
      refuse_picture(path, fmt::format("its header says GAMMA={:.60}, expected 0.05 to 20", *gamma));
  } else if (const auto primaries = value_of(line, "PRIMARIES")) {
    const std::vector<double> n = numbers_of(path, "PRIMARIES", *primaries, 8);
    header.primaries = ColorManager::Chromaticities{{float(n[0]), float(n[1])},
                                                    {float(n[2]), float(n[3])},
                                                    {float(n[4]), float(n[5])},
                                                    {float(n[6]), float(n[7])}};
  }
}
}  // namespace

bool is_radiance(const fs::path& path) {
  return first_bytes(path, 2) == "#?";
}

RadianceHeader read_radiance_header(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  RadianceHeader header;
  std::string line;
  size_t left = longest_header;
  if (!next_line(in, line, left, path) || line.rfind("#?", 0) != 0)
    refuse_picture(path, "is not a Radiance picture, expected #? at its beginning");
  Axis major, minor;
  bool found = false;
  // Some writers leave out the empty line, others write two.
  while (!found && next_line(in, line, left, path)) {
    found = parse_resolution(line, header, major, minor);
    if (!found) read_line(path, line, header);
  }
  if (!found)
    refuse_picture(path, "is a Radiance picture without a resolution string, expected a line like -Y 512 +X 1024");
  for (const double e : header.exposure)
    if (!(e > 1e-30 && e < 1e30))
      refuse_picture(path, fmt::format("its EXPOSURE and COLORCORR lines multiply to {:.3g}", e));
  // Compared before they are narrowed; the limits ask for less.
  constexpr long long most = 1 << 30;
  if (major.count < 1 || minor.count < 1 || major.count > most || minor.count > most)
    refuse_picture(path, fmt::format("its resolution string says {} x {} pixels", minor.count, major.count));
  header.scanlines = int(major.count);
  header.length = int(minor.count);
  header.pixels_at = (long long)(in.tellg());
  return header;
}

}  // namespace sateen
