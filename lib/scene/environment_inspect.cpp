#include "scene/environment_inspect.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

namespace sateen {

namespace {
constexpr double pi_d = std::numbers::pi;

double luminance(const Environment& e, size_t i) {
  const Color& c = e.texels.empty() ? e.fine[i] : e.texels[i].radiance;
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += double(c[k]) * double(e.luminance[k]);
  return sum;
}

// The luminance that one of a hundred lit texels stays below. Found 16 bits at a time, for a sorted copy of a large
// map would be larger than the map: bits of positive numbers are in the order of the numbers.
double dim_luminance(const Environment& e) {
  const size_t texels = size_t(e.width) * size_t(e.height);
  std::uint64_t prefix = 0;
  size_t rank = 0;
  std::vector<size_t> counts(1 << 16);
  for (int shift = 48; shift >= 0; shift -= 16) {
    std::fill(counts.begin(), counts.end(), size_t(0));
    size_t lit = 0;
    for (size_t i = 0; i < texels; ++i) {
      const double l = luminance(e, i);
      if (!(l > 0)) continue;
      const auto bits = std::bit_cast<std::uint64_t>(l);
      if (shift < 48 && bits >> (shift + 16) != prefix) continue;
      ++counts[(bits >> shift) & 0xffff];
      ++lit;
    }
    if (shift == 48) rank = lit / 100;
    size_t part = 0;
    while (part + 1 < counts.size() && rank >= counts[part]) rank -= counts[part++];
    prefix = prefix << 16 | part;
  }
  return std::bit_cast<double>(prefix);
}

// Collects the region around texel `start` and marks it as taken.
LightRegion grow(const Environment& e, size_t start, double threshold, double whole, std::vector<bool>& taken) {
  std::vector<size_t> open{start};
  taken[start] = true;
  Vec3d sum(0, 0, 0);
  double energy = 0, solid_angle = 0, peak = 0;
  while (!open.empty()) {
    const size_t i = open.back();
    open.pop_back();
    const int x = int(i % size_t(e.width)), y = int(i / size_t(e.width));
    const double weight = environment_row_weight(y, e.height) * 2 * pi_d / e.width, l = luminance(e, i);
    const double colatitude = pi_d * (y + 0.5) / e.height,
                 longitude = 2 * pi_d * ((x + 0.5) / e.width + e.rotation_turns);
    sum += Vec3d(-std::sin(longitude) * std::sin(colatitude), std::cos(colatitude),
                 std::cos(longitude) * std::sin(colatitude)) *
           (l * weight);
    energy += l * weight;
    solid_angle += weight;
    peak = std::max(peak, l);
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        if (y + dy < 0 || y + dy >= e.height) continue;
        const size_t j = size_t(y + dy) * size_t(e.width) + size_t((x + dx + e.width) % e.width);
        if (taken[j] || luminance(e, j) <= threshold) continue;
        taken[j] = true;
        open.push_back(j);
      }
  }
  LightRegion region;
  // A ring all around has no middle: any direction of it will do, and its share tells the rest.
  const Vec3d middle = sum.length() > 1e-9 * energy ? sum / sum.length() : Vec3d(0, 1, 0);
  region.direction = Vec3(float(middle.x), float(middle.y), float(middle.z));
  region.azimuth_deg = float(std::atan2(middle.x, middle.z) * 180 / pi_d);
  region.elevation_deg = float(std::asin(std::clamp(middle.y, -1.0, 1.0)) * 180 / pi_d);
  region.solid_angle = float(solid_angle);
  region.share = float(energy / whole);
  region.peak = float(peak);
  return region;
}
}  // namespace

EnvironmentReport inspect_environment(const Environment& e) {
  EnvironmentReport report;
  report.width = e.width;
  report.height = e.height;
  report.repairs = e.repairs;
  report.notes = e.notes;
  report.notices = environment_notices(e);
  report.metered_ev = metered_exposure_ev(e);
  double smallest = std::numeric_limits<double>::infinity(), largest = 0, whole = 0;
  for (int y = 0; y < e.height; ++y) {
    double row = 0;
    for (int x = 0; x < e.width; ++x) {
      const double l = luminance(e, size_t(y) * size_t(e.width) + size_t(x));
      smallest = std::min(smallest, l);
      largest = std::max(largest, l);
      row += l;
    }
    whole += row * environment_row_weight(y, e.height) * 2 * pi_d / e.width;
  }
  const double mean = whole / (4 * pi_d);
  report.smallest = float(smallest);
  report.largest = float(largest);
  report.mean = float(mean);
  if (!(mean > 0)) return report;
  report.largest_over_mean = float(largest / mean);
  report.stops = float(std::log2(largest / dim_luminance(e)));
  const double threshold = mean * (largest > 3 * mean ? 3 : 1.2);
  const size_t texels = size_t(e.width) * size_t(e.height);
  std::vector<bool> taken(texels);
  for (size_t i = 0; i < texels; ++i)
    if (!taken[i] && luminance(e, i) > threshold) report.regions.push_back(grow(e, i, threshold, whole, taken));
  std::stable_sort(report.regions.begin(), report.regions.end(),
                   [](const LightRegion& a, const LightRegion& b) { return a.share > b.share; });
  if (report.regions.size() > 5) report.regions.resize(5);
  return report;
}

std::vector<std::string> repair_texts(const EnvironmentRepairs& repairs) {
  std::vector<std::string> texts;
  const auto add = [&](const EnvironmentRepairs::Kind& kind, const char* what) {
    if (kind.count > 0)
      texts.push_back(fmt::format("{} pixel{} {}, first at {} {}", kind.count, kind.count == 1 ? "" : "s", what,
                                  kind.first_x, kind.first_y));
  };
  add(repairs.not_a_number, "not a number: made 0");
  add(repairs.infinite, "infinite: made the map's largest finite value, or 65504 where it has none");
  add(repairs.negative,
      "negative in the working space as in the file: made 0 there, which makes their colours paler");
  add(repairs.out_of_gamut,
      "of colours beyond the working space's gamut: what is negative there was made 0, which makes them paler");
  add(repairs.spike, "with one channel far above the others (left as they are; perhaps damaged)");
  return texts;
}

std::vector<std::string> environment_notices(const Environment& e) {
  std::vector<std::string> notices = repair_texts(e.repairs);
  notices.insert(notices.end(), e.doubts.begin(), e.doubts.end());
  if (e.black) notices.push_back("it is black: nothing will be lit");
  const std::int64_t texels = std::int64_t(e.width) * e.height;
  // One pixel is a constant light, and a shrunk map may miss two to one by a row.
  if (texels > 1 && std::abs(e.width - 2ll * e.height) > (e.width < 8 ? 0 : 1))
    notices.push_back(fmt::format(
        "it is {} x {}, and a lat-long map is twice as wide as high: it is taken for the whole sphere and "
        "stretched",
        e.width, e.height));
  return notices;
}

}  // namespace sateen
