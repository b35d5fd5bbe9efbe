#pragma once
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace sateen {

/// Calls again what a signal interrupted, a hundred times at most: what never gets through is to fail, not to hang.
template <class Call>
auto uninterrupted(const Call& call) {
  auto result = call();
  for (int tries = 0; result < 0 && errno == EINTR && tries < 100; ++tries) result = call();
  return result;
}

/// Bytes into a file that is there already, from its beginning. Every failed write and close throws OperationError
/// with the system's words: standard streams lose what their last flush says.
class FileWriter {
 public:
  explicit FileWriter(const std::filesystem::path& path);
  ~FileWriter();
  FileWriter(const FileWriter&) = delete;
  FileWriter& operator=(const FileWriter&) = delete;

  void write(const void* bytes, std::size_t count);
  std::uint64_t position() const { return position_; }
  void seek(std::uint64_t position);
  void close();

 private:
  void flush();

  int descriptor_ = -1;
  std::uint64_t position_ = 0, buffer_start_ = 0;
  std::vector<char> buffer_;
};

}  // namespace sateen
