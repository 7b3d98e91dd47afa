#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "datasets/json_file.hpp"
#include "datasets/shapes.hpp"

namespace hullbench {

using nlohmann::json;
using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::Polygon;
using polylidar::Ring;

namespace {

/// A fault in the document; `read_geojson` adds the file's name.
[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error(what);
}

Point parse_position(const json& position, const std::string& where) {
  const bool has_xy =
      position.is_array() && position.size() >= 2 && position[0].is_number() && position[1].is_number();
  if (!has_xy) fail(where + " has a vertex that is not a pair of numbers; write each as [x, y]");
  // Finite: a number too large for a double is refused when the file is parsed, and JSON has no NaN.
  return {position[0].get<double>(), position[1].get<double>()};
}

bool has_three_distinct(const Ring& ring) {
  const auto second =
      std::find_if(ring.begin(), ring.end(), [&](const Point& p) { return p != ring.front(); });
  return second != ring.end() &&
         std::any_of(second, ring.end(), [&](const Point& p) { return p != ring.front() && p != *second; });
}

/// A ring turned counter-clockwise, or clockwise for a hole.
Ring parse_ring(const json& positions, bool is_hole, const std::string& where) {
  if (!positions.is_array()) fail(where + " is not an array of vertices; write it as [[x, y], ...]");
  Ring ring;
  for (const json& position : positions) ring.push_back(parse_position(position, where));
  if (ring.empty() || ring.front() != ring.back()) {
    fail(where + " is not closed; repeat its first vertex at the end");
  }
  ring.pop_back();
  if (ring.empty() || !has_three_distinct(ring)) {
    fail(where + " has fewer than 3 distinct vertices; remove it or complete it");
  }
  const double area = polylidar::signed_area(ring);
  if (area == 0) fail(where + " encloses no area; remove it or correct its vertices");
  if ((area > 0) == is_hole) std::reverse(ring.begin(), ring.end());
  return ring;
}

Polygon parse_polygon(const json& rings, std::size_t number) {
  const std::string where = "polygon " + std::to_string(number);
  if (!rings.is_array() || rings.empty()) fail(where + " has no rings; remove it or give it a shell");
  Polygon polygon;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    Ring ring = parse_ring(rings[i], i > 0, where + ", ring " + std::to_string(i));
    if (i == 0) {
      polygon.shell = std::move(ring);
    } else {
      polygon.holes.push_back(std::move(ring));
    }
  }
  return polygon;
}

/// Appends the polygons of a GeoJSON object to `shape`.
void parse_object(const json& object, MultiPolygon& shape) {
  const std::string type = object.is_object() ? object.value("type", "") : "";
  if (type == "FeatureCollection") {
    for (const json& feature : object.at("features")) parse_object(feature, shape);
  } else if (type == "Feature") {
    parse_object(object.at("geometry"), shape);
  } else if (type == "Polygon") {
    shape.push_back(parse_polygon(object.at("coordinates"), shape.size()));
  } else if (type == "MultiPolygon") {
    for (const json& rings : object.at("coordinates")) shape.push_back(parse_polygon(rings, shape.size()));
  } else {
    fail("it has " + (type.empty() ? "an object without a GeoJSON type" : "a geometry of type " + type) +
         "; give a Polygon or MultiPolygon");
  }
}

/// What `parse` makes of the file's document, with errors that name the file.
template <typename Parse>
auto read_document(const std::filesystem::path& path, const Parse& parse) {
  const json document = read_json_file(path);
  try {
    return parse(document);
  } catch (const json::exception& error) {
    throw std::runtime_error(path.string() + " is not the GeoJSON of a shape (" + error.what() +
                             "); give a Polygon or MultiPolygon with its members as in RFC 7946");
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path.string() + " is not a usable shape: " + error.what());
  }
}

}  // namespace

MultiPolygon parse_geojson(const json& object) {
  MultiPolygon shape;
  parse_object(object, shape);
  if (shape.empty()) fail("it has no polygon; give a Polygon or MultiPolygon");
  return shape;
}

MultiPolygon read_geojson(const std::filesystem::path& path) {
  return read_document(path, parse_geojson);
}

std::vector<MultiPolygon> read_geojson_features(const std::filesystem::path& path) {
  return read_document(path, [](const json& document) {
    std::vector<MultiPolygon> shapes;
    for (const json& feature : document.at("features")) shapes.push_back(parse_geojson(feature));
    return shapes;
  });
}

}  // namespace hullbench
