#include <cstddef>

#include "datasets/portable_math.hpp"
#include "datasets/zoo/generators.hpp"
#include "datasets/zoo/tools.hpp"

namespace hullbench::zoo {

using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::Ring;

namespace {

/// Five points in projected metres, the way turning by 1 to 2 degrees at each.
Input bent_line() {
  Input input;
  Random random = numbers("bent line");
  Point place = {1140210.125, 8201350.75};
  double heading = 0.92;
  for (int i = 0; i < 5; ++i) {
    input.points.push_back(place);
    const double step = random.between(70, 160);
    const Point direction = unit_vector(heading);
    place = {place.x + step * direction.x, place.y + step * direction.y};
    heading -= random.between(0.003, 0.006);
  }
  return input;
}

/// A field of 1000 x 100 m with 60 points along its southern edge, which bends inwards by a tenth of a
/// millimetre.
Input edge_bent_inwards() {
  const double left = 512000;
  const double bottom = 4102000;
  const MultiPolygon field = {{rectangle(left, bottom, 1000, 100), {}}};
  Input input = sampled(field, 400, "edge bent inwards");
  for (int i = 0; i < 60; ++i) {
    const double along = i / 59.0;
    input.points.push_back({left + 1000 * along, bottom + 4e-4 * along * (1 - along)});
  }
  return input;
}

/// 10 km long, 1 cm wide, slanted.
Input narrow_strip() {
  Input input;
  Random random = numbers("narrow strip");
  for (int i = 0; i < 100; ++i) {
    const double along = random.between(0, 10000);
    const double across = random.between(0, 0.01);
    input.points.push_back({0.8 * along - 0.6 * across, 0.6 * along + 0.8 * across});
  }
  return input;
}

Input evenly_spaced_line() {
  Input input;
  Random random = numbers("evenly spaced line");
  for (int i = 0; i < 8; ++i) {
    const double x = 571020.25 + 2.997 * i + random.between(-0.001, 0.001);
    input.points.push_back(decimal({x, 7512044.5 + 0.1533 * i + random.between(-0.001, 0.001)}, 1e8));
  }
  shuffle(input.points, random);
  return input;
}

/// Two pairs of points 2e-6 apart, 25 apart from each other, and one between them, off their line by a
/// millimetre.
Input two_pairs_and_a_middle() {
  const Point base = {213456.7, 487654.3};
  Input input;
  for (const Point& offset :
       {Point{0, 0}, Point{2e-6, -1e-6}, Point{1.9, 24.6}, Point{1.900001, 24.599998}, Point{0.951, 12.3}}) {
    input.points.push_back(decimal({base.x + offset.x, base.y + offset.y}, 1e6));
  }
  return input;
}

/// Six points in degrees within 5e-5 by 1e-8, two of them within 2e-10 of others.
Input flat_in_degrees() {
  const Point base = {10.2034, 63.4107};
  Input input;
  for (const double along : {0.0, 0.15, 0.86, 1.0}) {
    const double bend = 2e-12 * along * (1 - along);
    input.points.push_back({base.x + 5e-5 * along, base.y - 1e-8 * along + bend});
  }
  input.points.push_back({input.points[0].x + 2e-10, input.points[0].y - 4e-14});
  input.points.push_back({input.points[3].x - 2e-10, input.points[3].y + 4e-14});
  return input;
}

/// The outline of a wall, 105 x 1.3 m, its coordinates in whole multiples of 5 cm.
Input thin_building() {
  const Point along = {0.8417, 0.5399};
  Input input;
  for (const auto& [length, width] :
       {std::pair{0.0, 0.0}, std::pair{47.3, 0.0}, std::pair{73.4, 0.0}, std::pair{92.0, 0.0},
        std::pair{105.0, 0.0}, std::pair{105.0, 1.3}, std::pair{104.4, 1.3}, std::pair{0.0, 1.3}}) {
    input.points.push_back(decimal(
        {471310.65 + along.x * length - along.y * width, 160261.2 + along.y * length + along.x * width}, 20));
  }
  return input;
}

/// Five points in degrees, six decimals, on an arc 160 times as long as it is high.
Input shallow_arc() {
  Input input;
  for (int i = 0; i < 5; ++i) {
    const double along = i / 4.0;
    input.points.push_back(decimal({21.402 + 0.006 * along, 50.118 + 0.00015 * along * (2 - along)}, 1e6));
  }
  return input;
}

/// Three points on a line that is slanted by 8e-16 of its length and 1.4e-10 beside an axis, and one apart.
Input three_beside_an_axis() {
  return {{{-1.41e-10, 5.25}, {-1.41e-10 + 9e-15, -5.5}, {-1.41e-10 + 15e-15, -12.75}, {1 - 8.5e-11, -3.75}},
          {}};
}

/// Forty points within a fiftieth of the origin, one 280 million away, all on a line but for a thousandth.
Input one_far_along_the_line() {
  Input input = {{{279513000.75, 7546851.5}}, {}};
  Random random = numbers("one far");
  for (int i = 0; i < 40; ++i) {
    const double x = -random.between(0, 0.02);
    input.points.push_back({x, 0.027 * x * random.between(0.999, 1.001)});
  }
  return input;
}

Input level_line() {
  Input input;
  for (int i = 0; i < 8; ++i) input.points.push_back({75 + 46.5 * i, 20417.3});
  return input;
}

Input slanted_line() {
  Input input;
  for (int i = 1; i < 20; i += 2) input.points.push_back({1.0 * i, 1.0 * i + 1});
  return input;
}

/// Along the three sides of a triangle, in metres that single precision holds to 6 cm.
Input single_precision_triangle() {
  const Ring corners = {{790000, 790000}, {790255, 790010}, {790300, 790110}};
  Input input;
  for (std::size_t side = 0; side < 3; ++side) {
    const Point& from = corners[side];
    const Point& to = corners[(side + 1) % 3];
    for (int i = 0; i < 8; ++i) {
      const double along = i / 8.0;
      input.points.push_back({static_cast<float>(from.x + along * (to.x - from.x)),
                              static_cast<float>(from.y + along * (to.y - from.y))});
    }
  }
  return input;
}

}  // namespace

Generators flat_points() {
  return {{"zoo-geos-719", bent_line},
          {"zoo-geos-728", edge_bent_inwards},
          {"zoo-jts-1002", narrow_strip},
          {"zoo-shapely-1873", evenly_spaced_line},
          {"zoo-shapely-1971", two_pairs_and_a_middle},
          {"zoo-geos-946", flat_in_degrees},
          {"zoo-jts-1061", thin_building},
          {"zoo-sedona-1733", shallow_arc},
          {"zoo-geos-1286", three_beside_an_axis},
          {"zoo-shapely-555", one_far_along_the_line},
          {"zoo-d3-delaunay-92", level_line},
          {"zoo-cgal-8748", slanted_line},
          {"zoo-georust-1028", single_precision_triangle}};
}

}  // namespace hullbench::zoo
