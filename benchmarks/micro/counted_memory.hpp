// How much memory a call takes: the whole program's operator new and delete, counted while somebody asks.
#pragma once

#include <cstdint>

namespace hullbench::micro {

/// Counts, from its construction to its destruction, the bytes that the process (all its threads and
/// libraries) holds through operator new beyond those it held before; as malloc_usable_size counts them, so
/// without malloc's own header of 8 bytes a block. Memory from malloc or mmap is not seen, stacks are not
/// either. One at a time. While there is none, an allocation costs one well predicted branch more.
class CountedMemory {
 public:
  CountedMemory();
  ~CountedMemory();
  CountedMemory(const CountedMemory&) = delete;
  CountedMemory& operator=(const CountedMemory&) = delete;

  /// The most bytes held at one time so far; >= 0.
  std::int64_t peak() const;
};

}  // namespace hullbench::micro
