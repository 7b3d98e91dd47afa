#include <cmath>

#include "datasets/portable_math.hpp"
#include "datasets/zoo/generators.hpp"
#include "datasets/zoo/tools.hpp"

namespace hullbench::zoo {

using polylidar::Point;
using polylidar::Ring;

namespace {

Input one_point() {
  return {{{431250.5, 5412873.25}}, {}};
}

Input two_on_a_meridian() {
  return {{{25, 61}, {25, 60}}, {}};
}

Input three_points() {
  const Ring triangle = {{2, 1}, {7, 2}, {4, 6}};
  return {triangle, {{triangle, {}}}};
}

Input four_corners() {
  const Ring square = {{2.03, 50.03}, {2.47, 50.03}, {2.47, 50.47}, {2.03, 50.47}};
  return {square, {{square, {}}}};
}

Input three_on_a_line_and_one() {
  return {{{2, 1}, {5, 5}, {1, 7}, {9, 3}}, {{{{2, 1}, {9, 3}, {1, 7}}, {}}}};
}

Input flat_triangle() {
  const Ring triangle = {{0, 0}, {1500, 0}, {3100, 60}};
  return {triangle, {{triangle, {}}}};
}

/// Left and right in turn on the way north: a strip of four triangles.
Input zigzag_in_degrees() {
  Input input;
  Random random = numbers("zigzag");
  for (int i = 0; i < 5; ++i) {
    const double side = i % 2 == 0 ? 0 : 0.0013;
    input.points.push_back(decimal({11.575 + side + random.between(0, 0.0002), 48.137 + 0.00029 * i}, 1e6));
  }
  return input;
}

/// The fourth point is all but the middle of the edge from the third to the last but one, and outside of it:
/// bending the hull inwards to the third leaves the fourth out.
Input point_beside_a_hull_edge() {
  return {{{1, 5}, {6, 1}, {7, 3}, {9, 3.45}, {11, 4}, {8.5, 4.75}}, {}};
}

Input nearly_on_an_edge() {
  return {{{0, 0}, {430, 1e-9}, {1000, 0}, {1400, 500}, {900, 1100}, {100, 900}, {350, 400}}, {}};
}

/// The outline of a right angle 0.125 wide, wobbling by 1e-6, its first vertex repeated.
Input thin_corner() {
  return {{{0, 0}, {10.25, 0}, {10.25, 0.125}, {0.125000125, 0.125}, {0.125, 9.5}, {0, 9.500001}, {0, 0}},
          {}};
}

/// The vertices of a square and of a rhombus that stands out on its four sides, some more than once, and
/// where their outlines cross. The ground truth is what they cover.
Input square_and_rhombus() {
  const Ring star = {{0, 0}, {2, 0}, {4, -2}, {6, 0}, {8, 0}, {8, 2}, {10, 4}, {8, 6},
                     {8, 8}, {6, 8}, {4, 10}, {2, 8}, {0, 8}, {0, 6}, {-2, 4}, {0, 2}};
  Input input = {star, {{star, {}}}};
  for (const Point& repeated : {Point{0, 0}, Point{8, 8}, Point{8, 8}, Point{4, 10}}) {
    input.points.push_back(repeated);
  }
  return input;
}

/// Three of six points are on one level but for the last bits of their coordinate.
Input last_bits() {
  const double level = 4.9;
  const double above = std::nextafter(std::nextafter(level, 5), 5);
  const double below = std::nextafter(level, 4);
  return {{{161, -0.5}, {140, level}, {62, above}, {33, 24}, {18, 27}, {201, below}}, {}};
}

Input growing_heights() {
  return {{{0, 2}, {1, 0x1p13 + 2}, {2, 0x1p26 + 2}, {2, -2}, {0, -2}}, {}};
}

/// The corners of two squares of side 2^-56 and 2^-53, a unit apart; some fall together.
Input tiny_squares() {
  Input input;
  for (const auto& [corner, side] : {std::pair{Point{1, 0}, 0x1p-56}, std::pair{Point{0, 1}, 0x1p-53}}) {
    for (const Point& vertex : rectangle(corner.x, corner.y, side, side)) input.points.push_back(vertex);
  }
  return input;
}

Input tiny_numbers() {
  Input input;
  Random random = numbers("tiny numbers");
  for (int i = 0; i < 12; ++i) {
    const double x = random.between(-0x1p-76, 0x1p-76);
    input.points.push_back({x, random.between(-0x1p-76, 0x1p-76)});
  }
  return input;
}

/// An ellipse in whole numbers, vertex after vertex, each once.
Input ring_of_whole_numbers() {
  Input input;
  for (int i = 0; i < 72; ++i) {
    const Point direction = unit_vector(i / 72.0);
    const Point place = {44 + std::round(6 * direction.x), 21 + std::round(7 * direction.y)};
    if (input.points.empty() || !(place == input.points.back())) input.points.push_back(place);
  }
  while (input.points.back() == input.points.front()) input.points.pop_back();
  return input;
}

/// An outline with points along one side only.
Input one_sided_outline() {
  return {{{0, 0}, {90, 0}, {90, 180}, {90, 270}, {90, 360}, {0, 360}}, {{rectangle(0, 0, 90, 360), {}}}};
}

/// Posts of two rows, eight and five, in metres with millimetres.
Input two_rows() {
  Input input;
  Random random = numbers("two rows");
  for (int i = 0; i < 13; ++i) {
    const bool second = i >= 8;
    const double along = 46.5 * (second ? i - 8 : i) + random.between(-4, 4);
    input.points.push_back(decimal({25950 - 0.47 * along - (second ? 230 : 0) + random.between(-3, 3),
                                    11060 - 0.88 * along - (second ? 40 : 0)},
                                   1000));
  }
  return input;
}

}  // namespace

Generators few_points() {
  return {{"zoo-qgis-65899", one_point},
          {"zoo-turf-550", two_on_a_meridian},
          {"zoo-libpysal-111", three_points},
          {"zoo-merowech-1", four_corners},
          {"zoo-hgeometry-209", three_on_a_line_and_one},
          {"zoo-bl4ckb0ne-32", flat_triangle},
          {"zoo-ironwallaby-8", zigzag_in_degrees},
          {"zoo-concaveman-31", point_beside_a_hull_edge},
          {"zoo-qgis-27442", nearly_on_an_edge},
          {"zoo-georust-1124", thin_corner},
          {"zoo-georust-792", square_and_rhombus},
          {"zoo-shapely-541", last_bits},
          {"zoo-scipy-14185", growing_heights},
          {"zoo-openscad-2220", tiny_squares},
          {"zoo-parry-49", tiny_numbers},
          {"zoo-senhorsolar-1", ring_of_whole_numbers},
          {"zoo-hull-js-11", one_sided_outline},
          {"zoo-hull-js-6", two_rows}};
}

}  // namespace hullbench::zoo
