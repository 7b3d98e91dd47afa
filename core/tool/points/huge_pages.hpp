// Memory that is touched for the first time.
#pragma once

#include <cstddef>
#include <vector>

#include "polylidar/geometry.hpp"

namespace polylidar::tool::point_files {

/// Asks the system for huge pages in memory that was not touched yet: the first touch of 40,000 small pages
/// takes as long as reading 10,000,000 points. It is advice only, and for whole huge pages.
void ask_for_huge_pages(void* memory, std::size_t bytes);

/// Reserves memory for `count` points, in huge pages where the system has them.
void reserve_points(std::vector<Point>& points, std::size_t count);

}  // namespace polylidar::tool::point_files
