#include "datasets/portable_math.hpp"
#include "datasets/zoo/generators.hpp"
#include "datasets/zoo/tools.hpp"

namespace hullbench::zoo {

using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::Ring;

namespace {

Input two_areas() {
  return sampled({{rectangle(187600, 6177300, 400, 250), {}}, {rectangle(188250, 6177800, 250, 300), {}}},
                 4000, "two areas");
}

/// A field of six corners whose coordinates have seven digits before the point.
Input large_coordinates() {
  const Ring field = {{4330000, 5240000}, {4330300, 5240000}, {4330300, 5240120},
                      {4330140, 5240150}, {4330140, 5240320}, {4330000, 5240320}};
  return sampled({{field, {}}}, 4000, "large coordinates");
}

/// A lattice of 60 x 60 in degrees, every point moved at random, no two within 1e-4 of each other.
Input thinned_degrees() {
  constexpr int kSide = 60;
  constexpr double kCell = 1.5e-4;
  const Point origin = {-71.5, 42.75};
  Input input;
  Random random = numbers("thinned degrees");
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const double x = origin.x + kCell * (i + 0.5) + random.between(-2.4e-5, 2.4e-5);
      input.points.push_back({x, origin.y + kCell * (j + 0.5) + random.between(-2.4e-5, 2.4e-5)});
    }
  }
  input.ground_truth = {{rectangle(origin.x, origin.y, kSide * kCell, kSide * kCell), {}}};
  return input;
}

/// Ground returns of a tile of 200 x 200 m with three ponds, two of which touch at a corner.
Input ponds() {
  const double left = 500000;
  const double bottom = 4500000;
  polylidar::Polygon tile = {rectangle(left, bottom, 200, 200), {}};
  for (const auto& [corner, size] :
       {std::pair{Point{30, 30}, Point{50, 40}}, std::pair{Point{80, 70}, Point{50, 50}},
        std::pair{Point{140, 20}, Point{35, 40}}}) {
    Ring pond = rectangle(left + corner.x, bottom + corner.y, size.x, size.y);
    tile.holes.push_back({pond[0], pond[3], pond[2], pond[1]});
  }
  return sampled({tile}, 8000, "ponds");
}

/// A tile of 1 km whose north-east, beyond a straight border, is blank.
Input blanked_tile() {
  const double left = 569000;
  const double bottom = 6274000;
  const Ring tile = {{left, bottom},
                     {left + 1000, bottom},
                     {left + 1000, bottom + 350},
                     {left + 300, bottom + 1000},
                     {left, bottom + 1000}};
  return sampled({{tile, {}}}, 6000, "blanked tile");
}

/// The ceiling of a room, an L: one point, in single precision, in each cell of 10 cm.
Input voxels() {
  Input input;
  Random random = numbers("voxels");
  for (int j = 0; j < 20; ++j) {
    const int columns = j < 8 ? 30 : 15;
    for (int i = 0; i < columns; ++i) {
      const double x = -2 + 0.1 * (i + random.uniform());
      input.points.push_back({static_cast<float>(x), static_cast<float>(-1 + 0.1 * (j + random.uniform()))});
    }
  }
  input.ground_truth = {{{{-2, -1}, {1, -1}, {1, -0.2}, {-0.5, -0.2}, {-0.5, 1}, {-2, 1}}, {}}};
  return input;
}

/// Two squares that touch at a corner, and a third one far away.
Input touching_squares() {
  return sampled(
      {{rectangle(0, 0, 12, 12), {}}, {rectangle(12, 12, 12, 12), {}}, {rectangle(70, 60, 12, 12), {}}}, 900,
      "touching squares");
}

/// Transcripts of 200 cells that touch, thirty a cell, and two in every twentieth.
Input cells() {
  Input input;
  Random random = numbers("cells");
  for (int cell = 0; cell < 200; ++cell) {
    const int column = cell % 20;
    const int row = cell / 20;
    const int transcripts = column == 7 ? 2 : 30;
    for (int i = 0; i < transcripts; ++i) {
      const double x = 10 * (column + random.uniform());
      input.points.push_back({x, 10 * (row + random.uniform())});
    }
  }
  input.ground_truth = {{rectangle(0, 0, 200, 100), {}}};
  return input;
}

/// Six clusters of twenty points, a hundred of their radii apart, and three pairs alone.
Input sparse_clusters() {
  Input input;
  Random random = numbers("sparse clusters");
  for (int group = 0; group < 9; ++group) {
    const int column = group % 3;
    const int row = group / 3;
    const double x = 100 * column + random.between(-20, 20);
    const Point centre = {x, 100 * row + random.between(-20, 20)};
    const int points = column == 2 ? 2 : 20;
    for (int i = 0; i < points; ++i) {
      const double dx = random.between(-1, 1);
      input.points.push_back({centre.x + dx, centre.y + random.between(-1, 1)});
    }
  }
  return input;
}

Input twenty_regions() {
  MultiPolygon regions;
  for (int region = 0; region < 20; ++region) {
    const int column = region % 5;
    const int row = region / 5;
    regions.push_back({rectangle(10 * column, 10 * row, 8, 8), {}});
  }
  return sampled(regions, 100000, "twenty regions");
}

/// 250,000 records along eighty streets, in degrees with six decimals, 5 m beside them on average.
Input roads() {
  constexpr int kStreets = 80;
  constexpr double kNoise = 5e-5;
  Random random = numbers("roads");
  std::vector<double> place(kStreets);
  std::vector<double> slope(kStreets);
  for (int street = 0; street < kStreets; ++street) {
    place[static_cast<std::size_t>(street)] = random.between(0, 0.2);
    slope[static_cast<std::size_t>(street)] = random.between(-0.1, 0.1);
  }
  Input input;
  for (int i = 0; i < 250000; ++i) {
    const auto street = static_cast<std::size_t>(random.below(kStreets));
    const double along = random.between(0, 0.2);
    const double across = place[street] + slope[street] * along + kNoise * random.normal();
    const bool northwards = street % 2 == 0;
    input.points.push_back(
        decimal({8.4 + (northwards ? across : along), 49 + (northwards ? along : across)}, 1e6));
  }
  return input;
}

Input gaussian_cluster() {
  Input input;
  Random random = numbers("gaussian cluster");
  for (int i = 0; i < 1000; ++i) {
    const double x = 114.17 + 0.004 * random.normal();
    input.points.push_back(decimal({x, 22.3 + 0.003 * random.normal()}, 1e6));
  }
  return input;
}

Input c_in_degrees() {
  const auto place = [](double x, double y) { return Point{4.35 + 0.01 * x, 50.85 + 0.01 * y}; };
  const Ring c = {place(0, 0),     place(3, 0),   place(3, 0.7), place(0.7, 0.7),
                  place(0.7, 2.3), place(3, 2.3), place(3, 3),   place(0, 3)};
  return sampled({{c, {}}}, 1000, "c in degrees");
}

Input raster_tile() {
  return sampled({{rectangle(0, 0, 100, 100), {}}}, 10000, "raster tile");
}

/// Crossings of an irregular grid of streets, eight of 156 missing.
Input street_nodes() {
  Input input;
  Random random = numbers("street nodes");
  for (int j = 0; j < 12; ++j) {
    for (int i = 0; i < 13; ++i) {
      const double x = 11.97 + 0.001 * (i + random.between(-0.35, 0.35));
      input.points.push_back(decimal({x, 57.7 + 0.001 * (j + random.between(-0.35, 0.35))}, 1e7));
    }
  }
  shuffle(input.points, random);
  input.points.resize(148);
  return input;
}

/// The vertices of an outline with five capes, in whole millimetres, in no order.
Input shuffled_outline() {
  Ring outline;
  for (int i = 0; i < 400; ++i) {
    const Point direction = unit_vector(i / 400.0);
    const double radius = 1000 * (1 + 0.35 * unit_vector(5 * i / 400.0).x);
    outline.push_back(decimal({radius * direction.x, radius * direction.y}, 1000));
  }
  Input input = {outline, {{outline, {}}}};
  Random random = numbers("shuffled outline");
  shuffle(input.points, random);
  return input;
}

}  // namespace

Generators clouds() {
  return {{"zoo-pdal-4563", two_areas},
          {"zoo-pdal-3921", large_coordinates},
          {"zoo-pdal-2508", thinned_degrees},
          {"zoo-lasr-219", ponds},
          {"zoo-lidr-757", blanked_tile},
          {"zoo-pcl-1457", voxels},
          {"zoo-jts-948", touching_squares},
          {"zoo-baysor-103", cells},
          {"zoo-hootenanny-4073", sparse_clusters},
          {"zoo-concaveman-r-8", twenty_regions},
          {"zoo-concaveman-24", roads},
          {"zoo-geodan-1", gaussian_cluster},
          {"zoo-hull-js-14", c_in_degrees},
          {"zoo-concavity-2", raster_tile},
          {"zoo-pgrouting-1603", street_nodes},
          {"zoo-concaveman-cpp-8", shuffled_outline}};
}

}  // namespace hullbench::zoo
