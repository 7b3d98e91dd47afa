// A shape as the formats in which the tool answers.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "polylidar/geometry.hpp"
#include "tool/points/crs.hpp"

namespace polylidar::tool {

/// The shortest text that is read as `value` again.
std::string shortest(double value);
/// `value` to four digits, for people.
std::string four_digits(double value);

/// The properties of a GeoJSON feature, in the order they are added.
class Properties {
 public:
  /// The shortest number that gives the same double again; null for one that is not finite, as of an area of
  /// a shape of 1e200 units.
  void add(std::string_view name, double value);
  void add(std::string_view name, std::size_t value);
  void add(std::string_view name, std::string_view text);
  /// `json` as it is.
  void add_json(std::string_view name, std::string_view json);

  /// A JSON object.
  std::string json() const { return "{" + members_ + "}"; }

 private:
  std::string members_;
};

/// `text` as a JSON string; bytes that are no UTF-8 become U+FFFD.
std::string json_string(std::string_view text);

/// A Feature with a MultiPolygon (RFC 7946: shells counter-clockwise, holes clockwise). Numbers are the
/// shortest that give the same double again. `members` stand in front of its own, such as "\"crs\":{...},".
std::string geojson_feature(const Properties& properties, const MultiPolygon& shape,
                            const std::string& members = "");

/// A Feature with a MultiPoint.
std::string geojson_feature(const Properties& properties, std::span<const Point> points);

/// A FeatureCollection, a feature a line.
std::string geojson_collection(std::span<const std::string> features, const std::string& members = "");

/// The member "crs" as GeoJSON had it before RFC 7946, with a comma, which GDAL and QGIS read; empty where
/// the system is not known, or is the one that RFC 7946 has.
std::string geojson_crs(const Crs& crs);

/// A MULTIPOLYGON (OGC 06-103r4, 7.2); one line, numbers likewise.
std::string to_wkt(const MultiPolygon& shape);

/// Little-endian well-known binary (OGC 06-103r4, 8.2), a MultiPolygon. Throws std::length_error when a count
/// does not fit into 32 bits.
std::string to_wkb(const MultiPolygon& shape);

/// From the unit of the points in a box to the pixels of a picture of at most 1000 x 1000 within a margin, y
/// downwards.
class SvgCanvas {
 public:
  explicit SvgCanvas(const Box& box);

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

/// The data of a path with the shell and the holes, to be filled by the even-odd rule. No vertex may be more
/// than 1e20 pixels away.
std::string svg_path(const Polygon& polygon, const SvgCanvas& canvas);

/// A picture of at most 1000 x 1000 pixels without its margin, y upwards; `points` are drawn as faint dots
/// when they are at most 5000.
std::string to_svg(const MultiPolygon& shape, std::span<const Point> points);

}  // namespace polylidar::tool
