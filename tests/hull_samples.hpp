// Point sets on which two methods that should give the same shape are compared.
#pragma once

#include <string>
#include <vector>

#include "datasets/datasets.hpp"
#include "tests/hull_input.hpp"

namespace hullbench::testing {

struct HullSample {
  std::string name;
  std::vector<Point> points;
  double area = 0;  ///< of the shape that the points fill
};

inline HullSample dataset_sample(const std::string& name, bool holes) {
  const PointSet set = make_point_set(name, holes, 1000, 1);
  return {name + (holes ? " with holes" : ""), set.points, set.ground_truth_area};
}

inline std::vector<HullSample> hull_samples() {
  std::vector<Point> clusters = square_points(500, 1, false);
  for (const Point& point : square_points(500, 2, false)) clusters.push_back({point.x + 3, point.y});
  // Ties: whole families of edges and of circumradii are equal.
  std::vector<Point> grid;
  for (int x = 0; x < 20; ++x) {
    for (int y = 0; y < 20; ++y) grid.push_back({static_cast<double>(x), static_cast<double>(y)});
  }
  return {{"square with a hole", square_points(kPoints, 7, true), 1 - kHoleArea},
          {"two clusters", clusters, 2},
          {"grid", grid, 19 * 19},
          {"triangle", {{0, 0}, {4, 0}, {0, 3}}, 6},
          dataset_sample("ca", false),
          dataset_sample("ca", true),
          dataset_sample("hi", true)};
}

}  // namespace hullbench::testing
