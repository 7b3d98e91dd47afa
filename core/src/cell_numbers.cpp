#include "cell_numbers.hpp"

namespace polylidar::detail {

namespace {

[[gnu::always_inline]] inline void number(std::span<const Point> points, CellNumbering numbering,
                                          std::uint32_t* __restrict__ numbers) {
  for (std::size_t i = 0; i < points.size(); ++i) numbers[i] = numbering.of(points[i]);
}

// The same code three times, for what the compiler makes of it with wider registers.
void number_portably(std::span<const Point> points, const CellNumbering& numbering, std::uint32_t* numbers) {
  number(points, numbering, numbers);
}
#ifdef POLYLIDAR_X86_KERNELS
POLYLIDAR_AVX2 void number_with_avx2(std::span<const Point> points, const CellNumbering& numbering,
                                     std::uint32_t* numbers) {
  number(points, numbering, numbers);
}
POLYLIDAR_AVX512 void number_with_avx512(std::span<const Point> points, const CellNumbering& numbering,
                                         std::uint32_t* numbers) {
  number(points, numbering, numbers);
}
#endif

}  // namespace

void number_cells(std::span<const Point> points, const CellNumbering& numbering, std::uint32_t* numbers,
                  Kernel kernel) {
#ifdef POLYLIDAR_X86_KERNELS
  if (kernel == Kernel::kAvx512) return number_with_avx512(points, numbering, numbers);
  if (kernel == Kernel::kAvx2) return number_with_avx2(points, numbering, numbers);
#endif
  static_cast<void>(kernel);
  number_portably(points, numbering, numbers);
}

}  // namespace polylidar::detail
