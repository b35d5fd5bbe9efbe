#pragma once
#include <filesystem>

namespace sateen {

/// What can be told without a reader: InputError for a file that is missing, a folder, not regular, empty, or text
/// that no kind of picture begins with.
void check_picture_file(const std::filesystem::path& path);

}  // namespace sateen
