#include "adapters/wkb.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace hullbench {
namespace {

using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::Polygon;
using polylidar::Ring;

// Geometry types of OGC 06-103r4, table 7.
constexpr std::uint32_t kPoint = 1;
constexpr std::uint32_t kLineString = 2;
constexpr std::uint32_t kPolygon = 3;
constexpr std::uint32_t kMultiPoint = 4;
constexpr std::uint32_t kMultiLineString = 5;
constexpr std::uint32_t kMultiPolygon = 6;
constexpr std::uint32_t kGeometryCollection = 7;

// Flags that EWKB sets in the type; ISO WKB adds 1000 for Z, 2000 for M and 3000 for both instead.
constexpr std::uint32_t kEwkbZ = 0x80000000U;
constexpr std::uint32_t kEwkbM = 0x40000000U;
constexpr std::uint32_t kEwkbSrid = 0x20000000U;

// Byte order, type and a count. A point has no count, but two coordinates, and is longer.
constexpr std::size_t kSmallestGeometry = 9;

// Collections nest by recursion; nothing that a hull method returns nests deeper than two.
constexpr int kDeepestNesting = 16;

class Writer {
 public:
  explicit Writer(std::size_t size) { bytes_.reserve(size); }

  void header(std::uint32_t type) {
    bytes_.push_back(1);
    number(type);
  }

  void count(std::size_t value) {
    if (value > std::numeric_limits<std::uint32_t>::max()) {
      throw std::length_error("WKB counts with 32 bits and cannot hold " + std::to_string(value) +
                              " elements");
    }
    number(static_cast<std::uint32_t>(value));
  }

  void point(const Point& point) {
    number(std::bit_cast<std::uint64_t>(point.x));
    number(std::bit_cast<std::uint64_t>(point.y));
  }

  void ring(const Ring& ring) {
    count(ring.empty() ? 0 : ring.size() + 1);
    for (const Point& vertex : ring) point(vertex);
    if (!ring.empty()) point(ring.front());
  }

  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  template <typename Unsigned>
  void number(Unsigned value) {
    for (std::size_t byte = 0; byte < sizeof value; ++byte) {
      bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * byte)));
    }
  }

  std::vector<std::uint8_t> bytes_;
};

class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  MultiPolygon read() {
    geometry(0);
    if (position_ != bytes_.size()) fail("bytes follow the geometry");
    return std::move(polygons_);
  }

 private:
  struct Header {
    bool little_endian;
    std::uint32_t type;
    std::size_t dimensions;
  };

  [[noreturn]] void fail(const std::string& what) const {
    throw std::invalid_argument("not well-formed WKB: " + what + " at byte " + std::to_string(position_) +
                                " of " + std::to_string(bytes_.size()));
  }

  template <typename Unsigned>
  Unsigned number(bool little_endian) {
    if (bytes_.size() - position_ < sizeof(Unsigned)) fail("cut short");
    Unsigned value = 0;
    for (std::size_t byte = 0; byte < sizeof(Unsigned); ++byte) {
      const std::size_t place = little_endian ? byte : sizeof(Unsigned) - 1 - byte;
      value |= static_cast<Unsigned>(Unsigned{bytes_[position_ + byte]} << (8 * place));
    }
    position_ += sizeof(Unsigned);
    return value;
  }

  double coordinate(bool little_endian) {
    return std::bit_cast<double>(number<std::uint64_t>(little_endian));
  }

  // A count of elements of at least `smallest` bytes each. More than the rest of the bytes can hold is
  // refused here, before anything is allocated for them.
  std::uint32_t count(const Header& head, std::size_t smallest) {
    const auto value = number<std::uint32_t>(head.little_endian);
    if (value > (bytes_.size() - position_) / smallest) {
      fail("a count of " + std::to_string(value) + ", more than the bytes can hold");
    }
    return value;
  }

  Header header() {
    const auto order = number<std::uint8_t>(true);
    if (order > 1) fail("byte order " + std::to_string(order));
    const bool little_endian = order == 1;
    const auto flagged = number<std::uint32_t>(little_endian);
    const std::uint32_t code = flagged & ~(kEwkbZ | kEwkbM | kEwkbSrid);
    const std::uint32_t iso = code / 1000;
    const std::uint32_t type = code % 1000;
    if (type < kPoint || type > kGeometryCollection || iso > 3)
      fail("unknown type " + std::to_string(flagged));
    if ((flagged & kEwkbSrid) != 0) number<std::uint32_t>(little_endian);
    const bool has_z = (flagged & kEwkbZ) != 0 || iso == 1 || iso == 3;
    const bool has_m = (flagged & kEwkbM) != 0 || iso == 2 || iso == 3;
    return {little_endian, type, 2U + (has_z ? 1U : 0U) + (has_m ? 1U : 0U)};
  }

  void geometry(int depth) {
    if (depth > kDeepestNesting) fail("collections nested too deeply");
    const Header head = header();
    if (head.type == kPoint) {
      skip(head, 1);
    } else if (head.type == kLineString) {
      skip(head, count(head, head.dimensions * sizeof(double)));
    } else if (head.type == kPolygon) {
      polygon(head);
    } else {
      const std::uint32_t members = count(head, kSmallestGeometry);
      for (std::uint32_t member = 0; member < members; ++member) member_of(head, depth);
    }
  }

  // Only a GeometryCollection may mix types.
  void member_of(const Header& parent, int depth) {
    const std::size_t start = position_;
    const std::uint32_t type = header().type;
    const bool fits = parent.type == kGeometryCollection || (parent.type == kMultiPoint && type == kPoint) ||
                      (parent.type == kMultiLineString && type == kLineString) ||
                      (parent.type == kMultiPolygon && type == kPolygon);
    if (!fits) fail("type " + std::to_string(type) + " inside type " + std::to_string(parent.type));
    position_ = start;
    geometry(depth + 1);
  }

  void skip(const Header& head, std::size_t points) {
    for (std::size_t number = 0; number < points * head.dimensions; ++number) coordinate(head.little_endian);
  }

  void polygon(const Header& head) {
    const std::uint32_t rings = count(head, sizeof(std::uint32_t));
    Polygon result;
    for (std::uint32_t index = 0; index < rings; ++index) {
      Ring vertices = ring(head);
      if (index == 0) {
        if (vertices.empty() && rings > 1) fail("holes without a shell");
        result.shell = turned(std::move(vertices), 1);
      } else {
        if (vertices.empty()) fail("an empty hole");
        result.holes.push_back(turned(std::move(vertices), -1));
      }
    }
    if (!result.shell.empty()) polygons_.push_back(std::move(result));
  }

  Ring ring(const Header& head) {
    const std::uint32_t points = count(head, head.dimensions * sizeof(double));
    if (points == 0) return {};
    if (points < 4) fail("a ring of " + std::to_string(points) + " points, and a closed one has at least 4");
    Ring vertices;
    vertices.reserve(points);
    for (std::uint32_t index = 0; index < points; ++index) {
      const double x = coordinate(head.little_endian);
      const double y = coordinate(head.little_endian);
      for (std::size_t extra = 2; extra < head.dimensions; ++extra) coordinate(head.little_endian);
      if (!std::isfinite(x) || !std::isfinite(y)) fail("a coordinate that is not finite");
      vertices.push_back({x, y});
    }
    if (!(vertices.front() == vertices.back())) fail("an open ring");
    vertices.pop_back();
    return vertices;
  }

  // A ring without area has no direction and stays as it is.
  static Ring turned(Ring ring, int direction) {
    if (polylidar::signed_area(ring) * direction < 0) std::reverse(ring.begin(), ring.end());
    return ring;
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t position_ = 0;
  MultiPolygon polygons_;
};

}  // namespace

std::vector<std::uint8_t> to_wkb(const MultiPolygon& shape) {
  Writer writer(kSmallestGeometry + polylidar::vertex_count(shape) * sizeof(Point) +
                shape.size() * (kSmallestGeometry + sizeof(Point)));
  writer.header(kMultiPolygon);
  writer.count(shape.size());
  for (const Polygon& polygon : shape) {
    writer.header(kPolygon);
    writer.count(1 + polygon.holes.size());
    writer.ring(polygon.shell);
    for (const Ring& hole : polygon.holes) writer.ring(hole);
  }
  return writer.take();
}

MultiPolygon from_wkb(std::span<const std::uint8_t> bytes) {
  return Reader(bytes).read();
}

std::vector<std::uint8_t> to_wkb_multipoint(std::span<const Point> points) {
  constexpr std::size_t kPointSize = 1 + sizeof(std::uint32_t) + sizeof(Point);
  Writer writer(kSmallestGeometry + points.size() * kPointSize);
  writer.header(kMultiPoint);
  writer.count(points.size());
  for (const Point& point : points) {
    writer.header(kPoint);
    writer.point(point);
  }
  return writer.take();
}

}  // namespace hullbench
