#include "cell_numbers.hpp"

namespace polylidar::detail {

namespace {

template <class Number>
[[gnu::always_inline]] inline void number(std::span<const Point> points, Numbering<Number> numbering,
                                          Number* __restrict__ numbers) {
  for (std::size_t i = 0; i < points.size(); ++i) numbers[i] = numbering.of(points[i]);
}

[[gnu::always_inline]] inline bool find_near_border(std::span<const Point> points, CellNumbering numbering) {
  unsigned found = 0;
  for (const Point& p : points) {
    found |= is_near_border(numbering.column(p)) ? 1U : 0U;
    found |= is_near_border(numbering.row(p)) ? 1U : 0U;
  }
  return found != 0;
}

// The same code three times, for what the compiler makes of it with wider registers.
template <class Number>
void number_portably(std::span<const Point> points, const Numbering<Number>& numbering, Number* numbers) {
  number(points, numbering, numbers);
}
bool find_near_border_portably(std::span<const Point> points, const CellNumbering& numbering) {
  return find_near_border(points, numbering);
}
#ifdef POLYLIDAR_X86_KERNELS
POLYLIDAR_AVX2 bool find_near_border_with_avx2(std::span<const Point> points,
                                               const CellNumbering& numbering) {
  return find_near_border(points, numbering);
}
POLYLIDAR_AVX512 bool find_near_border_with_avx512(std::span<const Point> points,
                                                   const CellNumbering& numbering) {
  return find_near_border(points, numbering);
}
template <class Number>
POLYLIDAR_AVX2 void number_with_avx2(std::span<const Point> points, const Numbering<Number>& numbering,
                                     Number* numbers) {
  number(points, numbering, numbers);
}
template <class Number>
POLYLIDAR_AVX512 void number_with_avx512(std::span<const Point> points, const Numbering<Number>& numbering,
                                         Number* numbers) {
  number(points, numbering, numbers);
}
#endif

template <class Number>
void number_by(Kernel kernel, std::span<const Point> points, const Numbering<Number>& numbering,
               Number* numbers) {
#ifdef POLYLIDAR_X86_KERNELS
  if (kernel == Kernel::kAvx512) return number_with_avx512(points, numbering, numbers);
  if (kernel == Kernel::kAvx2) return number_with_avx2(points, numbering, numbers);
#endif
  static_cast<void>(kernel);
  number_portably(points, numbering, numbers);
}

}  // namespace

void number_cells(std::span<const Point> points, const CellNumbering& numbering, std::uint32_t* numbers,
                  Kernel kernel) {
  number_by(kernel, points, numbering, numbers);
}
void number_cells(std::span<const Point> points, const WideNumbering& numbering, std::uint64_t* numbers,
                  Kernel kernel) {
  number_by(kernel, points, numbering, numbers);
}

bool any_near_border(std::span<const Point> points, const CellNumbering& numbering, Kernel kernel) {
#ifdef POLYLIDAR_X86_KERNELS
  if (kernel == Kernel::kAvx512) return find_near_border_with_avx512(points, numbering);
  if (kernel == Kernel::kAvx2) return find_near_border_with_avx2(points, numbering);
#endif
  static_cast<void>(kernel);
  return find_near_border_portably(points, numbering);
}

}  // namespace polylidar::detail
