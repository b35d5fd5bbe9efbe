#pragma once
#include <OpenImageIO/filesystem.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "base/error.h"
#include "base/file_writer.h"

namespace sateen {

/// What OpenImageIO writes goes to a file by our own writer. Libraries that are told of a full disk answer each in
/// their own way (libjpeg ends the program), so they are told that all is well, and finish() says what was not.
class CheckedProxy : public OIIO::Filesystem::IOProxy {
 public:
  explicit CheckedProxy(const std::filesystem::path& path) : IOProxy(path.string(), Write), writer_(path) {}
  const char* proxytype() const override { return "checked"; }
  bool seek(std::int64_t offset) override {
    attempt([&] { writer_.seek(std::uint64_t(offset)); });
    m_pos = offset;
    return true;
  }
  std::size_t write(const void* bytes, std::size_t count) override {
    attempt([&] { writer_.write(bytes, count); });
    m_pos += std::int64_t(count);
    size_ = std::max(size_, std::size_t(m_pos));
    return count;
  }
  std::size_t size() const override { return size_; }

  /// OperationError with the system's words where anything was not written.
  void finish() {
    attempt([&] { writer_.close(); });
    if (!failure_.empty()) throw OperationError(failure_);
  }

 private:
  template <class Call>
  void attempt(const Call& call) {
    if (!failure_.empty()) return;
    try {
      call();
    } catch (const OperationError& error) {
      failure_ = error.what();
    }
  }

  FileWriter writer_;
  std::size_t size_ = 0;
  std::string failure_;
};

}  // namespace sateen
