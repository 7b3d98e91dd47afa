// Memory that is kept from one point set to the next.
#pragma once

#include <cstddef>

namespace polylidar::detail {

/// Uninitialised memory of at least `bytes`, aligned for any of our types; in huge pages if it is large and
/// the system has them. Throws std::bad_alloc.
void* allocate(std::size_t bytes);
void release(void* memory, std::size_t bytes) noexcept;

/// An array that keeps its memory when it shrinks, since fresh memory costs more than sorting a point. It
/// never initialises its elements, so T must not need construction.
template <class T>
class Scratch {
 public:
  Scratch() = default;
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() { clear(); }

  /// Room for `size` elements whose values are undefined.
  T* reserve(std::size_t size) {
    if (size > capacity_) {
      clear();
      data_ = static_cast<T*>(allocate(size * sizeof(T)));
      capacity_ = size;
    }
    return data_;
  }
  T* data() { return data_; }
  const T* data() const { return data_; }

 private:
  void clear() noexcept {
    if (data_ != nullptr) release(data_, capacity_ * sizeof(T));
    data_ = nullptr;
    capacity_ = 0;
  }

  T* data_ = nullptr;
  std::size_t capacity_ = 0;
};

}  // namespace polylidar::detail
