#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "image/chromaticities.h"
#include "image/color_config.h"
#include "image/space_names.h"

namespace sateen {

namespace ocio = OCIO_NAMESPACE;

namespace {

/// A space that both sides may know, by the names that configs give it, without case, blanks and signs.
struct KnownSpace {
  const char* own;  ///< the project's name
  const char* text;
  std::vector<std::string> names;
};

const std::vector<KnownSpace>& known_spaces() {
  static const std::vector<KnownSpace> all{
      {"aces2065-1",
       "ACES2065-1",
       {"aces20651", "acesaces20651", "linap0", "linap0scene", "linearap0", "acesap0", "aces20651ap0", "linearaces",
        "linaces", "aceslinear", "linearaces20651", "aces"}},
      {"acescg",
       "ACEScg",
       {"acescg", "acesacescg", "linap1", "linap1scene", "linearap1", "acesap1", "acescgap1", "linearacescg",
        "linacescg", "acescglinear"}},
      {"lin_rec709",
       "linear Rec.709",
       {"linrec709", "linrec709scene", "linearrec709", "linsrgb", "linsrgbscene", "linearsrgb", "linrec709srgb",
        "linearrec709srgb", "scenelinearrec709", "scenelinearrec709srgb", "linearbt709", "linbt709",
        "linearsrgbrec709", "linearbt709srgb", "srgblinear", "rec709linear", "linearitubt709", "bt709linear",
        "linearbt709i"}},
      {"cie_xyz_d65",
       "CIE XYZ",
       {"xyz",
        "ciexyz",
        "linxyz",
        "linearxyz",
        "linciexyz",
        "linearciexyz",
        "xyzd65",
        "ciexyzd65",
        "linearxyzd65",
        "linxyzd65",
        "linearciexyzd65",
        "linciexyzd65",
        "linciexyzd65scene",
        "ciexyzd65scene",
        "ciexyzd65interchange",
        "xyzd60",
        "ciexyzd60",
        "xyzd50",
        "ciexyzd50",
        "xyze",
        "ciexyze",
        "linearciexyze",
        "ciexyz1931",
        "xyz1931"}}};
  return all;
}

std::string plain(const std::string& name) {
  std::string text;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c))) text += char(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// A name, and what is left of it without the families in front: "Utility - Linear - sRGB", "ACES/ACEScg".
std::vector<std::string> readings(const std::string& name) {
  std::vector<std::string> all{plain(name)};
  for (size_t i = 0; i < name.size(); ++i) {
    const bool dash = name.compare(i, 3, " - ") == 0;
    if (dash || name[i] == '/' || name[i] == '|' || name[i] == ':')
      all.push_back(plain(name.substr(i + (dash ? 3 : 1))));
  }
  return all;
}

bool goes_by(const std::string& name, const KnownSpace& space) {
  for (const std::string& reading : readings(name))
    if (std::find(space.names.begin(), space.names.end(), reading) != space.names.end()) return true;
  return false;
}

/// Not linear, so no bridge, but known by its names in files.
const KnownSpace& encoded_srgb() {
  static const KnownSpace one{"srgb_texture",
                              "sRGB",
                              {"srgb", "srgbtexture", "srgbrec709scene", "srgbrec709display", "srgbdisplay", "srgbtx",
                               "srgbencodedrec709", "srgbencodedrec709srgb"}};
  return one;
}

/// Names of the config's spaces that go by one of the known names, the roles' first: a line among the roles is how
/// one says what a space is.
std::vector<std::string> spaces_called(const ocio::Config& config, const KnownSpace& known) {
  std::vector<std::string> found;
  const auto add = [&](const std::string& name, const char* space) {
    const ocio::ConstColorSpaceRcPtr one = config.getColorSpace(space);
    if (one && !one->isData() && goes_by(name, known)) found.emplace_back(one->getName());
  };
  for (int i = 0; i < config.getNumRoles(); ++i) add(config.getRoleName(i), config.getRoleColorSpace(i));
  const int count = config.getNumColorSpaces(ocio::SEARCH_REFERENCE_SPACE_ALL, ocio::COLORSPACE_ALL);
  for (int i = 0; i < count; ++i) {
    const char* name = config.getColorSpaceNameByIndex(ocio::SEARCH_REFERENCE_SPACE_ALL, ocio::COLORSPACE_ALL, i);
    const ocio::ConstColorSpaceRcPtr space = config.getColorSpace(name);
    add(name, name);
    for (size_t a = 0; space && a < space->getNumAliases(); ++a) add(space->getAlias(a), name);
  }
  return found;
}

using Vector = std::array<double, 3>;

/// The matrix from scene_linear to a space; nullopt where there is none: the space has a curve, or a look in it.
/// Throws OpenColorIO's exception where the conversion cannot be built in either direction.
std::optional<Matrix3> matrix_to(const ocio::Config& config, const std::string& space) {
  if (const std::string ring = ring_between(config, space, "scene_linear"); !ring.empty())
    throw ocio::Exception(("names lead back to themselves without end: " + ring).c_str());
  config.getProcessor(space.c_str(), "scene_linear")->getDefaultCPUProcessor();
  const auto processor = config.getProcessor("scene_linear", space.c_str())->getDefaultCPUProcessor();
  const auto run = [&](float r, float g, float b) {
    float rgb[3] = {r, g, b};
    processor->applyRGB(rgb);
    return Vector{double(rgb[0]), double(rgb[1]), double(rgb[2])};
  };
  Matrix3 m{};
  for (size_t column = 0; column < 3; ++column) {
    const Vector unit = run(column == 0, column == 1, column == 2);
    for (size_t row = 0; row < 3; ++row) m[row][column] = unit[row];
  }
  for (const std::array<float, 3>& probe :
       {std::array{0.0f, 0.0f, 0.0f}, {0.01f, 0.02f, 0.03f}, {0.5f, 0.2f, 0.1f}, {7.0f, 3.0f, 5.0f}}) {
    const Vector found = run(probe[0], probe[1], probe[2]);
    for (size_t row = 0; row < 3; ++row) {
      const double expected =
          m[row][0] * double(probe[0]) + m[row][1] * double(probe[1]) + m[row][2] * double(probe[2]);
      if (!(std::abs(found[row] - expected) <= 1e-3 * double(probe[0] + probe[1] + probe[2]) + 1e-6)) return {};
    }
  }
  return m;
}

/// XYZ in which scene_linear's white is `white` to ACES2065-1, in which it is 1, 1, 1.
std::optional<Matrix3> aces_from_xyz(const Vector& white) {
  const double sum = white[0] + white[1] + white[2];
  const double x = white[0] / sum, y = white[1] / sum;
  // From candle light to a blue sky, and not the numbers of something else.
  if (!(white[1] > 1e-3 && x > 0.2 && x < 0.55 && y > 0.2 && y < 0.5)) return {};
  return xyz_to_aces2065_1(white);
}

struct Found {
  Bridge bridge;
  std::optional<Matrix3> to_aces;  ///< from scene_linear
  std::optional<Matrix3> xyz;      ///< to ACES2065-1, where the project's own config has no such XYZ
};

/// The same light in the project's own config.
std::optional<Found> join(const KnownSpace& known, const std::string& name, const Matrix3& matrix) {
  Found found;
  found.bridge = {known.own, name, fmt::format("its space {}, taken as {}", name, known.text)};
  if (std::string(known.own) != "cie_xyz_d65") {
    const Matrix3 to_aces = std::string(known.own) == "acescg"       ? to_aces2065_1(ap1_chromaticities)
                            : std::string(known.own) == "lin_rec709" ? to_aces2065_1(rec709_chromaticities)
                                                                     : Matrix3{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    found.to_aces = multiply(to_aces, matrix);
    return found;
  }
  // Configs write XYZ with the white of the display, of ACES or of equal energy: scene_linear's white tells.
  Vector white{};
  for (size_t row = 0; row < 3; ++row) white[row] = matrix[row][0] + matrix[row][1] + matrix[row][2];
  const std::optional<Matrix3> to_aces = aces_from_xyz(white);
  if (!to_aces) return {};
  found.to_aces = multiply(*to_aces, matrix);
  const double x = white[0] / (white[0] + white[1] + white[2]), y = white[1] / (white[0] + white[1] + white[2]);
  found.bridge.how += fmt::format(" with a white of {:.4f} {:.4f}", x, y);
  if (std::abs(white[0] - 0.9505) < 2e-3 && std::abs(white[1] - 1) < 2e-3 && std::abs(white[2] - 1.089) < 2e-3)
    return found;
  found.xyz = to_aces;
  return found;
}

void add_xyz(ocio::Config& own, const std::string& name, const Matrix3& to_aces) {
  const ocio::ColorSpaceRcPtr space = ocio::ColorSpace::Create();
  space->setName(name.c_str());
  const ocio::MatrixTransformRcPtr transform = ocio::MatrixTransform::Create();
  double m44[16] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1};
  for (size_t row = 0; row < 3; ++row)
    for (size_t column = 0; column < 3; ++column) m44[4 * row + column] = to_aces[row][column];
  transform->setMatrix(m44);
  space->setTransform(transform, ocio::COLORSPACE_DIR_TO_REFERENCE);
  own.addColorSpace(space);
}

double largest_difference(const Matrix3& a, const Matrix3& b) {
  double largest = 0;
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) largest = std::max(largest, std::abs(a[i][j] - b[i][j]));
  return largest;
}

}  // namespace

std::string own_space_called(const std::string& name) {
  for (const KnownSpace& known : known_spaces())
    if (goes_by(name, known)) return known.own;
  return goes_by(name, encoded_srgb()) ? encoded_srgb().own : "";
}

bool says_nothing(const std::string& name) {
  const std::string word = plain(name);
  return word == "linear" || word == "scenelinear" || word == "lin" || word == "unknown" || word == "default";
}

Bridge find_bridge(const ocio::Config& foreign, const std::string& file, ocio::Config& own,
                   std::vector<std::string>& warnings) {
  std::optional<Found> best;
  std::string failure;
  if (foreign.hasRole("aces_interchange")) try {
      const std::optional<Matrix3> matrix = matrix_to(foreign, "aces_interchange");
      best = Found{{"aces2065-1", "aces_interchange", "its role aces_interchange"}, matrix, {}};
    } catch (const ocio::Exception& error) {
      failure = first_line(error.what());
    }
  for (const KnownSpace& known : known_spaces()) {
    std::optional<Found> one;
    for (const std::string& name : spaces_called(foreign, known)) {
      if (one) break;
      try {
        if (const std::optional<Matrix3> matrix = matrix_to(foreign, name)) one = join(known, name, *matrix);
      } catch (const ocio::Exception&) {
        continue;  // it needs a file that is missing: then it is of no use
      }
    }
    if (!one) continue;
    if (!best) best = one;
    // Configs adapt whites in more than one way, which moves the numbers by less.
    constexpr double most = 0.05;
    if (best->to_aces && largest_difference(*best->to_aces, *one->to_aces) > most)
      warnings.push_back(
          fmt::format("{}: what this colour config says of its colours by {} contradicts {}; the first is used", file,
                      best->bridge.how, one->bridge.how));
  }
  if (best && best->xyz) add_xyz(own, best->bridge.own = "xyz of the foreign config", *best->xyz);
  if (best) return best->bridge;
  if (!failure.empty())
    throw InputError(fmt::format("{}: its role aces_interchange, by which it is joined to others, cannot be used "
                                 "(OpenColorIO: {})",
                                 file, failure),
                     {}, InputError::Kind::unreadable);
  const char* space = foreign.getColorSpace("scene_linear")->getName();
  warnings.push_back(fmt::format(
      "{0}: nothing in this colour config tells what the colours of its scene_linear, {1}, are: it has no role "
      "aces_interchange and no space of a known name. They are assumed to be linear Rec.709, and an EXR will not "
      "name its primaries. Add to its roles \"lin_rec709: {1}\" where that is so, else \"aces_interchange: NAME\" "
      "with the name of its ACES2065-1 space",
      file, space));
  return {"lin_rec709", "scene_linear", "the assumption that its scene_linear is linear Rec.709", false};
}

}  // namespace sateen
