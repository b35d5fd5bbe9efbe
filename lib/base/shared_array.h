#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace sateen {

/// Numbers that many hold and nobody changes once they are made: a copy is a few pointers, and reads as a vector
/// does.
template <class T>
class SharedArray {
 public:
  SharedArray() = default;

  /// New ones, `count` of them, as T() makes them; other copies keep what they have.
  std::span<T> make(std::size_t count) {
    owner_ = std::make_shared<std::vector<T>>(count);
    data_ = owner_->data();
    size_ = count;
    return *owner_;
  }
  /// To fill what make() made; while it is shared it is copied first.
  std::span<T> edit() {
    if (owner_ && owner_.use_count() > 1) {
      owner_ = std::make_shared<std::vector<T>>(*owner_);
      data_ = owner_->data();
    }
    return {owner_ ? owner_->data() : nullptr, size_};
  }

  const T& operator[](std::size_t i) const { return data_[i]; }
  const T* data() const { return data_; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

 private:
  std::shared_ptr<std::vector<T>> owner_;
  const T* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace sateen
