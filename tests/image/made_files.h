#pragma once
#include <filesystem>
#include <string>

namespace sateen_test {

/// OpenEXR files of the shapes that other programs write. Pixel (x, y) of the display window holds R = x, G = y, B
/// = 2.
void write_windowed_exr(const std::filesystem::path& path, int width, int height, int left, int top, int data_width,
                        int data_height);
void write_tiled_exr(const std::filesystem::path& path, int width, int height, bool mipmapped);
void write_deep_exr(const std::filesystem::path& path, int width, int height);
/// A deep part first, then a flat one.
void write_multipart_exr(const std::filesystem::path& path, int width, int height);

void write_bytes(const std::filesystem::path& path, const std::string& bytes);
std::string read_bytes(const std::filesystem::path& path);

}  // namespace sateen_test
