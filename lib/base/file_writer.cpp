#include "base/file_writer.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.h"

namespace sateen {

namespace {
constexpr std::size_t buffer_bytes = 1u << 20;

[[noreturn]] void fail(int error) {
  throw OperationError(std::strerror(error));
}
}  // namespace

FileWriter::FileWriter(const std::filesystem::path& path) {
  descriptor_ = uninterrupted([&] { return ::open(path.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC); });
  if (descriptor_ < 0) fail(errno);
}

FileWriter::~FileWriter() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void FileWriter::write(const void* bytes, std::size_t count) {
  const char* from = static_cast<const char*>(bytes);
  while (count > 0) {
    if (buffer_.size() >= buffer_bytes) flush();
    const std::size_t now = std::min(count, buffer_bytes - buffer_.size());
    buffer_.insert(buffer_.end(), from, from + now);
    from += now;
    count -= now;
    position_ += now;
  }
}

void FileWriter::seek(std::uint64_t position) {
  flush();
  position_ = buffer_start_ = position;
}

void FileWriter::flush() {
  std::size_t done = 0;
  while (done < buffer_.size()) {
    const ssize_t wrote = uninterrupted([&] {
      return ::pwrite(descriptor_, buffer_.data() + done, buffer_.size() - done, off_t(buffer_start_ + done));
    });
    if (wrote <= 0) fail(wrote < 0 ? errno : EIO);
    done += std::size_t(wrote);
  }
  buffer_start_ += buffer_.size();
  buffer_.clear();
}

void FileWriter::close() {
  flush();
  const int result = ::close(descriptor_);
  descriptor_ = -1;
  // Interrupted, Linux has closed it all the same; what is on disk is a question to fsync.
  if (result != 0 && errno != EINTR) fail(errno);
}

}  // namespace sateen
