#include "base/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "base/error.h"
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
  return text;
}

namespace {
void sync_path(const fs::path& path, int flags) {
  const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC);
  if (descriptor < 0) throw OperationError(fmt::format("cannot open: {}", std::strerror(errno)));
  const int result = ::fsync(descriptor);
  const int error = errno;
  ::close(descriptor);
  // Some file systems refuse fsync on a folder; the rename itself has then been done as well as can be.
  if (result != 0 && error != EINVAL && error != EROFS)
    throw OperationError(fmt::format("cannot flush to disk: {}", std::strerror(error)));
}

fs::path reserve_temporary(const fs::path& path) {
  // The extension stays last: image writers choose the format by it.
  for (int attempt = 0; attempt < 1000; ++attempt) {
    fs::path name = path;
    name.replace_filename(
        fmt::format(".{}.{}-{}{}", path.stem().string(), ::getpid(), attempt, path.extension().string()));
    const int descriptor = ::open(name.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor >= 0) {
      ::close(descriptor);
      return name;
    }
    if (errno != EEXIST) throw OperationError(fmt::format("cannot create a file here: {}", std::strerror(errno)));
  }
  throw OperationError("cannot find a free temporary name in this folder");
}
}  // namespace

void write_file_whole(const fs::path& path, const std::function<void(const fs::path&)>& write,
                      const std::function<void(const fs::path&)>& verify) {
  fs::path temporary;
  try {
    std::error_code code;
    if (const fs::file_status status = fs::status(path, code); fs::exists(status) && !fs::is_regular_file(status))
      throw OperationError("exists and is not a regular file");
    if (path.has_parent_path()) fs::create_directories(path.parent_path());
    temporary = reserve_temporary(path);
    write(temporary);
    if (verify) verify(temporary);
    sync_path(temporary, O_RDONLY);
    fs::rename(temporary, path);
    temporary.clear();
    sync_path(path.has_parent_path() ? path.parent_path() : fs::path("."), O_RDONLY | O_DIRECTORY);
  } catch (const InputError&) {
    std::error_code ignored;
    if (!temporary.empty()) fs::remove(temporary, ignored);
    throw;
  } catch (const std::exception& error) {
    std::error_code ignored;
    if (!temporary.empty()) fs::remove(temporary, ignored);
    throw OperationError(fmt::format("{}: not written: {}", path.string(), error.what()));
  }
}

void write_text_whole(const fs::path& path, std::string_view text) {
  write_file_whole(path, [&](const fs::path& temporary) {
    const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
    if (descriptor < 0) throw OperationError(std::strerror(errno));
    std::string_view left = text;
    while (!left.empty()) {
      const ssize_t wrote = ::write(descriptor, left.data(), left.size());
      if (wrote < 0 && errno == EINTR) continue;
      if (wrote <= 0) {
        const int error = wrote < 0 ? errno : EIO;
        ::close(descriptor);
        throw OperationError(std::strerror(error));
      }
      left.remove_prefix(size_t(wrote));
    }
    if (::close(descriptor) != 0) throw OperationError(std::strerror(errno));
  });
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
