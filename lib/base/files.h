#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace sateen {

/// The whole of a regular file. InputError (unreadable) when it is missing, not a regular file, or above `limit`
/// bytes.
std::string read_text_file(const std::filesystem::path& path, std::uint64_t limit_bytes);

/// Writes a file whole or not at all: `write` fills a temporary name in the same folder (same extension), `verify`
/// reads it back and throws if it is not what was meant; then fsync, rename, fsync of the folder. On any failure
/// the temporary is removed, the old file stays, and OperationError names the path and the cause. A symbolic link
/// stays one, and a file that was there keeps its mode. Temporaries of `path` that processes left behind that are no
/// more are removed.
void write_file_whole(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path& temporary)>& write,
                      const std::function<void(const std::filesystem::path& temporary)>& verify = {});

/// The same for text held in memory.
void write_text_whole(const std::filesystem::path& path, std::string_view text);

/// Whether write_file_whole() could begin: makes the folder where it is missing, and a file in it that goes again.
/// OperationError with the cause, without the path.
void try_to_write(const std::filesystem::path& path);

/// Folder that holds looks/, envmaps/ and ocio/: beside the installed program (../share/sateen) or the source
/// tree that the program was built from. $SATEEN_HOME wins.
std::filesystem::path data_folder();

/// FNV-1a, 64 bit: the hash of looks, meshes, maps and jobs. Not cryptographic.
struct Hash {
  std::uint64_t value = 0xcbf29ce484222325ull;
  Hash& add(std::string_view bytes);
  Hash& add_bytes(const void* data, std::size_t size);
  std::string hex() const;  ///< 16 lower-case digits
};

}  // namespace sateen
