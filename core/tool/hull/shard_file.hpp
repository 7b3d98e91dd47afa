// What `polylidar hull --shard K/N` leaves for `polylidar merge`: a file a shard.
//
// All numbers are little-endian, whole ones without a sign, doubles as IEEE 754 has them:
//
//   at     bytes
//   0          8  "polypart"
//   8          4  version of the format: 1
//   12       4 4  number of the shard, from 1 on; how many shards there are
//   20         4  which options are given: 1 alpha, 2 max_edge_length, 4 max_perimeter,
//                 8 fill_single_triangles; and 16: single triangles are filled
//   24   8 8 8 8  alpha, max_edge_length, max_perimeter, 0 where not given; detail
//   56       8 8  points of the source; their checksum
//   72   8 8 8 8  box of the source's points: least x, least y, greatest x, greatest y
//   104        8  cells of the grid by length
//   112        8  how many points follow
//   120        4  number of the coordinate system in EPSG's register; 0: not known
//   124        4  what is known of it: 1 it is geographic, 2 something is
//   128      4 n  length of its well-known text, and that
//   then each point:
//        1 to 10  d * 2 + u: its number is d + 1 above that of the point before, the first one's d;
//                 u is 1 if it is uncertain. Seven bits a byte, the lowest first; the highest bit says that
//                 more follow
//            8 8  x and y
//   at last:
//              8  FNV-1a of 64 bits of all bytes before
#pragma once

#include <string>

#include "polylidar/stream.hpp"
#include "tool/points/crs.hpp"

namespace polylidar::tool {

struct ShardFile {
  StreamShard shard;
  Crs crs;  ///< of the source
};

/// As write_result(): whole or not at all, to standard output for an empty path.
void write_shard_file(const std::string& path, const ShardFile& file);

/// Throws PointFileError where the file cannot be read, is of another format or version, is cut short or is
/// damaged. Memory is asked for as bytes come: a header alone gets none. What was read has as many numbers as
/// points; whether it makes sense, concave_hull_of_shards() says.
ShardFile read_shard_file(const std::string& path);

}  // namespace polylidar::tool
