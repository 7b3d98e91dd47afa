// From bytes to points and options: any bytes are some input, and the kinds of input that geometry code gets
// wrong are a few bytes away from one another.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "polylidar/concave_hull.hpp"
#include "polylidar/geometry.hpp"

namespace polylidar::fuzz {

/// What the points' bytes mean; the first byte of an input, modulo kKindCount.
enum class Kind : std::uint8_t {
  kRaw,             ///< 16 bytes a point: two doubles, whatever their bits say
  kNibbles,         ///< 1 byte: a point of a 16 x 16 lattice
  kBytes,           ///< 2 bytes: a point of a 256 x 256 lattice round the origin
  kNearDuplicates,  ///< a base point of 16 bytes; then 1 byte: up to 8 ulps away from it in x and y
  kNearCollinear,   ///< a direction of 2 bytes; then 2 bytes: a place on the line, and ulps in x and y
  kOffsetLattice,   ///< 2 bytes: a lattice of 1 cm with coordinates of UTM size
  kNearCocircular,  ///< 2 bytes: one of 256 angles of a circle, and ulps in x and y
  kCocircular,      ///< 1 byte: an integer point at distance exactly sqrt(5525) from the origin, or near it
  kMixedMagnitudes  ///< 4 bytes: for each coordinate an exponent, and a sign with 7 bits of mantissa
};
inline constexpr std::uint8_t kKindCount = 9;

struct Input {
  std::vector<Point> points;
  /// Any numbers, valid limits or not, or multiples of the points' extent; 1 to 3 threads.
  Options options;
  /// Chooses among limits that only the points suggest.
  std::uint8_t choice = 0;
};

/// At most 256 points, or up to 16 times 64 when the input asks for its points in 16 places.
Input decode(std::span<const std::uint8_t> bytes);

}  // namespace polylidar::fuzz
