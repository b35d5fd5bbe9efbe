#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <fstream>
#include <mutex>

#include "base/error.h"
#include "base/file_identity.h"
#include "base/file_writer.h"
#include "base/files.h"

namespace sateen {

namespace fs = std::filesystem;

namespace {

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// A name that is being written to. It is locked as long as its writer lives, so that others can tell what was left
/// behind, also those that do not see the writer's process.
class Temporary {
 public:
  explicit Temporary(const fs::path& target);
  ~Temporary() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove(path_, ignored);
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  const fs::path& path() const { return path_; }
  void keep_mode_of(const struct stat& old) const;
  void sync() const;
  void rename_to(const fs::path& target);

 private:
  fs::path path_;
  int descriptor_ = -1;
};

/// ".name.": what names of temporaries begin with. The rest is the process, "-", a number, and the extension, which
/// stays last: image writers choose the format by it.
std::string beginning_of(const fs::path& target) {
  constexpr size_t longest = 200;  // of the 255 bytes that a name may have
  return fmt::format(".{}.", target.stem().string().substr(0, longest));
}

bool is_alive(int process) {
  return ::kill(process, 0) == 0 || errno != ESRCH;
}

/// The process in a temporary's name; 0 where the name is none of `target`.
int process_in(const std::string& name, const fs::path& target) {
  const std::string beginning = beginning_of(target), end = target.extension().string();
  if (name.size() <= beginning.size() + end.size() || !name.starts_with(beginning) || !name.ends_with(end)) return 0;
  const char *at = name.data() + beginning.size(), *const last = name.data() + name.size() - end.size();
  int process = 0, number = 0;
  const auto [dash, code] = std::from_chars(at, last, process);
  if (code != std::errc() || dash == last || *dash != '-' || process <= 0) return 0;
  const auto [rest, second] = std::from_chars(dash + 1, last, number);
  return second == std::errc() && rest == last && number >= 0 ? process : 0;
}

/// Removes what processes that are no more have left of `target`.
void sweep(const fs::path& target) {
  std::error_code code;
  for (fs::directory_iterator entry(folder_of(target), code), end; !code && entry != end; entry.increment(code)) {
    const int process = process_in(entry->path().filename().string(), target);
    // A number is given out anew, in a container soon: of one's own the lock tells.
    if (process == 0 || (process != ::getpid() && is_alive(process))) continue;
    const int descriptor = ::open(entry->path().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) continue;
    struct stat status {};
    std::error_code ignored;
    if (::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0)
      fs::remove(entry->path(), ignored);
    ::close(descriptor);
  }
}

Temporary::Temporary(const fs::path& target) {
  // Between a file's birth and its lock nobody of this process may sweep.
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  sweep(target);
  for (int attempt = 0; attempt < 1000; ++attempt) {
    const fs::path name = folder_of(target) / fmt::format("{}{}-{}{}", beginning_of(target), ::getpid(), attempt,
                                                          target.extension().string());
    descriptor_ = uninterrupted([&] { return ::open(name.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, 0666); });
    if (descriptor_ >= 0) {
      path_ = name;
      ::flock(descriptor_, LOCK_EX | LOCK_NB);  // where there are no locks nothing is swept either
      return;
    }
    if (errno != EEXIST) throw OperationError(fmt::format("cannot create a file here: {}", std::strerror(errno)));
  }
  throw OperationError("cannot find a free temporary name in this folder");
}

void Temporary::keep_mode_of(const struct stat& old) const {
  // Another's file stays theirs where that is allowed; where not, it has no rights that only its owner was to have.
  const bool owned = ::fchown(descriptor_, old.st_uid, old.st_gid) == 0;
  const mode_t mode = old.st_mode & (owned ? 07777u : 0777u);
  if (::fchmod(descriptor_, mode) != 0)
    throw OperationError(fmt::format("cannot keep its mode: {}", std::strerror(errno)));
}

void Temporary::sync() const {
  // EINVAL: some file systems have no fsync.
  if (uninterrupted([&] { return ::fsync(descriptor_); }) != 0 && errno != EINVAL)
    throw OperationError(fmt::format("cannot flush to disk: {}", std::strerror(errno)));
}

void Temporary::rename_to(const fs::path& target) {
  if (uninterrupted([&] { return ::rename(path_.c_str(), target.c_str()); }) != 0)
    throw OperationError(fmt::format("cannot be given its name: {}", std::strerror(errno)));
  path_.clear();
}

void sync_folder(const fs::path& folder) {
  const int descriptor = uninterrupted([&] { return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); });
  // A folder may be one to write to and not to read.
  if (descriptor < 0 && errno == EACCES) return;
  if (descriptor < 0) throw OperationError(std::strerror(errno));
  const int result = uninterrupted([&] { return ::fsync(descriptor); }), error = errno;
  ::close(descriptor);
  if (result != 0 && error != EINVAL) throw OperationError(std::strerror(error));
}

}  // namespace

void write_file_whole(const fs::path& path, const std::function<void(const fs::path&)>& write,
                      const std::function<void(const fs::path&)>& verify) {
  const char* state = "not written";
  try {
    const fs::path target = followed(path);
    struct stat old {};
    const bool there = ::stat(target.c_str(), &old) == 0;
    if (!there && errno == ELOOP) throw OperationError(std::strerror(ELOOP));
    if (there && !S_ISREG(old.st_mode)) throw OperationError("exists and is not a regular file");
    fs::create_directories(folder_of(target));
    Temporary temporary(target);
    write(temporary.path());
    if (verify) verify(temporary.path());
    if (there) temporary.keep_mode_of(old);
    temporary.sync();
    temporary.rename_to(target);
    state = "written, but its folder may not be on disk";
    sync_folder(folder_of(target));
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw OperationError(fmt::format("{}: not written: not enough memory", path.string()));
  } catch (const std::exception& error) {
    throw OperationError(fmt::format("{}: {}: {}", path.string(), state, error.what()));
  }
}

void write_text_whole(const fs::path& path, std::string_view text) {
  const auto write = [&](const fs::path& temporary) {
    FileWriter writer(temporary);
    writer.write(text.data(), text.size());
    writer.close();
  };
  write_file_whole(path, write, [&](const fs::path& temporary) {
    std::ifstream in(temporary, std::ios::binary);
    std::string back(text.size() + 1, '\0');
    in.read(back.data(), std::streamsize(back.size()));
    back.resize(size_t(in.gcount()));
    if (back != text) throw OperationError("the text read back differs from the one written");
  });
}

void try_to_write(const fs::path& path) {
  const fs::path target = followed(path);
  std::error_code code;
  fs::create_directories(folder_of(target), code);
  if (code) throw OperationError(fmt::format("its folder cannot be made: {}", code.message()));
  const Temporary temporary(target);
}

}  // namespace sateen
