#include <cmath>

#include "datasets/portable_math.hpp"
#include "datasets/zoo/generators.hpp"
#include "datasets/zoo/tools.hpp"

namespace hullbench::zoo {

using polylidar::Point;
using polylidar::Ring;

namespace {

/// origin + i * a + j * b for i < columns, j < rows, row by row, with the parallelogram that stands half a
/// step around them; `a` to `b` turns left.
Input lattice(Point origin, Point a, Point b, int columns, int rows) {
  const auto place = [&](double i, double j) {
    return Point{origin.x + i * a.x + j * b.x, origin.y + i * a.y + j * b.y};
  };
  Input input;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) input.points.push_back(place(i, j));
  }
  const double right = columns - 0.5;
  const double top = rows - 0.5;
  input.ground_truth = {{{place(-0.5, -0.5), place(right, -0.5), place(right, top), place(-0.5, top)}, {}}};
  return input;
}

Input tilted_lattice() {
  const Point a = unit_vector(302.328 / 360);
  return lattice({0, 0}, a, {-a.y, a.x}, 60, 60);
}

Input normalised_lattice() {
  return lattice({0, 0}, {1.0 / 120, 0}, {0, 1.0 / 120}, 120, 80);
}

Input quarter_lattice() {
  return lattice({0.25, 0.5}, {0.25, 0}, {0, 0.25}, 100, 99);
}

/// A square of 40 m, centimetres, tens of kilometres from the origin: many are on common circles.
Input centimetres_far_away() {
  Input input = sampled({{rectangle(7000, 51000, 40, 40), {}}}, 5000, "centimetres far away");
  for (Point& point : input.points) point = decimal(point, 100);
  return input;
}

Input flight_lines() {
  return lattice({0, 0}, {5, 0}, {0, 30}, 60, 12);
}

/// The cells of 0.005 degrees that are reached: a cross.
Input isochrone_cells() {
  constexpr int kArm = 40;
  constexpr int kWidth = 5;
  const auto place = [](double i, double j) { return Point{-122 + 0.005 * i, 37.5 + 0.005 * j}; };
  Input input;
  for (int j = -kArm; j <= kArm; ++j) {
    for (int i = -kArm; i <= kArm; ++i) {
      if (std::abs(i) <= kWidth || std::abs(j) <= kWidth) input.points.push_back(decimal(place(i, j), 1000));
    }
  }
  const double w = kWidth + 0.5;
  const double a = kArm + 0.5;
  input.ground_truth = {
      {{place(w, -a), place(w, -w), place(a, -w), place(a, w), place(w, w), place(w, a), place(-w, a),
        place(-w, w), place(-a, w), place(-a, -w), place(-w, -w), place(-w, -a)},
       {}}};
  return input;
}

/// The pixels 40 to 43 from the middle of an image, column by column.
Input pixel_ring() {
  Input input;
  for (int x = -43; x <= 43; ++x) {
    for (int y = -43; y <= 43; ++y) {
      const int square = x * x + y * y;
      if (square >= 40 * 40 && square <= 43 * 43) input.points.push_back({230.0 + x, 145.0 + y});
    }
  }
  return input;
}

Input slanted_rows() {
  return lattice({-531.8125, -119.4}, {39.37, -58.21}, {33.15, 41.83}, 10, 12);
}

Input seventeen_gon() {
  Ring ring;
  for (int i = 0; i < 17; ++i) {
    const Point direction = unit_vector(i / 17.0);
    ring.push_back({1 + 3 * direction.x, 1 + 3 * direction.y});
  }
  return {ring, {{ring, {}}}};
}

/// The corners of an octagon in whole numbers, exactly on a circle and nothing in it.
Input octagon() {
  const Ring ring = {{213, 266}, {166, 313}, {134, 313}, {87, 266},
                     {87, 234},  {134, 187}, {166, 187}, {213, 234}};
  return {ring, {{ring, {}}}};
}

/// The corners of an image and sixty points of a curve in it, in single precision.
Input curve_in_an_image() {
  Input input = {rectangle(0, 0, 1022, 1024), {}};
  for (int i = 0; i < 60; ++i) {
    const Point wave = unit_vector(i / 24.0);
    input.points.push_back({static_cast<float>(388 + 0.9 * i), static_cast<float>(403 + 9 * wave.y)});
  }
  return input;
}

/// The walls of a building of 20 x 12 m around the origin, scanned: points every centimetre and a half, in
/// whole millimetres, and nothing between the walls.
Input walls() {
  struct Wall {
    Point from;
    Point to;
  };
  Input input;
  Random random = numbers("walls");
  for (const Wall& wall :
       {Wall{{-10, -6}, {10, -6}}, Wall{{10, -6}, {10, 6}}, Wall{{10, 6}, {-10, 6}},
        Wall{{-10, 6}, {-10, -6}}, Wall{{-3, -6}, {-3, 6}}, Wall{{4, -6}, {4, 6}}, Wall{{-3, 1}, {4, 1}}}) {
    const double dx = wall.to.x - wall.from.x;
    const double dy = wall.to.y - wall.from.y;
    const int steps = static_cast<int>((std::abs(dx) + std::abs(dy)) / 0.015);
    for (int i = 0; i < steps; ++i) {
      const double along = i / static_cast<double>(steps);
      const double x = wall.from.x + along * dx + random.between(-0.002, 0.002);
      input.points.push_back(decimal({x, wall.from.y + along * dy + random.between(-0.002, 0.002)}, 1000));
    }
  }
  return input;
}

}  // namespace

Generators lattices() {
  return {{"zoo-delaunator-61", tilted_lattice},        {"zoo-delaunator-cpp-19", normalised_lattice},
          {"zoo-geometry-10", quarter_lattice},         {"zoo-qhull-25", centimetres_far_away},
          {"zoo-concaveman-28", flight_lines},          {"zoo-concaveman-1", isochrone_cells},
          {"zoo-concaveman-cpp-5", pixel_ring},         {"zoo-delaunator-43", slanted_rows},
          {"zoo-delaunator-13", seventeen_gon},         {"zoo-delabella-8", octagon},
          {"zoo-delaunator-cpp-16", curve_in_an_image}, {"zoo-delaunator-cpp-28", walls}};
}

}  // namespace hullbench::zoo
