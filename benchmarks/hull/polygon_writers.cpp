#include "benchmarks/hull/polygon_writers.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace hullbench::hull {
namespace {

using polylidar::Box;
using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::Polygon;
using polylidar::Ring;

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

void append(std::string& text, const Ring& ring, const Marks& marks) {
  text += marks.open;
  for (std::size_t i = 0; i <= ring.size(); ++i) {
    if (i > 0) text += marks.between;
    const Point& vertex = ring[i % ring.size()];
    text += marks.open_vertex;
    append(text, vertex.x);
    text += marks.between_coordinates;
    append(text, vertex.y);
    text += marks.close_vertex;
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

std::size_t hole_count(const MultiPolygon& shape) {
  std::size_t count = 0;
  for (const Polygon& polygon : shape) count += polygon.holes.size();
  return count;
}

void append_property(std::string& text, const char* name, double value) {
  text += std::string(",\"") + name + "\":";
  // JSON has no infinity, and the area of a shape of 1e200 units is one.
  if (std::isfinite(value)) {
    append(text, value);
  } else {
    text += "null";
  }
}

/// From the unit of the points to pixels, y downwards.
class Canvas {
 public:
  explicit Canvas(const Box& box) : box_(box) {
    // Halves, since the whole of -1e308 to 1e308 is infinite.
    half_width_ = box.max.x / 2 - box.min.x / 2;
    half_height_ = box.max.y / 2 - box.min.y / 2;
    const double scale = kPixels / std::max(half_width_, half_height_);
    if (std::isfinite(scale)) scale_ = scale;
  }

  double width() const { return half_width_ * scale_ + 2 * kMargin; }
  double height() const { return half_height_ * scale_ + 2 * kMargin; }
  double x(const Point& point) const { return (point.x / 2 - box_.min.x / 2) * scale_ + kMargin; }
  double y(const Point& point) const { return (box_.max.y / 2 - point.y / 2) * scale_ + kMargin; }

 private:
  static constexpr double kPixels = 1000;
  static constexpr double kMargin = 20;

  Box box_;
  double half_width_ = 0;
  double half_height_ = 0;
  double scale_ = 0;  ///< pixels to half a unit
};

void append_pixels(std::string& text, double value) {
  std::array<char, 32> digits{};
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed, 2).ptr;
  text.append(digits.data(), end);
}

void append_path(std::string& text, const Ring& ring, const Canvas& canvas) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    text += i == 0 ? "M" : "L";
    append_pixels(text, canvas.x(ring[i]));
    text += ' ';
    append_pixels(text, canvas.y(ring[i]));
  }
  text += 'Z';
}

void append_dots(std::string& text, std::span<const Point> points, const Canvas& canvas) {
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

std::string to_geojson(const MultiPolygon& shape, const HullFacts& facts) {
  std::string text = R"({"type":"Feature","properties":{"points":)" + std::to_string(facts.points);
  if (facts.alpha) append_property(text, "alpha", *facts.alpha);
  if (facts.max_edge_length) append_property(text, "max_edge_length", *facts.max_edge_length);
  if (facts.max_perimeter) append_property(text, "max_perimeter", *facts.max_perimeter);
  if (facts.sizes) {
    append_property(text, "least_size", facts.sizes->least);
    append_property(text, "median_size", facts.sizes->median);
    append_property(text, "most_size", facts.sizes->most);
  }
  text += ",\"polygons\":" + std::to_string(shape.size()) + ",\"holes\":" + std::to_string(hole_count(shape));
  append_property(text, "area", polylidar::area(shape));
  return text + R"(},"geometry":{"type":"MultiPolygon","coordinates":)" + coordinates(shape, kGeoJsonMarks) +
         "}}\n";
}

std::string to_wkt(const MultiPolygon& shape) {
  return "MULTIPOLYGON " + (shape.empty() ? "EMPTY" : coordinates(shape, kWktMarks)) + "\n";
}

std::string to_svg(const MultiPolygon& shape, std::span<const Point> points) {
  constexpr std::size_t kMostDots = 5000;
  const Canvas canvas(points.empty() ? Box{{0, 0}, {0, 0}} : polylidar::bounding_box(points));
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
    append_path(text, polygon.shell, canvas);
    for (const Ring& hole : polygon.holes) append_path(text, hole, canvas);
    text += "\"/>\n";
  }
  if (points.size() <= kMostDots) append_dots(text, points, canvas);
  return text + "</svg>\n";
}

}  // namespace hullbench::hull
