#include "base/files.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "base/error.h"
#include "base/file_identity.h"
#include "base/missing_file.h"

namespace sateen {

namespace fs = std::filesystem;

std::string read_text_file(const fs::path& path, std::uint64_t limit) {
  const auto fail = [&](const std::string& message, const std::string& help = {}) {
    throw InputError(fmt::format("{}: {}", path.string(), message), help, InputError::Kind::unreadable);
  };
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (status.type() == fs::file_type::not_found) fail("no such file", missing_file_help(path));
  if (code) fail(code.message());
  if (status.type() == fs::file_type::directory) fail("is a folder, expected a file");
  if (status.type() != fs::file_type::regular) fail("is not a regular file");
  const std::uint64_t size = fs::file_size(path, code);
  if (code) fail(code.message());
  if (size > limit) fail(fmt::format("is {} bytes, expected at most {}", size, limit));
  std::ifstream in(path, std::ios::binary);
  if (!in) fail(std::strerror(errno));
  std::string text(size, '\0');
  in.read(text.data(), std::streamsize(size));
  if (std::uint64_t(in.gcount()) != size) fail("could not be read to its end");
  note_file_read(path);
  return text;
}

fs::path data_folder() {
  if (const char* home = std::getenv("SATEEN_HOME"); home && *home) return home;
  std::error_code code;
  const fs::path program = fs::read_symlink("/proc/self/exe", code);
  if (!code)
    // build/bin/sateen and build/bin/tests stand two folders below the source tree; an installed one beside share.
    for (const fs::path& relative : {fs::path("../share/sateen"), fs::path("../.."), fs::path("..")}) {
      const fs::path folder = fs::weakly_canonical(program.parent_path() / relative, code);
      if (!code && fs::is_directory(folder / "looks", code)) return folder;
    }
  throw InputError("the folder with looks/ and envmaps/ was not found beside the program",
                   "set SATEEN_HOME to the folder that holds them", InputError::Kind::unreadable);
}

Hash& Hash::add_bytes(const void* data, std::size_t size) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < size; ++i) value = (value ^ bytes[i]) * 0x100000001b3ull;
  return *this;
}

Hash& Hash::add(std::string_view bytes) {
  return add_bytes(bytes.data(), bytes.size());
}

std::string Hash::hex() const {
  return fmt::format("{:016x}", value);
}

}  // namespace sateen
