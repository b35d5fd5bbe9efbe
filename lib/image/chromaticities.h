#pragma once
#include <array>

#include "image/color.h"

namespace sateen {

using Matrix3 = std::array<std::array<double, 3>, 3>;  ///< rows first; applied to column vectors

Matrix3 multiply(const Matrix3& a, const Matrix3& b);
Matrix3 inverse(const Matrix3& m);  ///< the matrix must not be singular

/// Linear RGB of the given primaries and white to CIE XYZ with that white at Y = 1 (SMPTE RP 177). InputError where
/// the numbers describe no space: not finite, y of the white not positive, primaries on one line.
Matrix3 rgb_to_xyz(const ColorManager::Chromaticities& space);

/// The same to ACES2065-1, Bradford-adapted from the space's white to the ACES white.
Matrix3 to_aces2065_1(const ColorManager::Chromaticities& space);

/// CIE XYZ in which white is `white` to ACES2065-1, Bradford-adapted, where white is 1, 1, 1.
Matrix3 xyz_to_aces2065_1(const std::array<double, 3>& white);

/// Primaries and white of a linear space given by its matrix to ACES2065-1. Rec.709, AP1, AP0, Rec.2020 and Display
/// P3 are recognised (within 2e-3) and get their own published numbers; any other is described with the ACES white,
/// to which the matrix has adapted it.
ColorManager::Chromaticities chromaticities_of(const Matrix3& to_aces2065_1);

extern const ColorManager::Chromaticities rec709_chromaticities;  ///< ITU-R BT.709
extern const ColorManager::Chromaticities ap1_chromaticities;     ///< Academy S-2014-004
extern const ColorManager::Chromaticities ap0_chromaticities;     ///< SMPTE ST 2065-1

/// The project's name of a space with these numbers, within 1e-4: "lin_rec709", "acescg", "aces2065-1"; else null.
const char* name_of(const ColorManager::Chromaticities& space);

}  // namespace sateen
