#pragma once
#include <filesystem>

namespace sateen {

/// Goes over the chunks of a PNG file, for its library writes what is wrong with them to the terminal: InputError
/// where the file ends before its last chunk or the check sum of one that matters is wrong. Files of other kinds
/// pass.
void check_png_chunks(const std::filesystem::path& path);

}  // namespace sateen
