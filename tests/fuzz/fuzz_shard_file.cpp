// Any bytes as a part of a hull: they are read or refused in one sentence, and what was read becomes a hull
// or is refused.
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "polylidar/stream.hpp"
#include "tests/fuzz/memory_file.hpp"
#include "tool/hull/shard_file.hpp"
#include "tool/points/point_file.hpp"

namespace {

using namespace polylidar;
using fuzz::expect;

/// With the hash that ends such a file: FNV-1a, which no search finds by chance.
std::string with_hash(std::string_view bytes) {
  std::uint64_t hash = 0xCBF29CE484222325U;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001B3U;
  std::string whole(bytes);
  for (unsigned shift = 0; shift < 64; shift += 8) whole += static_cast<char>(hash >> shift & 0xFFU);
  return whole;
}

void make_hull(const StreamShard& shard) {
  expect(shard.numbers.size() == shard.points.size() && shard.uncertain.size() == shard.points.size(),
         "not every point has a number");
  try {
    const StreamedHull hull = concave_hull_of_shards(std::span(&shard, 1), 2);
    expect(hull.points == shard.source_points, "the hull is of other points");
    std::size_t corners = 0;
    for (const Polygon& polygon : hull.polygons) {
      corners += polygon.shell.size();
      for (const Ring& hole : polygon.holes) corners += hole.size();
    }
    expect(corners == hull.vertices.size(), "not every corner has a number");
  } catch (const std::invalid_argument&) {
    return;
  }
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  const bool gets_hash = (data[0] & 1U) != 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const fuzz::MemoryFile input(gets_hash ? with_hash(bytes) : bytes, (data[0] & 2U) != 0);
  try {
    make_hull(tool::read_shard_file(input.path()).shard);
  } catch (const tool::PointFileError& error) {
    fuzz::check_refusal(error, input);
  }
  return 0;
}
