#include <cstdint>

#include "tool/points/readers.hpp"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace polylidar::tool::point_files {

void reserve_points(std::vector<Point>& points, std::size_t count) {
  points.reserve(count);
#ifdef __linux__
  // The first touch of 40,000 small pages takes as long as reading 10,000,000 points. It is advice only, and
  // for whole huge pages.
  constexpr std::size_t kHugePage = std::size_t{1} << 21U;
  const std::size_t bytes = count * sizeof(Point);
  auto* const begin = reinterpret_cast<char*>(points.data());
  const std::size_t before = (kHugePage - reinterpret_cast<std::uintptr_t>(begin) % kHugePage) % kHugePage;
  if (bytes >= before + kHugePage) madvise(begin + before, bytes - before, MADV_HUGEPAGE);
#endif
}

}  // namespace polylidar::tool::point_files
