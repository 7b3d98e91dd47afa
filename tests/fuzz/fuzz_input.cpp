#include "tests/fuzz/fuzz_input.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "tests/point_sets.hpp"

namespace polylidar::fuzz {
namespace {

constexpr std::size_t kMaxPoints = 256;
constexpr std::size_t kMaxPointsOfATile = 64;

// Bytes from the front; zeros once there are none left.
class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  bool empty() const { return bytes_.empty(); }
  std::uint8_t byte() {
    if (bytes_.empty()) return 0;
    const std::uint8_t first = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return first;
  }
  int signed_byte() { return static_cast<std::int8_t>(byte()); }
  double any_double() {
    std::uint64_t bits = 0;
    for (unsigned i = 0; i < 64; i += 8) bits |= std::uint64_t{byte()} << i;
    return std::bit_cast<double>(bits);
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

// `value` moved by -8 to 7 ulps.
double moved_by_ulps(double value, unsigned nibble) {
  const double towards =
      nibble < 8 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
  for (unsigned steps = nibble < 8 ? 8 - nibble : nibble - 8; steps > 0; --steps)
    value = std::nextafter(value, towards);
  return value;
}

Point moved_by_ulps(const Point& point, std::uint8_t byte) {
  return {moved_by_ulps(point.x, byte >> 4U), moved_by_ulps(point.y, byte & 15U)};
}

double with_exponent(Reader& reader) {
  const int exponent = 2 * reader.signed_byte();
  const int mantissa = reader.signed_byte();
  return std::ldexp(mantissa, exponent);
}

std::vector<Point> decode_points(Reader& reader, Kind kind, std::size_t max_points) {
  Point base;  // a point or a direction, by kind
  if (kind == Kind::kNearDuplicates) {
    base.x = reader.any_double();
    base.y = reader.any_double();
  } else if (kind == Kind::kNearCollinear) {
    base.x = 0.1 * reader.signed_byte();
    base.y = 0.1 * reader.signed_byte();
  }
  const std::vector<Point> exact_circle =
      kind == Kind::kCocircular ? testing::integer_circle(5525) : std::vector<Point>();

  std::vector<Point> points;
  while (!reader.empty() && points.size() < max_points) {
    Point point;
    switch (kind) {
      case Kind::kRaw:
        point.x = reader.any_double();
        point.y = reader.any_double();
        break;
      case Kind::kNibbles: {
        const std::uint8_t byte = reader.byte();
        point = {static_cast<double>(byte >> 4U), static_cast<double>(byte & 15U)};
        break;
      }
      case Kind::kBytes:
        point.x = reader.signed_byte();
        point.y = reader.signed_byte();
        break;
      case Kind::kNearDuplicates:
        point = moved_by_ulps(base, reader.byte());
        break;
      case Kind::kNearCollinear: {
        const double place = reader.signed_byte();
        point = moved_by_ulps({1 + place * base.x, 2 + place * base.y}, reader.byte());
        break;
      }
      case Kind::kOffsetLattice:
        point.x = 5e5 + 0.01 * reader.byte();
        point.y = 4e6 + 0.01 * reader.byte();
        break;
      case Kind::kNearCocircular: {
        const double angle = reader.byte() * (6.283185307179586 / 256);
        point = moved_by_ulps({100 + 10 * std::cos(angle), 100 + 10 * std::sin(angle)}, reader.byte());
        break;
      }
      case Kind::kCocircular: {
        const std::uint8_t byte = reader.byte();
        point = exact_circle[byte % exact_circle.size()];
        if (byte >= 240) point = {point.x / 2, point.y / 2};
        break;
      }
      case Kind::kMixedMagnitudes:
        point.x = with_exponent(reader);
        point.y = with_exponent(reader);
        break;
    }
    points.push_back(point);
  }
  return points;
}

double extent(std::span<const Point> points) {
  const Box box = bounding_box(points);
  return points.empty() ? 0 : std::max(box.max.x - box.min.x, box.max.y - box.min.y);
}

// 4 x 4 copies that meet at their edges, up to rounding.
std::vector<Point> tiled(const std::vector<Point>& points) {
  const double side = extent(points);
  std::vector<Point> tiles;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      for (const Point& point : points) tiles.push_back({point.x + column * side, point.y + row * side});
    }
  }
  return tiles;
}

// Bits 0 and 1: which limits there are, without any the automatic one; bit 2: any double, else a part of the
// extent, or a multiple up to 4.
Options decode_options(Reader& reader, std::uint8_t mode, double scale) {
  const auto limit = [&](bool limited) -> std::optional<double> {
    if (!limited) return std::nullopt;
    return (mode & 4U) != 0 ? reader.any_double() : reader.byte() / 64.0 * scale;
  };
  Options options;
  options.alpha = limit((mode & 1U) != 0);
  options.max_edge_length = limit((mode & 2U) != 0);
  options.threads = 1U + (mode >> 3U) % 3U;
  return options;
}

}  // namespace

Input decode(std::span<const std::uint8_t> bytes) {
  Reader reader(bytes);
  const auto kind = static_cast<Kind>(reader.byte() % kKindCount);
  const std::uint8_t mode = reader.byte();
  Input input;
  input.choice = reader.byte();
  const std::uint8_t form = reader.byte();  // the top bit: tiles; the others: nothing or the exponent below
  const int exponent = 8 * reader.signed_byte();
  Reader limits = reader;  // 16 bytes, of which limits that are parts of the extent use one or two
  for (int i = 0; i < 16; ++i) reader.byte();

  const bool in_tiles = (form & 0x80U) != 0;
  input.points = decode_points(reader, kind, in_tiles ? kMaxPointsOfATile : kMaxPoints);
  if (in_tiles) input.points = tiled(input.points);
  if ((form & 1U) != 0) {
    for (Point& point : input.points) point = {std::ldexp(point.x, exponent), std::ldexp(point.y, exponent)};
  }
  input.options = decode_options(limits, mode, extent(input.points));
  return input;
}

}  // namespace polylidar::fuzz
