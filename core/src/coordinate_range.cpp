#include "coordinate_range.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
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
    box.min = {std::min(box.min.x, other.box.min.x), std::min(box.min.y, other.box.min.y)};
    box.max = {std::max(box.max.x, other.box.max.x), std::max(box.max.y, other.box.max.y)};
    largest = std::max(largest, other.largest);
    smallest = std::min(smallest, other.smallest);
    poison += other.poison;
  }
};

/// x and y of a point, for arithmetic on both at once.
using Pair [[gnu::vector_size(16)]] = double;
static_assert(sizeof(Pair) == sizeof(Point));

Magnitudes measure(std::span<const Point> points) {
  const Pair infinity{kInfinity, kInfinity};
  Pair least = infinity;
  Pair greatest = -infinity;
  Pair smallest = infinity;
  Pair poison{};
  for (const Point& p : points) {
    const Pair v{p.x, p.y};
    const Pair magnitude = v < 0 ? -v : v;
    const Pair not_zero = magnitude == 0 ? infinity : magnitude;
    poison += v * 0;
    least = v < least ? v : least;
    greatest = v > greatest ? v : greatest;
    smallest = not_zero < smallest ? not_zero : smallest;
  }
  Magnitudes result;
  result.box = {{least[0], least[1]}, {greatest[0], greatest[1]}};
  for (const double c : {least[0], least[1], greatest[0], greatest[1]}) {
    if (!points.empty()) result.largest = std::max(result.largest, std::abs(c));
  }
  result.smallest = std::min(smallest[0], smallest[1]);
  result.poison = poison[0] + poison[1];
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

/// Throws std::invalid_argument when a coordinate is not finite; `first` is the number of the first point.
Magnitudes measure_all(std::span<const Point> points, ThreadPool& pool, std::uint64_t first) {
  Magnitudes magnitudes;
  for (const Magnitudes& part : of_each_chunk(points, pool, measure)) magnitudes.add(part);
  if (!std::isnan(magnitudes.poison)) return magnitudes;
  const auto bad = std::find_if(points.begin(), points.end(),
                                [](const Point& p) { return !std::isfinite(p.x) || !std::isfinite(p.y); });
  throw std::invalid_argument(
      "point " + std::to_string(first + static_cast<std::uint64_t>(bad - points.begin())) + " is not finite");
}

}  // namespace

Box RangeOfBlocks::add(std::span<const Point> block, ThreadPool& pool) {
  Magnitudes all = measure_all(block, pool, count_);
  const Box of_block = all.box;
  all.add({box_, largest_, smallest_, 0});
  box_ = all.box;
  largest_ = all.largest;
  smallest_ = all.smallest;
  count_ += block.size();
  return of_block;
}

CoordinateRange RangeOfBlocks::range() const {
  return {box_, choose_scale({box_, largest_, smallest_, 0}), 0};
}

CoordinateRange measure_coordinates(std::span<const Point> points, ThreadPool& pool) {
  const Magnitudes magnitudes = measure_all(points, pool, 0);
  CoordinateRange range;
  range.box = magnitudes.box;
  range.scale_exponent = choose_scale(magnitudes);
  if (range.scale_exponent != 0) return range;

  // Below 2^-20 of the extent no predicate of lattice neighbours fits into 53 bits.
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
