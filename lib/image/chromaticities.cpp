#include "image/chromaticities.h"

#include <cmath>

#include "base/error.h"

namespace sateen {

const ColorManager::Chromaticities rec709_chromaticities{
    {0.64f, 0.33f}, {0.30f, 0.60f}, {0.15f, 0.06f}, {0.3127f, 0.3290f}};
const ColorManager::Chromaticities ap1_chromaticities{
    {0.713f, 0.293f}, {0.165f, 0.830f}, {0.128f, 0.044f}, {0.32168f, 0.33767f}};
const ColorManager::Chromaticities ap0_chromaticities{
    {0.7347f, 0.2653f}, {0.0f, 1.0f}, {0.0001f, -0.0770f}, {0.32168f, 0.33767f}};

namespace {
const ColorManager::Chromaticities rec2020_chromaticities{
    {0.708f, 0.292f}, {0.170f, 0.797f}, {0.131f, 0.046f}, {0.3127f, 0.3290f}};
const ColorManager::Chromaticities display_p3_chromaticities{
    {0.680f, 0.320f}, {0.265f, 0.690f}, {0.150f, 0.060f}, {0.3127f, 0.3290f}};

using Vector = std::array<double, 3>;

Vector transform(const Matrix3& m, const Vector& v) {
  Vector r{};
  for (size_t i = 0; i < 3; ++i) r[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return r;
}

double determinant(const Matrix3& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

Vector white_xyz(const float (&xy)[2]) {
  const double x = double(xy[0]), y = double(xy[1]);
  return {x / y, 1, (1 - x - y) / y};
}

// Cone responses of the linearised Bradford transform, Lam 1985; the same matrix that ICC v4 prints.
constexpr Matrix3 bradford{{{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};

Matrix3 adaptation(const Vector& from, const Vector& to) {
  const Vector a = transform(bradford, from), b = transform(bradford, to);
  Matrix3 gains{};
  for (size_t i = 0; i < 3; ++i) gains[i][i] = b[i] / a[i];
  return multiply(inverse(bradford), multiply(gains, bradford));
}

bool near(const Matrix3& a, const Matrix3& b) {
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j)
      if (!(std::abs(a[i][j] - b[i][j]) < 2e-3)) return false;  // configs print their matrices to four digits
  return true;
}
}  // namespace

Matrix3 multiply(const Matrix3& a, const Matrix3& b) {
  Matrix3 r{};
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) r[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
  return r;
}

Matrix3 inverse(const Matrix3& m) {
  const double d = 1 / determinant(m);
  Matrix3 r{};
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) {
      const size_t a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, e = (i + 2) % 3;
      r[i][j] = (m[a][c] * m[b][e] - m[a][e] * m[b][c]) * d;
    }
  return r;
}

Matrix3 rgb_to_xyz(const ColorManager::Chromaticities& space) {
  const float* const primaries[3] = {space.red, space.green, space.blue};
  // X, Y, Z up to a scale are x, y, 1 - x - y: no division, so that AP0's green (y = 1) and primaries with y = 0
  // work.
  Matrix3 m{};
  for (size_t i = 0; i < 3; ++i) {
    const double x = double(primaries[i][0]), y = double(primaries[i][1]);
    m[0][i] = x;
    m[1][i] = y;
    m[2][i] = 1 - x - y;
  }
  const Vector white = white_xyz(space.white);
  bool usable = space.white[1] > 1e-3f && std::abs(determinant(m)) > 1e-6;
  Vector scale{};
  if (usable) scale = transform(inverse(m), white);
  for (size_t i = 0; i < 3; ++i) {
    usable = usable && std::isfinite(scale[i]) && scale[i] > 0 && std::isfinite(white[i]);
    for (size_t row = 0; row < 3; ++row) m[row][i] *= scale[i];
  }
  if (!usable)
    throw InputError("the chromaticities describe no colour space: expected three primaries around a white");
  return m;
}

Matrix3 to_aces2065_1(const ColorManager::Chromaticities& space) {
  const Matrix3 to_xyz = rgb_to_xyz(space);
  const Matrix3 adapt = adaptation(white_xyz(space.white), white_xyz(ap0_chromaticities.white));
  return multiply(inverse(rgb_to_xyz(ap0_chromaticities)), multiply(adapt, to_xyz));
}

Matrix3 xyz_to_aces2065_1(const std::array<double, 3>& white) {
  return multiply(inverse(rgb_to_xyz(ap0_chromaticities)), adaptation(white, white_xyz(ap0_chromaticities.white)));
}

const char* name_of(const ColorManager::Chromaticities& space) {
  const auto same = [&](const ColorManager::Chromaticities& known) {
    const float* const found[4] = {space.red, space.green, space.blue, space.white};
    const float* const wanted[4] = {known.red, known.green, known.blue, known.white};
    for (size_t i = 0; i < 8; ++i)
      if (!(std::abs(found[i / 2][i % 2] - wanted[i / 2][i % 2]) < 1e-4f)) return false;
    return true;
  };
  return same(rec709_chromaticities) ? "lin_rec709"
         : same(ap1_chromaticities)  ? "acescg"
         : same(ap0_chromaticities)  ? "aces2065-1"
                                     : nullptr;
}

ColorManager::Chromaticities chromaticities_of(const Matrix3& to_aces) {
  for (const auto* known : {&rec709_chromaticities, &ap1_chromaticities, &ap0_chromaticities, &rec2020_chromaticities,
                            &display_p3_chromaticities})
    if (near(to_aces, to_aces2065_1(*known))) return *known;
  const Matrix3 xyz = multiply(rgb_to_xyz(ap0_chromaticities), to_aces);
  ColorManager::Chromaticities result = ap0_chromaticities;
  float* const primaries[3] = {result.red, result.green, result.blue};
  for (size_t i = 0; i < 3; ++i) {
    const double sum = xyz[0][i] + xyz[1][i] + xyz[2][i];
    primaries[i][0] = float(xyz[0][i] / sum);
    primaries[i][1] = float(xyz[1][i] / sum);
  }
  return result;
}

}  // namespace sateen
