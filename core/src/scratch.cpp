#include "scratch.hpp"

#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace polylidar::detail {

namespace {

constexpr std::size_t kHugePage = std::size_t{1} << 21U;
constexpr std::align_val_t kHugeAlignment{kHugePage};

bool is_large(std::size_t bytes) {
  return bytes >= 2 * kHugePage;
}

}  // namespace

void* allocate(std::size_t bytes) {
  if (!is_large(bytes)) return ::operator new(bytes);
  void* memory = ::operator new(bytes, kHugeAlignment);
#ifdef __linux__
  madvise(memory, bytes, MADV_HUGEPAGE);  // advice: where it is not taken, nothing is lost but time
#endif
  return memory;
}

void release(void* memory, std::size_t bytes) noexcept {
  if (is_large(bytes)) {
    ::operator delete(memory, kHugeAlignment);
  } else {
    ::operator delete(memory);
  }
}

}  // namespace polylidar::detail
