#include "benchmarks/micro/counted_memory.hpp"

#include <malloc.h>

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace hullbench::micro {
namespace {

std::atomic<bool> counting = false;
/// Bytes allocated less bytes freed since counting began; below 0 when older blocks are freed.
std::atomic<std::int64_t> live = 0;
std::atomic<std::int64_t> most = 0;

void count_allocation(void* block) {
  const auto size = static_cast<std::int64_t>(malloc_usable_size(block));
  const std::int64_t now = live.fetch_add(size) + size;
  std::int64_t before = most.load();
  while (before < now && !most.compare_exchange_weak(before, now)) {
  }
}

void* try_allocate(std::size_t size, std::size_t alignment) {
  if (alignment <= __STDCPP_DEFAULT_NEW_ALIGNMENT__) return std::malloc(size == 0 ? 1 : size);
  void* block = nullptr;
  return posix_memalign(&block, alignment, size) == 0 ? block : nullptr;
}

/// What the standard asks of operator new: the new handler is called until there is memory or no handler.
void* allocate(std::size_t size, std::size_t alignment = __STDCPP_DEFAULT_NEW_ALIGNMENT__) {
  while (true) {
    if (void* block = try_allocate(size, alignment)) {
      if (counting.load(std::memory_order_relaxed)) [[unlikely]]
        count_allocation(block);
      return block;
    }
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

void release(void* block) noexcept {
  if (counting.load(std::memory_order_relaxed)) [[unlikely]] {
    live.fetch_sub(static_cast<std::int64_t>(malloc_usable_size(block)));
  }
  std::free(block);
}

}  // namespace

CountedMemory::CountedMemory() {
  live = 0;
  most = 0;
  counting = true;
}

CountedMemory::~CountedMemory() {
  counting = false;
}

std::int64_t CountedMemory::peak() const {
  return most;
}

}  // namespace hullbench::micro

// By [new.delete] the forms for arrays and those that do not throw call these.
void* operator new(std::size_t size) {
  return hullbench::micro::allocate(size);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return hullbench::micro::allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* block) noexcept {
  hullbench::micro::release(block);
}
void operator delete(void* block, std::size_t) noexcept {
  hullbench::micro::release(block);
}
void operator delete(void* block, std::align_val_t) noexcept {
  hullbench::micro::release(block);
}
void operator delete(void* block, std::size_t, std::align_val_t) noexcept {
  hullbench::micro::release(block);
}
