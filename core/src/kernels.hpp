// Loops that are compiled several times, for registers of different widths; which one runs is chosen at run
// time.
#pragma once

#include <cstddef>
#include <cstdint>

#if defined(__x86_64__) && defined(__GNUC__)
#define POLYLIDAR_X86_KERNELS
#define POLYLIDAR_AVX2 [[gnu::target("avx2")]]
// What makes a compiler use all of the 512 bits.
#ifdef __clang__
#define POLYLIDAR_AVX512 [[gnu::target("avx512f"), clang::min_vector_width(512)]]
#else
#define POLYLIDAR_AVX512 [[gnu::target("avx512f,prefer-vector-width=512")]]
#endif
#endif

namespace polylidar::detail {

/// What a loop is compiled for; all give the same result.
enum class Kernel : std::uint8_t { kPortable, kAvx2, kAvx512 };
/// Whether this processor and this build support it.
bool is_supported(Kernel kernel);
/// The fastest one that is supported.
Kernel best_kernel();

/// Coordinates of points that follow one another, for arithmetic on all at once.
template <std::size_t kCount>
struct Coordinates {
  using Vector [[gnu::vector_size(kCount * sizeof(double))]] = double;
};

}  // namespace polylidar::detail
