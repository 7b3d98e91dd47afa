#include "datasets/zoo/zoo.hpp"

#include <algorithm>
#include <stdexcept>

#include "datasets/zoo/generators.hpp"

namespace hullbench::zoo {

namespace {

constexpr Answer kEmpty = Answer::kEmpty;
constexpr Answer kCovers = Answer::kCovers;
constexpr Answer kShape = Answer::kShape;

}  // namespace

const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      // Few points.
      {"zoo-qgis-65899", "One point", "a feature without a geometry came out", "qgis/QGIS#65899", kEmpty,
       one_point},
      {"zoo-turf-550", "Two points on one meridian", "threw a syntax error from its own inside",
       "Turfjs/turf#550", kEmpty, two_on_a_meridian},
      {"zoo-libpysal-111", "Three points", "Qhull refused fewer than four", "pysal/libpysal#111", kShape,
       three_points},
      {"zoo-merowech-1", "The corners of a square", "recursed until the stack overflowed",
       "merowech/java-concave-hull#1", kShape, four_corners},
      {"zoo-hgeometry-209", "Three points on a line and one beside it", "never ended", "noinia/hgeometry#209",
       kShape, three_on_a_line_and_one},
      {"zoo-bl4ckb0ne-32", "A triangle 50 times as long as high", "found no triangle",
       "bl4ckb0ne/delaunay-triangulation#32", kShape, flat_triangle},
      {"zoo-ironwallaby-8", "Five points in degrees, in zigzag", "triangles overlapped",
       "ironwallaby/delaunay#8", kCovers, zigzag_in_degrees},
      {"zoo-concaveman-31", "Six points, one just beside an edge of the hull", "left a point outside",
       "mapbox/concaveman#31", kCovers, point_beside_a_hull_edge},
      {"zoo-qgis-27442", "Seven points, one a nanometre inside an edge", "no hull below a threshold of 0.96",
       "qgis/QGIS#27442", kCovers, nearly_on_an_edge},
      {"zoo-georust-1124", "The vertices of a thin right angle, the first one repeated",
       "cut across the angle", "georust/geo#1124", kCovers, thin_corner},
      {"zoo-georust-792", "The vertices of a square across a rhombus", "gave the convex hull",
       "georust/geo#792", kShape, square_and_rhombus},
      {"zoo-shapely-541", "Three of six points level but for the last bits",
       "a convex hull that is not valid", "shapely/shapely#541", kCovers, last_bits},
      {"zoo-scipy-14185", "Heights that grow by four digits a step", "left vertices of the hull out",
       "scipy/scipy#14185", kCovers, growing_heights},
      {"zoo-openscad-2220", "Squares of 1e-17 and 1e-16, a unit apart", "crashed", "openscad/openscad#2220",
       kCovers, tiny_squares},
      {"zoo-parry-49", "Twelve points within 1e-23", "panicked", "dimforge/parry#49", kCovers, tiny_numbers},
      {"zoo-senhorsolar-1", "A ring in whole numbers, vertex after vertex", "never ended",
       "senhorsolar/concavehull#1", kCovers, ring_of_whole_numbers},
      {"zoo-hull-js-11", "An outline with points along one side only", "used the side's points twice",
       "andriiheonia/hull#11", kShape, one_sided_outline},
      {"zoo-hull-js-6", "Thirteen posts in two rows", "an incorrect hull", "andriiheonia/hull#6", kCovers,
       two_rows},

      // Flat ones.
      {"zoo-geos-719", "Five points on a way that hardly bends", "crashed", "libgeos/geos#719", kCovers,
       bent_line},
      {"zoo-geos-728", "A field with one edge bent inwards by a tenth of a millimetre",
       "the triangulation did not cover the convex hull", "libgeos/geos#728", kShape, edge_bent_inwards},
      {"zoo-jts-1002", "A strip a million times as long as wide", "the triangulation was not convex",
       "locationtech/jts#1002", kCovers, narrow_strip},
      {"zoo-shapely-1873", "Eight points evenly along a line, but for a millimetre", "crashed",
       "shapely/shapely#1873", kCovers, evenly_spaced_line},
      {"zoo-shapely-1971", "Two pairs 2e-6 apart and one between them", "crashed", "shapely/shapely#1971",
       kCovers, two_pairs_and_a_middle},
      {"zoo-geos-946", "Six points in degrees within 5e-5 by 1e-8", "crashed", "libgeos/geos#946", kCovers,
       flat_in_degrees},
      {"zoo-jts-1061", "The outline of a wall in multiples of 5 cm", "threw a null pointer exception",
       "locationtech/jts#1061", kCovers, thin_building},
      {"zoo-sedona-1733", "Five points in degrees on a shallow arc", "threw an error", "apache/sedona#1733",
       kCovers, shallow_arc},
      {"zoo-geos-1286", "Three points nearly on an axis and one apart", "triangles were not Delaunay's",
       "libgeos/geos#1286", kCovers, three_beside_an_axis},
      {"zoo-shapely-555", "Forty points at the origin and one 280 million away, on a line", "crashed",
       "shapely/shapely#555", kCovers, one_far_along_the_line},
      {"zoo-d3-delaunay-92", "Eight points on a level line", "took a rounding error for an area",
       "d3/d3-delaunay#92", kEmpty, level_line},
      {"zoo-cgal-8748", "Ten points on a slanted line", "read through a null pointer", "CGAL/cgal#8748",
       kEmpty, slanted_line},
      {"zoo-georust-1028", "The sides of a triangle in single precision", "a hull that is not convex",
       "georust/geo#1028", kCovers, single_precision_triangle},

      // Close ones.
      {"zoo-nts-716", "Circles in degrees, every point twice, 1e-9 apart",
       "gave up after a search without end", "NetTopologySuite/NetTopologySuite#716", kCovers,
       arcs_in_degrees},
      {"zoo-geos-754", "Circles in metres that coincide but for half a micrometre", "never ended",
       "libgeos/geos#754", kCovers, coinciding_arcs},
      {"zoo-qgis-63868", "Three points within 3 cm and two 200 km away", "an empty result without a word",
       "qgis/QGIS#63868", kCovers, three_close_two_far},
      {"zoo-jts-298", "Points and twins that differ in the last bit", "triangles overlapped",
       "locationtech/jts#298", kCovers, last_bit_twins},
      {"zoo-jts-321", "A triangle with a corner cut off by a millimetre", "triangles stood out of it",
       "locationtech/jts#321", kCovers, short_edge},
      {"zoo-delaunator-94", "Six points, two of them 1e-17 apart", "left a point without a triangle",
       "mapbox/delaunator#94", kCovers, nearly_equal_pair},
      {"zoo-jts-1121", "The corners of 150 buildings in degrees", "searched in a circle and gave up",
       "locationtech/jts#1121", kCovers, buildings_in_degrees},
      {"zoo-spatialeco-60", "Records within 60 m at forty places of 1000 km", "crashed",
       "jeffreyevans/spatialEco#60", kCovers, crowded_sites},
      {"zoo-alpha-shapes-1", "Occurrences of a species along a coast, in degrees", "its own choice failed",
       "panosz/alpha_shapes#1", kCovers, occurrences},
      {"zoo-gdl-141", "A square, two thirds of its points twice", "a wrong triangulation",
       "gnudatalanguage/gdl#141", kShape, repeated_points},
      {"zoo-hull-js-19", "A track in degrees with three long stops", "the limit had no effect",
       "andriiheonia/hull#19", kCovers, paused_track},
      {"zoo-turf-333", "Stops in degrees, each recorded up to six times", "threw an exception",
       "Turfjs/turf#333", kCovers, repeated_stops},

      // Lattices, circles, pixels.
      {"zoo-delaunator-61", "A lattice turned by 302.328 degrees", "large triangles across the lattice",
       "mapbox/delaunator#61", kShape, tilted_lattice},
      {"zoo-delaunator-cpp-19", "A lattice of steps of 1 / 120", "wrong triangles",
       "abellgithub/delaunator-cpp#19", kShape, normalised_lattice},
      {"zoo-geometry-10", "A lattice of 100 x 99 steps of a quarter", "Qhull's precision error",
       "davidcsterratt/geometry#10", kShape, quarter_lattice},
      {"zoo-qhull-25", "Centimetres tens of kilometres from the origin", "lost points", "qhull/qhull#25",
       kShape, centimetres_far_away},
      {"zoo-concaveman-28", "Pictures in twelve lines, six times as far apart as along them",
       "missed pictures of the border", "mapbox/concaveman#28", kShape, flight_lines},
      {"zoo-concaveman-1", "The cells of a lattice in degrees that are reached, a cross",
       "the outline crossed itself", "mapbox/concaveman#1", kShape, isochrone_cells},
      {"zoo-concaveman-cpp-5", "A ring of pixels, column by column", "a wrong outline",
       "sadaszewski/concaveman-cpp#5", kCovers, pixel_ring},
      {"zoo-delaunator-43", "Slanted rows at equal steps", "a hull that leaves points out",
       "mapbox/delaunator#43", kShape, slanted_rows},
      {"zoo-delaunator-13", "Seventeen points on a circle", "a broken triangulation", "mapbox/delaunator#13",
       kShape, seventeen_gon},
      {"zoo-delabella-8", "The corners of an octagon, on one circle", "crashed", "msokalski/delabella#8",
       kShape, octagon},
      {"zoo-delaunator-cpp-16", "The corners of an image and a curve in single precision", "never ended",
       "delfrrr/delaunator-cpp#16", kCovers, curve_in_an_image},
      {"zoo-delaunator-cpp-28", "The walls of a building in millimetres, around the origin",
       "wrong triangles", "abellgithub/delaunator-cpp#28", kCovers, walls},

      // Clouds.
      {"zoo-pdal-4563", "Two areas apart", "one area was lost", "PDAL/PDAL#4563", kShape, two_areas},
      {"zoo-pdal-3921", "A field whose coordinates have seven digits", "an empty polygon", "PDAL/PDAL#3921",
       kShape, large_coordinates},
      {"zoo-pdal-2508", "Degrees, no two points within 10 m", "an empty result", "PDAL/PDAL#2508", kShape,
       thinned_degrees},
      {"zoo-lasr-219", "Ground returns with three ponds, two of which touch", "polygons that are not valid",
       "r-lidar/lasR#219", kShape, ponds},
      {"zoo-lidr-757", "A tile of which a part is blank", "results of different types that would not merge",
       "r-lidar/lidR#757", kShape, blanked_tile},
      {"zoo-pcl-1457", "A ceiling, one point in each 10 cm",
       "a wrong hull for one alpha between two good ones", "PointCloudLibrary/pcl#1457", kShape, voxels},
      {"zoo-jts-948", "Two squares that touch at a corner and one far away",
       "a multipolygon where one polygon was promised", "locationtech/jts#948", kShape, touching_squares},
      {"zoo-baysor-103", "Transcripts of touching cells, two in some", "polygons of fewer than four vertices",
       "kharchenkolab/Baysor#103", kShape, cells},
      {"zoo-hootenanny-4073", "Clusters a hundred radii apart, and pairs alone", "left the pairs uncovered",
       "ngageoint/hootenanny#4073", kCovers, sparse_clusters},
      {"zoo-concaveman-r-8", "100,000 points in twenty regions (the issue has 12 million)",
       "did not take the grouped points", "joelgombin/concaveman#8", kShape, twenty_regions},
      {"zoo-concaveman-24", "250,000 records along roads, in degrees",
       "gaps across points, and above 20 minutes for 26,300 of them, most of its own hull",
       "mapbox/concaveman#24", kCovers, roads},
      {"zoo-geodan-1", "A cluster of 1,000 points in degrees", "edges crossed each other",
       "Geodan/concave-hull#1", kCovers, gaussian_cluster},
      {"zoo-hull-js-14", "A C of 1,000 points in degrees", "the default limit gave the convex hull",
       "andriiheonia/hull#14", kShape, c_in_degrees},
      {"zoo-concavity-2", "10,000 points of a tile", "never ended", "mlichter2/concavity#2", kShape,
       raster_tile},
      {"zoo-pgrouting-1603", "148 crossings of streets", "a polygon without a ring",
       "pgRouting/pgrouting#1603", kCovers, street_nodes},
      {"zoo-concaveman-cpp-8", "The vertices of an outline in no order",
       "points failed tests that they should pass", "sadaszewski/concaveman-cpp#8", kShape, shuffled_outline},
  };
  return all;
}

const Case* find_case(const std::string& name) {
  const auto found =
      std::find_if(cases().begin(), cases().end(), [&](const Case& one) { return one.name == name; });
  return found == cases().end() ? nullptr : &*found;
}

std::string right_answer(Answer answer) {
  switch (answer) {
    case Answer::kEmpty:
      return "an empty result, or an error that says why";
    case Answer::kCovers:
      return "valid, with nine tenths of the points in it or on its edge";
    case Answer::kShape:
      return "valid, and like the shape that the points are from";
  }
  throw std::invalid_argument("there is no such answer");
}

std::string markdown() {
  std::string table =
      "| Data set | Points | What went wrong | Issue | A right answer |\n"
      "|---|---|---|---|---|\n";
  for (const Case& one : cases()) {
    const auto [repository, number] = std::pair(one.citation.substr(0, one.citation.find('#')),
                                                one.citation.substr(one.citation.find('#') + 1));
    table += "| `" + one.name + "` | " + one.title + " | " + one.fault + " | [" + one.citation +
             "](https://github.com/" + repository + "/issues/" + number + ") | " + right_answer(one.answer) +
             " |\n";
  }
  return table;
}

}  // namespace hullbench::zoo
