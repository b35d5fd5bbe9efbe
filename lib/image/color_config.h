#pragma once
#include <OpenColorIO/OpenColorIO.h>

#include <string>
#include <vector>

#include "base/error.h"

namespace sateen {

// For image/color.cpp alone: OpenColorIO's headers go no further.

std::string first_line(const std::string& text);

/// Every call into OpenColorIO may throw its own exception; the sentence in front is ours.
template <class Call>
auto guarded(const std::string& what, Call&& call) {
  try {
    return call();
  } catch (const OCIO_NAMESPACE::Exception& error) {
    throw InputError(what + " (OpenColorIO: " + first_line(error.what()) + ")", {}, InputError::Kind::unreadable);
  }
}

/// Reads a config; `origin` says who named it ("--ocio"). What OpenColorIO's own check finds wrong is a warning: most
/// of a config is used by no picture, and what one uses is built, and fails, before it is rendered. InputError
/// (unreadable) where there is no such file, it is no config, or it has no scene_linear.
OCIO_NAMESPACE::ConstConfigRcPtr read_color_config(const std::string& path, const std::string& origin,
                                                   std::vector<std::string>& warnings);

/// Rings in a config, each as "a -> the look b -> a": names in transforms that lead back to themselves, through
/// colour spaces, named transforms, looks, view transforms and views. OpenColorIO would follow them without end, so
/// nothing may be built that leads into one. Chains that are too long or fork too often to be followed count as well.
std::vector<std::string> reference_rings(const OCIO_NAMESPACE::Config& config);

/// The ring that a conversion, or a view, leads into; empty where there is none.
std::string ring_between(const OCIO_NAMESPACE::Config& config, const std::string& from, const std::string& to);
std::string ring_of_view(const OCIO_NAMESPACE::Config& config, const std::string& from, const std::string& display,
                         const std::string& view);

/// The project's own; where a foreign config's XYZ has another white than D65, a space of it is added.
OCIO_NAMESPACE::ConfigRcPtr built_in_color_config();

/// Where the same light is known on both sides of a pair of configs: the project's own space and the foreign one.
struct Bridge {
  std::string own, foreign, how;
  bool known = true;  ///< false: it is an assumption
};

/// By the role aces_interchange; else by a space, or a role, with one of the names that ACES2065-1, ACEScg, linear
/// Rec.709 and CIE XYZ go by, if its light is proportional to scene_linear's; else assumed, with a warning. Known
/// spaces that contradict one another are a warning too.
Bridge find_bridge(const OCIO_NAMESPACE::Config& foreign, const std::string& file, OCIO_NAMESPACE::Config& own,
                   std::vector<std::string>& warnings);

}  // namespace sateen
