#include "coordinate_range.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace polylidar::detail {

namespace {

// Coordinates between these magnitudes keep every product of the predicates (degree 4) and of the filter
// (degree 6) away from overflow, and its last bit away from underflow: (2^151)^6 < 2^1024 and (2^(-116 -
// 52))^6 > 2^-1022.
constexpr int kLargestExponent = 150;
constexpr int kSmallestExponent = -116;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Magnitudes {
  Box box{{kInfinity, kInfinity}, {-kInfinity, -kInfinity}};
  double largest = 0;           ///< greatest magnitude of a coordinate
  double smallest = kInfinity;  ///< least magnitude of one that is not zero
  double poison = 0;            ///< NaN where a coordinate is not finite

  void add(const Magnitudes& other) {
    box = joined(box, other.box);
    largest = std::max(largest, other.largest);
    smallest = std::min(smallest, other.smallest);
    poison += other.poison;
  }
};

/// As many points as fill whole vectors of kCount coordinates.
template <std::size_t kCount>
[[gnu::always_inline]] inline void measure_vectors(std::span<const Point> points, Magnitudes& result) {
  using Vector = typename Coordinates<kCount>::Vector;
  static_assert(sizeof(Point) == 2 * sizeof(double) && kCount % 2 == 0);
  const Vector infinity = Vector{} + kInfinity;
  Vector least = infinity;
  Vector greatest = -infinity;
  Vector smallest = infinity;
  Vector poison{};
  for (std::size_t i = 0; i < points.size(); i += kCount / 2) {
    Vector v;
    std::memcpy(&v, &points[i], sizeof v);
    const Vector magnitude = v < 0 ? -v : v;
    const Vector not_zero = magnitude == 0 ? infinity : magnitude;
    poison += v * 0;
    least = v < least ? v : least;
    greatest = v > greatest ? v : greatest;
    smallest = not_zero < smallest ? not_zero : smallest;
  }
  for (std::size_t k = 0; k < kCount; k += 2) {
    Magnitudes lane;
    lane.box = {{least[k], least[k + 1]}, {greatest[k], greatest[k + 1]}};
    lane.smallest = std::min(smallest[k], smallest[k + 1]);
    lane.poison = poison[k] + poison[k + 1];
    result.add(lane);
  }
}

/// Of as many points.
template <std::size_t kCount>
[[gnu::always_inline]] inline bool are_vectors_within(std::span<const Point> points, const Box& box) {
  using Vector = typename Coordinates<kCount>::Vector;
  Vector least;
  Vector greatest;
  for (std::size_t k = 0; k < kCount; k += 2) {
    least[k] = box.min.x;
    least[k + 1] = box.min.y;
    greatest[k] = box.max.x;
    greatest[k + 1] = box.max.y;
  }
  auto within = Vector{} == 0;
  for (std::size_t i = 0; i < points.size(); i += kCount / 2) {
    Vector v;
    std::memcpy(&v, &points[i], sizeof v);
    within &= (v >= least) & (v <= greatest);
  }
  long long all = -1;
  for (std::size_t k = 0; k < kCount; ++k) all &= within[k];
  return all != 0;
}

// The same code three times, for registers of different widths.
constexpr std::size_t kMostCoordinates = 8;
void measure_portably(std::span<const Point> points, Magnitudes& result) {
  measure_vectors<2>(points, result);
}
bool are_within_portably(std::span<const Point> points, const Box& box) {
  return are_vectors_within<2>(points, box);
}
#ifdef POLYLIDAR_X86_KERNELS
POLYLIDAR_AVX2 void measure_with_avx2(std::span<const Point> points, Magnitudes& result) {
  measure_vectors<4>(points, result);
}
POLYLIDAR_AVX512 void measure_with_avx512(std::span<const Point> points, Magnitudes& result) {
  measure_vectors<kMostCoordinates>(points, result);
}
POLYLIDAR_AVX2 bool are_within_with_avx2(std::span<const Point> points, const Box& box) {
  return are_vectors_within<4>(points, box);
}
#endif

Magnitudes measure(std::span<const Point> points, Kernel kernel) {
  Magnitudes result;
  const std::size_t in_vectors = points.size() - points.size() % (kMostCoordinates / 2);
#ifdef POLYLIDAR_X86_KERNELS
  if (kernel == Kernel::kAvx512) measure_with_avx512(points.first(in_vectors), result);
  if (kernel == Kernel::kAvx2) measure_with_avx2(points.first(in_vectors), result);
#endif
  measure_portably(kernel == Kernel::kPortable ? points : points.subspan(in_vectors), result);
  if (points.empty()) return result;
  for (const double c : {result.box.min.x, result.box.min.y, result.box.max.x, result.box.max.y}) {
    result.largest = std::max(result.largest, std::abs(c));
  }
  return result;
}

/// value(part) of every part of `points`, in their order.
template <class Value>
auto of_each_chunk(std::span<const Point> points, ThreadPool& pool, const Value& value) {
  const Chunks chunks(pool, points.size());
  std::vector<decltype(value(points))> values(chunks.size());
  pool.for_each(chunks.size(), [&](std::size_t i) {
    values[i] = value(points.subspan(chunks.begin(i), chunks.end(i) - chunks.begin(i)));
  });
  return values;
}

int choose_scale(const Magnitudes& magnitudes) {
  if (magnitudes.largest == 0) return 0;
  const int largest = std::ilogb(magnitudes.largest);
  const int smallest = std::ilogb(magnitudes.smallest);
  if (largest < kLargestExponent && smallest >= kSmallestExponent) return 0;
  const int scale = kLargestExponent - 1 - largest;
  if (smallest + scale < kSmallestExponent) {
    throw std::invalid_argument("coordinates span more than a factor of 2^" +
                                std::to_string(kLargestExponent - 1 - kSmallestExponent) +
                                " in magnitude; move or round those closest to zero");
  }
  return scale;
}

/// The largest power of two of which all coordinates are multiples, or 0 once it is below `too_small`: most
/// inputs show that at once.
double common_unit(std::span<const Point> points, double too_small) {
  double unit = kInfinity;
  for (const Point& p : points) {
    for (const double c : {p.x, p.y}) {
      if (c == 0) continue;
      const auto bits = std::bit_cast<std::uint64_t>(c);
      const int exponent = static_cast<int>((bits >> 52U) & 0x7FFU);
      if (exponent == 0) return 0;  // subnormal
      constexpr std::uint64_t kLeadingOne = std::uint64_t{1} << 52U;
      const int trailing_zeros = std::countr_zero(bits | kLeadingOne);
      unit = std::min(unit, std::ldexp(1.0, exponent - 1075 + trailing_zeros));
      if (unit < too_small) return 0;
    }
  }
  return unit;
}

/// The place of the first one.
std::size_t find_not_finite(std::span<const Point> points) {
  const auto bad = std::find_if(points.begin(), points.end(),
                                [](const Point& p) { return !std::isfinite(p.x) || !std::isfinite(p.y); });
  return static_cast<std::size_t>(bad - points.begin());
}

/// Throws std::invalid_argument when a coordinate is not finite.
Magnitudes measure_all(std::span<const Point> points, ThreadPool& pool, Kernel kernel) {
  Magnitudes magnitudes;
  const auto measure_part = [kernel](std::span<const Point> part) { return measure(part, kernel); };
  for (const Magnitudes& part : of_each_chunk(points, pool, measure_part)) magnitudes.add(part);
  if (!std::isnan(magnitudes.poison)) return magnitudes;
  throw point_not_finite(find_not_finite(points));
}

}  // namespace

std::invalid_argument point_not_finite(std::uint64_t number) {
  return std::invalid_argument("point " + std::to_string(number) + " is not finite");
}

void RangeOfBlocks::add(std::span<const Point> block) {
  const Magnitudes magnitudes = measure(block, best_kernel());
  RangeOfBlocks own;
  own.box_ = magnitudes.box;
  own.largest_ = magnitudes.largest;
  own.smallest_ = magnitudes.smallest;
  own.count_ = block.size();
  if (std::isnan(magnitudes.poison)) own.not_finite_ = find_not_finite(block);
  add(own);
}

void RangeOfBlocks::add(const RangeOfBlocks& more) {
  box_ = joined(box_, more.box_);
  largest_ = std::max(largest_, more.largest_);
  smallest_ = std::min(smallest_, more.smallest_);
  if (!not_finite_ && more.not_finite_) not_finite_ = count_ + *more.not_finite_;
  count_ += more.count_;
}

bool are_within(std::span<const Point> points, const Box& box, Kernel kernel) {
  const std::size_t in_vectors = points.size() - points.size() % (kMostCoordinates / 2);
#ifdef POLYLIDAR_X86_KERNELS
  // Also with AVX-512: GCC 12 compiles comparisons of 512 bits element by element.
  if (kernel != Kernel::kPortable && !are_within_with_avx2(points.first(in_vectors), box)) return false;
#endif
  return are_within_portably(kernel == Kernel::kPortable ? points : points.subspan(in_vectors), box);
}

CoordinateRange RangeOfBlocks::range() const {
  return {box_, choose_scale({box_, largest_, smallest_, 0}), 0};
}

CoordinateRange measure_coordinates(std::span<const Point> points, ThreadPool& pool, Kernel kernel) {
  const Magnitudes magnitudes = measure_all(points, pool, kernel);
  CoordinateRange range;
  range.box = magnitudes.box;
  range.scale_exponent = choose_scale(magnitudes);
  if (range.scale_exponent != 0) return range;

  // Predicates fit into 53 bits where neighbours are at most some thousand units apart. A unit below 2^-20 of
  // the extent, as most points in single precision have one, hardly ever helps, and costs a pass to be found.
  const double too_small =
      std::max(range.box.max.x - range.box.min.x, range.box.max.y - range.box.min.y) * 0x1p-20;
  range.unit = kInfinity;
  for (const double unit : of_each_chunk(
           points, pool, [too_small](std::span<const Point> part) { return common_unit(part, too_small); })) {
    range.unit = std::min(range.unit, unit);
  }
  return range;
}

}  // namespace polylidar::detail
