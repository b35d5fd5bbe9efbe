#pragma once
#include <filesystem>

namespace sateen {

/// Goes over the attributes of an OpenEXR file's headers, which the libraries believe: one that claims two gigabytes is
/// given them, and filled for half a minute. InputError where an attribute is larger than what is left of the file.
/// Files of other kinds, and what only a decoder can tell, pass.
void check_exr_header(const std::filesystem::path& path);

}  // namespace sateen
