#include "tool/points/huge_pages.hpp"

#include <cstdint>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace polylidar::tool::point_files {

void ask_for_huge_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
  constexpr std::size_t kHugePage = std::size_t{1} << 21U;
  auto* const begin = static_cast<char*>(memory);
  const std::size_t before = (kHugePage - reinterpret_cast<std::uintptr_t>(begin) % kHugePage) % kHugePage;
  if (bytes >= before + kHugePage) madvise(begin + before, bytes - before, MADV_HUGEPAGE);
#endif
}

void reserve_points(std::vector<Point>& points, std::size_t count) {
  points.reserve(count);
  ask_for_huge_pages(points.data(), count * sizeof(Point));
}

}  // namespace polylidar::tool::point_files
