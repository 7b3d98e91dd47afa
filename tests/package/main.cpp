// The outline of an 11 x 11 lattice of points from whose middle 3 x 3 are missing.
#include <exception>
#include <iostream>
#include <vector>

#include "polylidar/concave_hull.hpp"

int main() {
  std::vector<polylidar::Point> points;
  for (int y = 0; y <= 10; ++y) {
    for (int x = 0; x <= 10; ++x) {
      const bool missing = 4 <= x && x <= 6 && 4 <= y && y <= 6;
      if (!missing) points.push_back({static_cast<double>(x), static_cast<double>(y)});
    }
  }
  try {
    // Half a cell of the lattice has a circumradius of 0.71; all others there are 1 or more.
    const polylidar::IndexedMultiPolygon shape =
        polylidar::concave_hull(points, {.alpha = 0.75, .threads = 2});
    const polylidar::MultiPolygon polygons = polylidar::to_coordinates(shape, points);
    for (const polylidar::Polygon& polygon : polygons) {
      std::cout << "shell of " << polygon.shell.size() << " vertices";
      for (const polylidar::Ring& hole : polygon.holes)
        std::cout << ", hole of " << hole.size() << " vertices";
      std::cout << '\n';
    }
    std::cout << "area " << polylidar::area(polygons) << '\n';
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << '\n';
    return 1;
  }
}
