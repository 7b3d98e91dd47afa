#include "tool/shapes/polygon_writers.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tool/program/little_endian.hpp"

namespace polylidar::tool {
namespace {

void append(std::string& text, double value) {
  std::array<char, 32> digits{};
  text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
}

/// What stands between the parts of a format.
struct Marks {
  const char* open;
  const char* close;
  const char* open_vertex;
  const char* between_coordinates;
  const char* close_vertex;
  const char* between;
};

constexpr Marks kGeoJsonMarks = {"[", "]", "[", ",", "]", ","};
constexpr Marks kWktMarks = {"(", ")", "", " ", "", ", "};

void append(std::string& text, const Point& vertex, const Marks& marks) {
  text += marks.open_vertex;
  append(text, vertex.x);
  text += marks.between_coordinates;
  append(text, vertex.y);
  text += marks.close_vertex;
}

void append(std::string& text, const Ring& ring, const Marks& marks) {
  text += marks.open;
  for (std::size_t i = 0; i <= ring.size(); ++i) {
    if (i > 0) text += marks.between;
    const Point& vertex = ring[i % ring.size()];
    append(text, vertex, marks);
  }
  text += marks.close;
}

std::string coordinates(const MultiPolygon& shape, const Marks& marks) {
  std::string text = marks.open;
  for (std::size_t p = 0; p < shape.size(); ++p) {
    if (p > 0) text += marks.between;
    text += marks.open;
    append(text, shape[p].shell, marks);
    for (const Ring& hole : shape[p].holes) {
      text += marks.between;
      append(text, hole, marks);
    }
    text += marks.close;
  }
  return text + marks.close;
}

std::uint32_t wkb_count(std::size_t count) {
  if (count > std::numeric_limits<std::uint32_t>::max()) {
    throw std::length_error("WKB counts with 32 bits and cannot hold " + std::to_string(count) + " elements");
  }
  return static_cast<std::uint32_t>(count);
}

/// What a geometry of OGC 06-103r4, table 7, begins with: byte order, type, and how many parts follow.
void put_wkb_start(std::uint32_t type, std::size_t count, std::string& to) {
  to += '\x01';
  put(type, to);
  put(wkb_count(count), to);
}

void append_pixels(std::string& text, double value) {
  std::array<char, 32> digits{};
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed, 2).ptr;
  text.append(digits.data(), end);
}

void append_path(std::string& text, const Ring& ring, const SvgCanvas& canvas) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    text += i == 0 ? "M" : "L";
    append_pixels(text, canvas.x(ring[i]));
    text += ' ';
    append_pixels(text, canvas.y(ring[i]));
  }
  text += 'Z';
}

void append_dots(std::string& text, std::span<const Point> points, const SvgCanvas& canvas) {
  text += "<g fill=\"#333\" fill-opacity=\"0.35\">\n";
  for (const Point& point : points) {
    text += R"(<circle r="1.5" cx=")";
    append_pixels(text, canvas.x(point));
    text += "\" cy=\"";
    append_pixels(text, canvas.y(point));
    text += "\"/>\n";
  }
  text += "</g>\n";
}

}  // namespace

std::string shortest(double value) {
  std::string text;
  append(text, value);
  return text;
}

std::string four_digits(double value) {
  std::array<char, 32> digits{};
  const auto [end, error] =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::general, 4);
  // Read again, as to_chars would write 123456 as 1.235e+05.
  std::from_chars(digits.data(), end, value);
  return shortest(value);
}

void Properties::add(std::string_view name, double value) {
  // JSON has no infinity.
  add_json(name, std::isfinite(value) ? shortest(value) : "null");
}

void Properties::add(std::string_view name, std::size_t value) {
  add_json(name, std::to_string(value));
}

void Properties::add(std::string_view name, std::string_view text) {
  add_json(name, json_string(text));
}

void Properties::add_json(std::string_view name, std::string_view json) {
  if (!members_.empty()) members_ += ',';
  members_ += json_string(name) + ":";
  members_ += json;
}

std::string json_string(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string geojson_feature(const Properties& properties, const MultiPolygon& shape,
                            const std::string& members) {
  return R"({"type":"Feature",)" + members + R"("properties":)" + properties.json() +
         R"(,"geometry":{"type":"MultiPolygon","coordinates":)" + coordinates(shape, kGeoJsonMarks) + "}}";
}

std::string geojson_feature(const Properties& properties, std::span<const Point> points) {
  std::string text = R"({"type":"Feature","properties":)" + properties.json() +
                     R"(,"geometry":{"type":"MultiPoint","coordinates":[)";
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0) text += kGeoJsonMarks.between;
    append(text, points[i], kGeoJsonMarks);
  }
  return text + "]}}";
}

std::string geojson_collection(std::span<const std::string> features, const std::string& members) {
  std::string text = R"({"type":"FeatureCollection",)" + members + "\"features\":[";
  for (std::size_t i = 0; i < features.size(); ++i) text += (i > 0 ? ",\n" : "\n") + features[i];
  return text + "\n]}\n";
}

std::string geojson_crs(const Crs& crs) {
  constexpr int kWgs84 = 4326;
  if (crs.epsg == 0 || crs.epsg == kWgs84) return "";
  return R"("crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::)" + std::to_string(crs.epsg) +
         R"("}},)";
}

std::string to_wkt(const MultiPolygon& shape) {
  return "MULTIPOLYGON " + (shape.empty() ? "EMPTY" : coordinates(shape, kWktMarks)) + "\n";
}

std::string to_wkb(const MultiPolygon& shape) {
  constexpr std::uint32_t kPolygon = 3;
  constexpr std::uint32_t kMultiPolygon = 6;
  std::string bytes;
  put_wkb_start(kMultiPolygon, shape.size(), bytes);
  const auto put_ring = [&](const Ring& ring) {
    put(wkb_count(ring.size() + 1), bytes);
    for (std::size_t i = 0; i <= ring.size(); ++i) {
      const Point& vertex = ring[i % ring.size()];
      put(vertex.x, bytes);
      put(vertex.y, bytes);
    }
  };
  for (const Polygon& polygon : shape) {
    put_wkb_start(kPolygon, 1 + polygon.holes.size(), bytes);
    put_ring(polygon.shell);
    for (const Ring& hole : polygon.holes) put_ring(hole);
  }
  return bytes;
}

SvgCanvas::SvgCanvas(const Box& box) : box_(box) {
  // Halves, since the whole of -1e308 to 1e308 is infinite.
  half_width_ = box.max.x / 2 - box.min.x / 2;
  half_height_ = box.max.y / 2 - box.min.y / 2;
  const double scale = kPixels / std::max(half_width_, half_height_);
  if (std::isfinite(scale)) scale_ = scale;
}

std::string svg_path(const Polygon& polygon, const SvgCanvas& canvas) {
  std::string text;
  append_path(text, polygon.shell, canvas);
  for (const Ring& hole : polygon.holes) append_path(text, hole, canvas);
  return text;
}

std::string to_svg(const MultiPolygon& shape, std::span<const Point> points) {
  constexpr std::size_t kMostDots = 5000;
  const SvgCanvas canvas(points.empty() ? Box{{0, 0}, {0, 0}} : bounding_box(points));
  std::string size;
  append_pixels(size, canvas.width());
  size += ' ';
  append_pixels(size, canvas.height());
  std::string text = R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 )" + size + "\">\n<title>" +
                     std::to_string(shape.size()) + (shape.size() == 1 ? " polygon" : " polygons") +
                     " round " + std::to_string(points.size()) + " points</title>\n";
  for (const Polygon& polygon : shape) {
    text +=
        "<path fill=\"#4c8bbf\" fill-opacity=\"0.35\" fill-rule=\"evenodd\" stroke=\"#1f4e79\" "
        "stroke-linejoin=\"round\" d=\"";
    text += svg_path(polygon, canvas) + "\"/>\n";
  }
  if (points.size() <= kMostDots) append_dots(text, points, canvas);
  return text + "</svg>\n";
}

}  // namespace polylidar::tool
