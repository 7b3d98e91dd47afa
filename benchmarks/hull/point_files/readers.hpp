// One reader a format; see PointFormat for what each takes.
#pragma once

#include <vector>

#include "benchmarks/hull/point_files/block_reader.hpp"
#include "polylidar/geometry.hpp"

namespace hullbench::hull::point_files {

/// Columns of text. `only_blanks`: blanks alone separate them (XYZ). Empty lines and those that begin with #
/// are passed over. The first row is a header when columns are chosen by name or when no field of it is a
/// number. A field may stand between double quotes.
std::vector<polylidar::Point> read_columns(BlockReader& reader, bool only_blanks);

std::vector<polylidar::Point> read_geojson_points(BlockReader& reader);

/// Also with Z and M, with EMPTY, with PostGIS's "SRID=4326;" in front, and with lines that begin with #.
std::vector<polylidar::Point> read_wkt_points(BlockReader& reader);

/// float32, float64 and whole numbers of 1 to 8 bytes, of either byte order, in C or Fortran order.
std::vector<polylidar::Point> read_npy(BlockReader& reader);

/// x and y of any type; other properties, lists among them, and other elements are passed over.
std::vector<polylidar::Point> read_ply(BlockReader& reader);

}  // namespace hullbench::hull::point_files
