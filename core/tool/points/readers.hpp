// One reader a format; see PointFormat for what each takes.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "polylidar/geometry.hpp"
#include "polylidar/stream.hpp"
#include "tool/points/block_reader.hpp"
#include "tool/points/labels.hpp"
#include "tool/points/point_file.hpp"

namespace polylidar::tool::point_files {

/// Columns of text. `only_blanks`: blanks alone separate them (XYZ). Empty lines are passed over, and before
/// the first row those that begin with #. The first row is a header when columns are chosen by name or when
/// no field of it is a number. A field may stand between double quotes.
void read_columns(BlockReader& reader, bool only_blanks, PointFile& file);

/// The coordinate system is WGS 84 (RFC 7946, 4), or that of a member "crs" as GeoJSON had before.
/// Groups by a property of features; points without it, or with null, have the label "".
void read_geojson_points(BlockReader& reader, PointFile& file);

/// Also with Z and M, with EMPTY, with PostGIS's "SRID=4326;" in front, and with lines that begin with #.
void read_wkt_points(BlockReader& reader, PointFile& file);

/// float32, float64 and whole numbers of 1 to 8 bytes, of either byte order, in C or Fortran order.
void read_npy(BlockReader& reader, PointFile& file);

/// Little-endian doubles: x and y of the first point, of the second, and so on to the end.
void read_raw(BlockReader& reader, PointFile& file);

/// x and y of any type; other properties, lists among them, and other elements are passed over.
std::vector<Point> read_ply(BlockReader& reader);

/// With the coordinate system of its WKT or GeoKeys. Groups by classification, return or point_source.
void read_las(BlockReader& reader, PointFile& file);

/// Whether a LAS file, of which these are the first bytes, says that its points are compressed.
bool is_laz(std::string_view start);

/// How many points a LAS file promises, be it compressed or not, of which these are the first bytes; nothing
/// where they are too few.
std::optional<std::uint64_t> promised_points_of_las(std::string_view start);

/// What the header of a LAS file, of which these are the first bytes, says of all of its points, those that
/// are withheld among them; nothing where they are too few.
std::optional<ExpectedPoints> expected_points_of_las(std::string_view start);

/// Whether all points of a LAS file are taken but for those that are withheld.
inline bool takes_all_points(const PointFileOptions& options) {
  return options.returns == Returns::kAll && !options.classes && !options.window;
}

/// How many points are handed on together, at least. Small blocks stay in the cache of the one core that
/// works on them; large ones are worth sharing.
inline std::size_t points_in_block(const PointFileOptions& options) {
  return std::size_t{1} << (options.part.count > 1 ? 13U : 18U);
}

/// To be called after points were added to `file`, and at the end with `at_end`: hands the points on
/// where somebody takes them.
inline void hand_on(PointFile& file, const PointFileOptions& options, bool at_end = false) {
  if (!options.take_points || (file.points.size() < points_in_block(options) && !at_end)) return;
  if (!file.points.empty()) options.take_points(file.points);
  file.points.clear();
}

/// Whether all coordinates are finite; quickly, as the compiler makes vectors of this.
inline bool are_finite(std::span<const Point> points) {
  // The exponent of what is not finite is all ones: adding one to it changes the sign.
  constexpr std::uint64_t kExponent = std::uint64_t{0x7FF} << 52U;
  constexpr std::uint64_t kOne = std::uint64_t{1} << 52U;
  std::uint64_t signs = 0;
  for (const Point& p : points) {
    signs |= (std::bit_cast<std::uint64_t>(p.x) & kExponent) + kOne;
    signs |= (std::bit_cast<std::uint64_t>(p.y) & kExponent) + kOne;
  }
  return signs >> 63U == 0;
}

/// Whether `point` is in the box or on its border.
inline bool is_inside(const Point& point, const Box& box) {
  return point.x >= box.min.x && point.x <= box.max.x && point.y >= box.min.y && point.y <= box.max.y;
}

}  // namespace polylidar::tool::point_files
