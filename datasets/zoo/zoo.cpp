#include "datasets/zoo/zoo.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

#include "datasets/zoo/generators.hpp"

namespace hullbench {

extern const std::string_view kZooJson;  // zoo.json

namespace zoo {
namespace {

using nlohmann::json;

using Generator = Input (*)();

const std::map<std::string, Generator>& generators() {
  static const std::map<std::string, Generator> all = {
      // Few points.
      {"zoo-qgis-65899", one_point},
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
      {"zoo-hull-js-6", two_rows},

      // Flat ones.
      {"zoo-geos-719", bent_line},
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
      {"zoo-georust-1028", single_precision_triangle},

      // Close ones.
      {"zoo-nts-716", arcs_in_degrees},
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
      {"zoo-turf-333", repeated_stops},

      // Lattices, circles, pixels.
      {"zoo-delaunator-61", tilted_lattice},
      {"zoo-delaunator-cpp-19", normalised_lattice},
      {"zoo-geometry-10", quarter_lattice},
      {"zoo-qhull-25", centimetres_far_away},
      {"zoo-concaveman-28", flight_lines},
      {"zoo-concaveman-1", isochrone_cells},
      {"zoo-concaveman-cpp-5", pixel_ring},
      {"zoo-delaunator-43", slanted_rows},
      {"zoo-delaunator-13", seventeen_gon},
      {"zoo-delabella-8", octagon},
      {"zoo-delaunator-cpp-16", curve_in_an_image},
      {"zoo-delaunator-cpp-28", walls},

      // Clouds.
      {"zoo-pdal-4563", two_areas},
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
      {"zoo-concaveman-cpp-8", shuffled_outline},
  };
  return all;
}

std::vector<Case> read_cases() {
  const std::map<std::string, Answer> answers = {
      {"empty", Answer::kEmpty}, {"covers", Answer::kCovers}, {"shape", Answer::kShape}};
  std::vector<Case> all;
  const json manifest = json::parse(kZooJson);
  for (const json& entry : manifest.at("cases")) {
    const auto text = [&](const char* key) { return entry.at(key).get<std::string>(); };
    all.push_back({text("name"), text("title"), text("fault"), text("issue"), answers.at(text("answer")),
                   generators().at(text("name"))});
  }
  return all;
}

}  // namespace

const std::vector<Case>& cases() {
  static const std::vector<Case> all = read_cases();
  return all;
}

const Case* find_case(const std::string& name) {
  const auto found =
      std::find_if(cases().begin(), cases().end(), [&](const Case& one) { return one.name == name; });
  return found == cases().end() ? nullptr : &*found;
}

}  // namespace zoo
}  // namespace hullbench
