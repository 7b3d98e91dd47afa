// print_laz_points FILE: what is read of each point of a LAS or LAZ file, a line each: x and y as whole
// numbers of 0.01, class, number of the return, point source. Exit status 1: the file is refused.
#include <cmath>
#include <iostream>
#include <vector>

#include "tool/points/point_file.hpp"

int main(int argc, char** argv) {
  using namespace polylidar::tool;
  if (argc != 2) {
    std::cerr << "usage: print_laz_points FILE\n";
    return 2;
  }
  try {
    std::vector<PointFile> by;
    for (const char* column : {"classification", "return", "point_source"}) {
      by.push_back(read_point_file(argv[1], {.by = column}));
    }
    const std::vector<polylidar::Point>& points = by[0].points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      std::cout << std::llround(points[i].x * 100) << ' ' << std::llround(points[i].y * 100);
      for (const PointFile& file : by) std::cout << ' ' << file.labels[file.groups[i]];
      std::cout << '\n';
    }
  } catch (const PointFileError& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
