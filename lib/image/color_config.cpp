#include "image/color_config.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <sstream>

#include "base/files.h"
#include "base/nearest_name.h"
#include "base/printable.h"
#include "image/built_in_config.h"

namespace sateen {

namespace ocio = OCIO_NAMESPACE;

namespace {
constexpr std::uint64_t most_text = 64 << 20;
constexpr const char* expected_file = "give the path of a config.ocio, or leave it out to use the built-in config";
constexpr int version_of_addresses = 0x02020000;  ///< from 2.2 on: "ocio://" names and .ocioz archives

[[noreturn]] void refuse(const std::string& message, const std::string& help) {
  throw InputError(message, help, InputError::Kind::unreadable);
}

bool is_address(const std::string& path) {
  return path.rfind("ocio://", 0) == 0;
}
bool is_text_file(const std::string& path) {
  return !is_address(path) && std::filesystem::path(path).extension() != ".ocioz";
}

void check_path(const std::string& path, const std::string& origin) {
  const bool address = is_address(path);
  const std::filesystem::path file = path;
  if ((address || file.extension() == ".ocioz") && ocio::GetVersionHex() < version_of_addresses)
    refuse(fmt::format("{} (named by {}): {} need OpenColorIO 2.2, this is {}", path, origin,
                       address ? "names that begin with ocio://" : "archives of configs", ocio::GetVersion()),
           address ? expected_file : "unpack it, it is a zip file, and give the path of its config.ocio");
  std::error_code code;
  if (!address && !std::filesystem::is_regular_file(file, code))
    refuse(fmt::format("{}: no such colour config (named by {})", path, origin),
           "give the path of an existing config.ocio, or leave it out to use the built-in config");
}
/// What is told by the file's own words, before OpenColorIO tells it in those of its parsers.
void check_text(const std::string& path) {
  const std::string text = read_text_file(path, most_text);
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    refuse(fmt::format("{}: is empty, expected a colour config", path), expected_file);
  std::smatch found;
  static const std::regex version(R"re(ocio_profile_version["']?\s*:\s*["']?([^\s"',}#]*))re");
  if (!std::regex_search(text, found, version))
    refuse(fmt::format("{}: is no colour config: it has no line ocio_profile_version", path), expected_file);
  const std::string given = found[1];
  static const std::regex number(R"((\d{1,3})(\.(\d{1,3}))?)");
  std::smatch parts;
  const std::string wanted = fmt::format("OpenColorIO {} reads 1 to {}.{}", ocio::GetVersion(),
                                         ocio::GetVersionHex() >> 24, ocio::GetVersionHex() >> 16 & 255);
  const bool known = std::regex_match(given, parts, number);
  const int major = known ? std::stoi(parts[1]) : 0, minor = known && parts[3].matched ? std::stoi(parts[3]) : 0;
  if (major < 1 || (major << 8 | minor) > int(ocio::GetVersionHex() >> 16))
    refuse(fmt::format("{}: its ocio_profile_version is {:.40}, and {}", path, printable(given), wanted),
           "config writers can be told which version to write");
}

/// OpenColorIO's refusal without its preface, at the line that it names.
[[noreturn]] void refuse_words(const std::string& path, const std::string& origin, std::string text) {
  static const std::regex preface("^Error: Loading the OCIO profile '.*' failed\\. ");
  static const std::regex place(
      "^(?:yaml-cpp: error at|At) line (\\d{1,9})(?:, column (\\d{1,9}))?(?:, '.*' parsing failed)?: ");
  text = std::regex_replace(first_line(text), preface, "");
  Diagnostic d;
  d.file = path;
  std::smatch found;
  if (std::regex_search(text, found, place)) {
    if (found[2].matched) {
      d.line = std::stoi(found[1]);
      d.column = std::stoi(found[2]);
    } else {
      d.file += ":" + found[1].str();
    }
    text = std::string(found.suffix());
  }
  while (!text.empty() && (text.back() == '.' || text.back() == ' ')) text.pop_back();
  d.message = fmt::format("the colour config named by {} is not usable (OpenColorIO: {})", origin, printable(text));
  throw InputError(InputError::Kind::unreadable, {d});
}

std::string space_of_role(const ocio::Config& config, const std::string& role) {
  for (int i = 0; i < config.getNumRoles(); ++i)
    if (config.getRoleName(i) == role) return config.getRoleColorSpace(i);
  return {};
}

std::vector<std::string> spaces_of(const ocio::Config& config) {
  std::vector<std::string> names;
  for (int i = 0; i < config.getNumColorSpaces(); ++i) names.emplace_back(config.getColorSpaceNameByIndex(i));
  return names;
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
  if (is_text_file(path)) check_text(path);
  ocio::ConstConfigRcPtr config;
  try {
    config = ocio::Config::CreateFromFile(path.c_str());
  } catch (const ocio::Exception& error) {
    refuse_words(path, origin, error.what());
  }
  if (!config->hasRole("scene_linear"))
    refuse(fmt::format("{}: has no role scene_linear, which every renderer needs", path),
           "add the line \"scene_linear: NAME\" to its roles, NAME being the linear space to render in");
  if (!config->getColorSpace("scene_linear"))
    refuse(fmt::format("{}: its role scene_linear names the colour space {:.80}, which it does not define", path,
                       space_of_role(*config, "scene_linear")),
           suggestion(space_of_role(*config, "scene_linear"), spaces_of(*config)));
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
