#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "image/image.h"

namespace sateen {

/// Colour management: one OpenColorIO config and the working space chosen in it. Every conversion of the project
/// goes through here; OpenColorIO's headers stay in the sources image/color*.cpp.
class ColorManager {
 public:
  /// `config`: a path, "built-in", or empty for $OCIO, else the project's own built-in config. `working`: a colour
  /// space of the config, or empty for its scene_linear role. InputError, loudly, where the config is missing or
  /// refused; what is odd about it is in warnings().
  explicit ColorManager(const std::string& config = {}, const std::string& working = {});
  ~ColorManager();
  ColorManager(ColorManager&&) noexcept;

  std::string description() const;                   ///< which config is in force and where it came from
  const std::vector<std::string>& warnings() const;  ///< faults of the config, and what had to be assumed of it
  std::string working_space() const;
  bool has_space(const std::string& name) const;
  std::vector<std::string> spaces() const;
  std::vector<std::string> displays() const;
  std::vector<std::string> views(const std::string& display) const;
  std::string default_display() const;
  std::string default_view(const std::string& display) const;

  /// From a named space to the working space; InputError with the nearest name for an unknown space. The project's
  /// own names (lin_rec709, acescg, srgb_texture ...) are understood under every config, through a space that both
  /// know.
  Color to_working(const Color& value, const std::string& space) const;
  Color from_working(const Color& value, const std::string& space) const;
  void to_working(Image& image, const std::string& space) const;  ///< first three channels, in place

  /// The space that a file rule of the config gives to this path; nullopt where only the default rule matches or the
  /// config (version 1) has no rules.
  std::optional<std::string> space_of_file(const std::string& path) const;

  /// Working space, scaled by 2^exposure_ev, to display code values in [0, 1]; alpha untouched.
  void to_display(Image& image, const std::string& display, const std::string& view, float exposure_ev) const;

  /// CIE xy of the working space's primaries and white as OpenEXR's `chromaticities` attribute wants them.
  struct Chromaticities {
    float red[2], green[2], blue[2], white[2];
  };
  /// By converting its primaries, never from its name; nullopt where the config does not tell what its light is.
  std::optional<Chromaticities> working_chromaticities() const;

  /// Relative luminance Y of the working space's three unit primaries (they add up to 1). AP0's blue is negative.
  Color luminance_weights() const;

  /// Linear RGB of a space given by its chromaticities (Bradford-adapted) to the working space.
  void chromaticities_to_working(Image& image, const Chromaticities& from) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sateen
