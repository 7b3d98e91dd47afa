#include "near_points.hpp"

#include <cstring>

namespace polylidar::detail {

namespace {

/// Puts the sums of the pairs of coordinates in `a` and `b` into `sums`, in some order. (What a function
/// returns such a vector in depends on the registers that it is compiled for.)
template <std::size_t kCount, class Vector>
[[gnu::always_inline]] inline void add_pairs(const Vector& a, const Vector& b, Vector& sums) {
  // No coordinate moves from one 128 bits of a register to others.
  if constexpr (kCount == 2) {
    sums = __builtin_shufflevector(a, b, 0, 2) + __builtin_shufflevector(a, b, 1, 3);
  } else if constexpr (kCount == 4) {
    sums = __builtin_shufflevector(a, b, 0, 4, 2, 6) + __builtin_shufflevector(a, b, 1, 5, 3, 7);
  } else {
    static_assert(kCount == 8);
    sums = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14) +
           __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
  }
}

/// Of a whole block: whether some point is near. Vectors hold the coordinates of kCount / 2 points.
template <std::size_t kCount>
[[gnu::always_inline]] inline bool is_any_near(const Point* block, const Point& centre,
                                               double squared_radius) {
  using Vector = typename Coordinates<kCount>::Vector;
  constexpr std::size_t kPoints = kCount / 2;
  Vector middle;
  for (std::size_t k = 0; k < kCount; k += 2) {
    middle[k] = centre.x;
    middle[k + 1] = centre.y;
  }
  Vector least = Vector{} + squared_radius;
  for (std::size_t i = 0; i < kNearBlock; i += 2 * kPoints) {
    Vector first;
    Vector second;
    std::memcpy(&first, block + i, sizeof first);
    std::memcpy(&second, block + i + kPoints, sizeof second);
    first = middle - first;
    second = middle - second;
    Vector squared;
    add_pairs<kCount, Vector>(first * first, second * second, squared);
    least = squared < least ? squared : least;
  }
  const auto is_less = least < squared_radius;
  long long any = 0;
  for (std::size_t k = 0; k < kCount; ++k) any |= is_less[k];
  return any != 0;
}

template <std::size_t kCount>
[[gnu::always_inline]] inline std::size_t find(std::span<const Point> points, std::size_t begin,
                                               const Point& centre, double squared_radius) {
  while (begin + kNearBlock <= points.size() &&
         !is_any_near<kCount>(&points[begin], centre, squared_radius)) {
    begin += kNearBlock;
  }
  return begin;
}

// The same code three times, for registers of different widths.
std::size_t find_portably(std::span<const Point> points, std::size_t begin, const Point& centre,
                          double squared_radius) {
  return find<2>(points, begin, centre, squared_radius);
}
#ifdef POLYLIDAR_X86_KERNELS
POLYLIDAR_AVX2 std::size_t find_with_avx2(std::span<const Point> points, std::size_t begin,
                                          const Point& centre, double squared_radius) {
  return find<4>(points, begin, centre, squared_radius);
}
POLYLIDAR_AVX512 std::size_t find_with_avx512(std::span<const Point> points, std::size_t begin,
                                              const Point& centre, double squared_radius) {
  return find<8>(points, begin, centre, squared_radius);
}
#endif

}  // namespace

std::size_t next_block_near(std::span<const Point> points, std::size_t begin, const Point& centre,
                            double squared_radius, Kernel kernel) {
#ifdef POLYLIDAR_X86_KERNELS
  if (kernel == Kernel::kAvx512) return find_with_avx512(points, begin, centre, squared_radius);
  if (kernel == Kernel::kAvx2) return find_with_avx2(points, begin, centre, squared_radius);
#endif
  static_cast<void>(kernel);
  return find_portably(points, begin, centre, squared_radius);
}

}  // namespace polylidar::detail
