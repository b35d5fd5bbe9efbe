#pragma once
#include <filesystem>
#include <string>

namespace sateen {

/// What to do about a file that is not there: the nearest name in its folder, or that the folder is missing; empty
/// where neither says anything. With `extension` (".obj") only such files are offered.
std::string missing_file_help(const std::filesystem::path& path, const std::string& extension = {});

}  // namespace sateen
