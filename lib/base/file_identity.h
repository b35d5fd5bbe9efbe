#pragma once
#include <filesystem>
#include <vector>

namespace sateen {

/// The path behind a symbolic link, also one that leads to nothing yet; `path` itself where it is none.
std::filesystem::path followed(std::filesystem::path path);

/// Whether two paths are one file: by device and inode where both are there (links, hard or symbolic, and spellings
/// do not matter), by where they would come to lie where neither is.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// Files whose content was read so far, as they were named, each once: looks and what they inherit from, drafts,
/// meshes, maps, textures. So that none of them is overwritten by what is made of them.
std::vector<std::filesystem::path> files_read();
/// Every reader of the library calls it.
void note_file_read(const std::filesystem::path& path);

}  // namespace sateen
