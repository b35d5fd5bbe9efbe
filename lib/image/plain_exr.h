#pragma once
#include <filesystem>
#include <optional>

#include "image/file.h"

namespace sateen {

/// Reads an OpenEXR file of the plainest kind by OpenEXR alone, which is linked in: one flat part, channels Y or
/// R, G, B with or without A, all half or all float, not subsampled, the data window that of the picture. The same
/// pixels and info as by the module, whose loading costs more than most maps. Empty for every other file, for one
/// beyond `limits` and where OpenEXR fails: the module then reads it, or says what is wrong.
std::optional<Image> read_plain_exr(const std::filesystem::path& path, const ImageLimits& limits,
                                    ImageFileInfo* info);

}  // namespace sateen
