#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>

#include "datasets/portable_math.hpp"
#include "datasets/zoo/generators.hpp"
#include "datasets/zoo/tools.hpp"

namespace hullbench::zoo {

using polylidar::MultiPolygon;
using polylidar::Point;

namespace {

Point on_circle(Point centre, double radius, double turns) {
  const Point direction = unit_vector(turns);
  return {centre.x + radius * direction.x, centre.y + radius * direction.y};
}

/// Circles around twelve places, in degrees, every point twice with up to 1e-9 between.
Input arcs_in_degrees() {
  Input input;
  Random random = numbers("arcs in degrees");
  for (int circle = 0; circle < 12; ++circle) {
    const double x = 38.5 + random.between(0, 0.004);
    const Point centre = {x, 59.2 + random.between(0, 0.004)};
    for (int i = 0; i < 24; ++i) {
      const Point place = on_circle(centre, 0.001, i / 24.0);
      input.points.push_back(place);
      input.points.push_back(
          {place.x + random.between(1e-10, 7e-10), place.y + random.between(1e-10, 7e-10)});
    }
  }
  return input;
}

/// Circles of 237 m along a way in projected metres; every other one lies on the one before it but for half a
/// micrometre.
Input coinciding_arcs() {
  Input input;
  Random random = numbers("coinciding arcs");
  Point centre = {1181050.25, 8363250.5};
  for (int circle = 0; circle < 30; ++circle) {
    if (circle % 2 == 0) {
      centre = {centre.x + random.between(20, 110), centre.y + random.between(-60, 60)};
    } else {
      centre = {centre.x + 5e-7, centre.y - 5e-7};
    }
    for (int i = 0; i < 36; ++i) input.points.push_back(on_circle(centre, 237, i / 36.0));
  }
  return input;
}

Input three_close_two_far() {
  return {{{392010.5, 5389041.25},
           {378120, 5375190},
           {360710.855, 5611620.34},
           {360710.848, 5611620.321},
           {360710.8445, 5611620.3145}},
          {}};
}

Input last_bit_twins() {
  Input input;
  Random random = numbers("last bit twins");
  for (int i = 0; i < 60; ++i) {
    const double x = random.between(10, 180);
    input.points.push_back({x, random.between(10, 180)});
  }
  for (std::size_t i = 0; i < 19; ++i) {
    const Point& twin = input.points[i];
    input.points.push_back({std::nextafter(twin.x, 1000), std::nextafter(twin.y, -1000)});
  }
  shuffle(input.points, random);
  return input;
}

/// A triangle with an edge of a millimetre cut off its corner.
Input short_edge() {
  return {{{50, -190}, {90, -120.0005}, {90.001, -120}, {5, -140}, {30, -170}}, {}};
}

Input nearly_equal_pair() {
  const double x = 0.03;
  return {{{0, 0}, {0.0625, 0}, {x, 0x1p-58}, {0.015, 0.15}, {0.05, 0.02}, {std::nextafter(x, 0), -0x1p-58}},
          {}};
}

/// The corners of 150 buildings, in degrees with seven decimals.
Input buildings_in_degrees() {
  Input input;
  Random random = numbers("buildings");
  for (int building = 0; building < 150; ++building) {
    const double x = -0.1 + random.between(0, 0.01);
    const Point centre = {x, 51.5 + random.between(0, 0.01)};
    const double turn = random.uniform();
    for (const double corner : {0.08, 0.42, 0.58, 0.92}) {
      input.points.push_back(decimal(on_circle(centre, 0.0001, turn + corner), 1e7));
    }
  }
  return input;
}

/// Forty places within 1000 km, five to ten records within 60 m at each.
Input crowded_sites() {
  Input input;
  Random random = numbers("crowded sites");
  for (int site = 0; site < 40; ++site) {
    const double x = random.between(0, 1e6);
    const Point centre = {x, random.between(0, 1e6)};
    const std::uint64_t records = 5 + random.below(6);
    for (std::uint64_t i = 0; i < records; ++i) {
      const double distance = random.between(0, 60);
      input.points.push_back(on_circle(centre, distance, random.uniform()));
    }
  }
  return input;
}

/// Records of a species around 25 places along a coast, in degrees with four decimals, each place once.
Input occurrences() {
  Input input;
  Random random = numbers("occurrences");
  std::set<std::pair<double, double>> seen;
  for (int town = 0; town < 25; ++town) {
    const Point centre = on_circle({140, -20}, 12, 0.9 + 0.25 * random.uniform());
    for (int i = 0; i < 16; ++i) {
      const double x = centre.x + 0.4 * random.normal();
      const Point place = decimal({x, centre.y + 0.4 * random.normal()}, 1e4);
      if (seen.insert({place.x, place.y}).second) input.points.push_back(place);
    }
  }
  return input;
}

/// 300 points of the unit square, 200 of them a second time.
Input repeated_points() {
  const MultiPolygon square = {{rectangle(0, 0, 1, 1), {}}};
  Input input = sampled(square, 300, "repeated points");
  for (std::size_t i = 0; i < 200; ++i) input.points.push_back(Point(input.points[i]));
  Random random = numbers("repeated points, order");
  shuffle(input.points, random);
  return input;
}

/// A walk in degrees with seven decimals; three times it stands still for 120 records.
Input paused_track() {
  Input input;
  Random random = numbers("paused track");
  Point place = {71.6, 29.4};
  double heading = 0;
  for (int step = 0; step < 800; ++step) {
    heading += random.between(-0.06, 0.07);
    place = on_circle(place, 1.2e-5, heading);
    const int records = step % 250 == 200 ? 120 : 1;
    for (int i = 0; i < records; ++i) input.points.push_back(decimal(place, 1e7));
  }
  return input;
}

/// Ninety stops in degrees, each recorded one to six times, now the same and now a metre aside.
Input repeated_stops() {
  Input input;
  Random random = numbers("repeated stops");
  for (int stop = 0; stop < 90; ++stop) {
    const double x = -58.5 + random.between(0, 0.1);
    const Point place = decimal({x, -34.6 + random.between(0, 0.1)}, 1e5);
    const std::uint64_t records = 1 + random.below(6);
    for (std::uint64_t i = 0; i < records; ++i) {
      const double aside = 1e-5 * static_cast<double>(random.below(2));
      input.points.push_back(decimal({place.x + aside, place.y + aside}, 1e5));
    }
  }
  return input;
}

}  // namespace

Generators close_points() {
  return {{"zoo-nts-716", arcs_in_degrees},
          {"zoo-geos-754", coinciding_arcs},
          {"zoo-qgis-63868", three_close_two_far},
          {"zoo-jts-298", last_bit_twins},
          {"zoo-jts-321", short_edge},
          {"zoo-delaunator-94", nearly_equal_pair},
          {"zoo-jts-1121", buildings_in_degrees},
          {"zoo-spatialeco-60", crowded_sites},
          {"zoo-alpha-shapes-1", occurrences},
          {"zoo-gdl-141", repeated_points},
          {"zoo-hull-js-19", paused_track},
          {"zoo-turf-333", repeated_stops}};
}

}  // namespace hullbench::zoo
