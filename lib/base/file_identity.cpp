#include "base/file_identity.h"

#include <sys/stat.h>

#include <algorithm>
#include <mutex>

namespace sateen {

namespace fs = std::filesystem;

fs::path followed(fs::path path) {
  constexpr int most_links = 40;  // as many as Linux follows
  std::error_code code;
  for (int links = 0; links < most_links && fs::is_symlink(fs::symlink_status(path, code)); ++links) {
    const fs::path to = fs::read_symlink(path, code);
    if (code) break;
    path = to.is_absolute() ? to : path.parent_path() / to;
  }
  return path;
}

bool same_file(const fs::path& a, const fs::path& b) {
  struct stat one {
  }, other{};
  const bool a_there = ::stat(a.c_str(), &one) == 0, b_there = ::stat(b.c_str(), &other) == 0;
  if (a_there != b_there) return false;
  if (a_there) return one.st_dev == other.st_dev && one.st_ino == other.st_ino;
  std::error_code code;
  const auto place = [&](const fs::path& path) {
    return fs::weakly_canonical(fs::absolute(followed(path), code), code);
  };
  return place(a) == place(b);
}

namespace {
// The readers work side by side.
struct Noted {
  std::mutex mutex;
  std::vector<fs::path> paths;
};
Noted& noted() {
  static Noted all;
  return all;
}
}  // namespace

std::vector<fs::path> files_read() {
  const std::lock_guard lock(noted().mutex);
  return noted().paths;
}

void note_file_read(const fs::path& path) {
  const std::lock_guard lock(noted().mutex);
  auto& paths = noted().paths;
  if (std::find(paths.begin(), paths.end(), path) == paths.end()) paths.push_back(path);
}

}  // namespace sateen
