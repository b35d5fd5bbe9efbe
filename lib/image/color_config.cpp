#include "image/color_config.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "image/built_in_config.h"

namespace sateen {

namespace ocio = OCIO_NAMESPACE;

namespace {
constexpr int version_of_addresses = 0x02020000;  ///< from 2.2 on: "ocio://" names and .ocioz archives

[[noreturn]] void refuse(const std::string& message, const std::string& help) {
  throw InputError(message, help, InputError::Kind::unreadable);
}

void check_path(const std::string& path, const std::string& origin) {
  const bool address = path.rfind("ocio://", 0) == 0;
  const std::filesystem::path file = path;
  if ((address || file.extension() == ".ocioz") && ocio::GetVersionHex() < version_of_addresses)
    refuse(fmt::format("{} (named by {}): {} need OpenColorIO 2.2, this is {}", path, origin,
                       address ? "names that begin with ocio://" : "archives of configs", ocio::GetVersion()),
           address ? "give the path of a config.ocio, or leave it out to use the built-in config"
                   : "unpack it, it is a zip file, and give the path of its config.ocio");
  std::error_code code;
  if (!address && !std::filesystem::is_regular_file(file, code))
    refuse(fmt::format("{}: no such colour config (named by {})", path, origin),
           "give the path of an existing config.ocio, or leave it out to use the built-in config");
}
}  // namespace

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

ocio::ConfigRcPtr built_in_color_config() {
  std::istringstream text{std::string(built_in_config_text)};
  return ocio::Config::CreateFromStream(text)->createEditableCopy();
}

ocio::ConstConfigRcPtr read_color_config(const std::string& path, const std::string& origin,
                                         std::vector<std::string>& warnings) {
  check_path(path, origin);
  const ocio::ConstConfigRcPtr config =
      guarded(fmt::format("{}: the colour config named by {} is not usable", path, origin),
              [&] { return ocio::Config::CreateFromFile(path.c_str()); });
  if (!config->hasRole("scene_linear"))
    refuse(fmt::format("{}: has no role scene_linear, which every renderer needs", path),
           "add the line \"scene_linear: NAME\" to its roles, NAME being the linear space to render in");
  if (!config->getColorSpace("scene_linear"))
    refuse(fmt::format("{}: its role scene_linear names a colour space that it does not define", path), {});
  if (config->getNumDisplays() == 0) refuse(fmt::format("{}: has no display", path), {});
  for (const std::string& ring : reference_rings(*config))
    warnings.push_back(
        fmt::format("{}: names in this colour config lead back to themselves without end: {}; what leads there "
                    "cannot be used by a picture",
                    path, ring));
  try {
    config->validate();
  } catch (const ocio::Exception& error) {
    warnings.push_back(
        fmt::format("{}: a part of this colour config is faulty, and used only where a picture asks for "
                    "it (OpenColorIO: {})",
                    path, first_line(error.what())));
  }
  return config;
}

}  // namespace sateen
