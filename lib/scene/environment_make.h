#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "image/file.h"
#include "math/vector.h"

namespace sateen {

/// One light of a made map; lights add up. Azimuth 0 is the camera's side (+Z), 90 the right of the picture (+X), 180
/// behind the cloth; elevation 90 is up (+Y). All in degrees.
struct MapLight {
  enum class Kind {
    uniform,   ///< the same everywhere
    gradient,  ///< by elevation alone, linear between stops
    softbox,   ///< flat rectangle, seen from the middle of the map
    disc,      ///< round, of one brightness: a sun or a bare bulb
    glow       ///< exp(-(angle / width)^2): haze about a sun, light spilt on a wall
  };
  struct Stop {
    float elevation_deg = 0;
    Color color{0, 0, 0};
  };

  Kind kind = Kind::uniform;
  float azimuth_deg = 0;    ///< -360 to 360
  float elevation_deg = 0;  ///< -90 to 90
  float width_deg = 30;     ///< full angle; disc: the diameter; glow: where it has fallen to 1/e; above 0 to 170
  float height_deg = 30;    ///< softbox
  float roll_deg = 0;       ///< softbox, clockwise as seen from the middle
  float edge = 0;           ///< share of the half size over which softbox or disc fade out, 0 to 1
  float hot = 0;            ///< softbox: how much darker its corners are than its middle, 0 to 1
  Color color{1, 1, 1};     ///< linear, in the map's space; a file may say "kelvin" instead
  float intensity = 1;      ///< factor on color: radiance
  std::vector<Stop> stops;  ///< gradient: ascending elevation
};

/// A lat-long map described by its lights.
struct MapDescription {
  std::string title, description;
  int width = 1024, height = 512;          ///< up to 16,384 x 8,192
  std::string color_space = "lin_rec709";  ///< or "acescg"
  bool metered = true;                     ///< scaled so that its metered exposure is 0 EV
  std::vector<MapLight> lights;
};

/// Reads a description, JSON with comments: keys as the fields above. InputError with file:line:column for every
/// unknown key, wrong kind and value out of range, all at once.
MapDescription read_map_description(const std::filesystem::path& path);
MapDescription parse_map_description(const std::string& text, const std::string& file);

/// The map in its colour space. Every texel is the mean over its solid angle: of 256 points for lights with a border
/// sharper than four texels, of 4 to 16 for softer ones. A disc has the exact energy of its size, however small.
Image make_environment(const MapDescription& description);

/// Makes the map and writes it whole or not at all as half OpenEXR with its chromaticities. Returns what half floats
/// made of it.
HalfRange write_made_environment(const std::filesystem::path& path, const MapDescription& description);

/// Linear Rec.709 of a black body, luminance 1: Krystek 1985's fit of the Planckian locus, 1,000 to 15,000 K.
/// Negative parts (below 1,900 K) are cut to 0.
Color black_body_rec709(float kelvin);

}  // namespace sateen
