// Points as the files that `hullbench hull` reads, written here a second time and independently of the
// readers.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "polylidar/geometry.hpp"

namespace hullbench::testing {

using Points = std::vector<polylidar::Point>;

inline std::string number(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

inline std::string rows(const Points& points, const std::string& between, const std::string& end = "\n") {
  std::string text;
  for (const auto& p : points) text.append(number(p.x)).append(between).append(number(p.y)).append(end);
  return text;
}

/// `before` x `middle` y `after` for every point, with commas between.
inline std::string listed(const Points& points, const std::string& before, const std::string& middle,
                          const std::string& after) {
  std::string text;
  for (const auto& p : points) {
    text.append(text.empty() ? "" : ",")
        .append(before)
        .append(number(p.x))
        .append(middle)
        .append(number(p.y))
        .append(after);
  }
  return text;
}

inline std::string geojson_multipoint(const Points& points) {
  return R"({"type":"MultiPoint","coordinates":[)" + listed(points, "[", ",", "]") + "]}";
}

template <class Number>
std::string bytes_of(Number value, bool big_endian = false) {
  const auto raw = std::bit_cast<std::array<char, sizeof value>>(value);
  std::string text(raw.begin(), raw.end());
  if (big_endian) std::ranges::reverse(text);
  return text;
}

/// A .npy file of these bytes.
inline std::string npy(const std::string& type, bool fortran_order, const std::string& shape,
                       const std::string& data, char version = 1) {
  std::string header = "{'descr': '" + type + "', 'fortran_order': " + (fortran_order ? "True" : "False") +
                       ", 'shape': " + shape + ", }";
  header.resize(116, ' ');
  header += '\n';
  const auto size = static_cast<std::uint32_t>(header.size());
  const std::string length = version == 1 ? bytes_of(static_cast<std::uint16_t>(size)) : bytes_of(size);
  return std::string("\x93NUMPY") + version + '\0' + length + header + data;
}

template <class Number>
std::string npy_of(const Points& points, const std::string& type, bool fortran_order = false,
                   char version = 1, bool with_z = false) {
  std::string data;
  const auto put = [&](double value) { data += bytes_of(static_cast<Number>(value), type[0] == '>'); };
  if (fortran_order) {
    for (const auto& p : points) put(p.x);
    for (const auto& p : points) put(p.y);
    if (with_z) data.append(points.size() * sizeof(Number), '\1');
  } else {
    for (const auto& p : points) {
      put(p.x);
      put(p.y);
      if (with_z) put(7);
    }
  }
  return npy(type, fortran_order, "(" + std::to_string(points.size()) + (with_z ? ", 3)" : ", 2)"), data,
             version);
}

/// Nothing but the coordinates.
inline std::string raw_of(const Points& points) {
  std::string text;
  for (const auto& p : points) text += bytes_of(p.x) + bytes_of(p.y);
  return text;
}

/// PLY with an element and a list before the vertices, a property between x and y, and faces behind them.
inline std::string ply(const Points& points, const std::string& format, bool list_in_vertex) {
  std::string text =
      "ply\nformat " + format + " 1.0\ncomment of points\nobj_info none\nelement camera 1\n" +
      "property float zoom\nproperty list uchar int ids\nelement vertex " + std::to_string(points.size()) +
      "\nproperty double y\nproperty uchar red\n" +
      (list_in_vertex ? "property list uchar short near\n" : "") +
      "property float64 x\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const bool big = format == "binary_big_endian";
  const bool ascii = format == "ascii";
  text += ascii ? "1.5 2 7 8\n" : bytes_of(1.5F, big) + '\2' + bytes_of(7, big) + bytes_of(8, big);
  for (const auto& p : points) {
    const auto few = static_cast<std::int16_t>(3);
    if (ascii) {
      text += number(p.y) + " 200 " + (list_in_vertex ? "1 3 " : "") + number(p.x) + "\n";
    } else {
      text += bytes_of(p.y, big) + '\x0A' + (list_in_vertex ? '\1' + bytes_of(few, big) : "") +
              bytes_of(p.x, big);
    }
  }
  return text + (ascii ? "3 0 1 2\n" : '\3' + bytes_of(0, big) + bytes_of(1, big) + bytes_of(2, big));
}

struct PointFileText {
  std::string name;  ///< of the file
  std::string text;
};

/// The same points in every form that a double survives.
inline std::vector<PointFileText> all_forms(const Points& points) {
  const Points head(points.begin(), points.begin() + 1);
  const Points tail(points.begin() + 1, points.end());
  const std::string collection =
      R"({"coordinates":[)" + listed(head, "", ",", "") + R"(],"type":"Point"},)" + geojson_multipoint(tail);
  std::vector<PointFileText> forms = {
      {"plain.csv", rows(points, ",")},
      {"blanks.csv", rows(points, " , ", "  \r\n")},
      {"header.csv", "x,y\n" + rows(points, ",")},
      {"quoted.csv", "\"X\",\"Y\"\n" + rows(points, ",")},
      {"marked.csv", "\xEF\xBB\xBFx,y\n" + rows(points, ",")},
      {"semicolons.csv", "# made by hand\n\n  # twice\n" + rows(points, ";")},
      {"more.csv", "id;lat;lon;what\n"},
      {"tabs.tsv", "easting\tnorthing\theight of it\n" + rows(points, "\t", "\t1 2\n")},
      {"blanks.txt", rows(points, " ")},
      {"many.xyz", rows(points, "   ", "  12.5 7 red\n")},
      {"no_end.xyz", rows(points, " ").substr(0, rows(points, " ").size() - 1)},
      {"multi.geojson", geojson_multipoint(points)},
      {"height.geojson",
       R"({"bbox":[1,[2]],"type":"MultiPoint","coordinates":[)" + listed(points, "[", ",", ", 3.5]") + "]}"},
      {"features.json",
       R"({"type":"FeatureCollection","features":[)" +
           listed(
               points,
               R"({"properties":{"type":"Polygon","coordinates":[1],"a":[{}]},"geometry":{"type":"Point","coordinates":[)",
               ",", R"(]},"type":"Feature"})") +
           R"(,{"type":"Feature","geometry":null,"properties":null}],"crs":{"type":"name"}})"},
      {"collection.geojson", "{\n\"type\": \"GeometryCollection\",\n\"geometries\": [" + collection + "]}\n"},
      {"feature.geojson", R"({"type":"Feature","geometry":)" + geojson_multipoint(points) + "}"},
      {"points.wkt", "# points\n" +
                         [&] {
                           std::string text;
                           for (const auto& p : points)
                             text += "point( " + number(p.x) + " " + number(p.y) + ")\n";
                           return text;
                         }()},
      {"multi.wkt", "SRID=4326;MULTIPOINT (" + listed(points, "(", " ", ")") + ")"},
      {"flat.wkt", "MULTIPOINT Z (" + listed(points, "", " ", " 5") + ")\nPOINT EMPTY\n"},
      {"flag.wkt", "MULTIPOINTZM (EMPTY," + listed(points, "", " ", " 5 6") + ");\n"},
      {"collection.wkt", "GEOMETRYCOLLECTION (POINT (" + listed(head, "", " ", "") +
                             "), GEOMETRYCOLLECTION EMPTY, MULTIPOINT (" + listed(tail, "(", "\n", ")") +
                             "))"},
      {"one.npy", npy_of<double>(points, "<f8")},
      {"two.npy", npy_of<double>(points, "<f8", false, 2)},
      {"three.npy", npy_of<double>(points, "<f8", false, 3)},
      {"z.npy", npy_of<double>(points, "<f8", false, 1, true)},
      {"fortran.npy", npy_of<double>(points, "<f8", true)},
      {"fortran_z.npy", npy_of<double>(points, "<f8", true, 1, true)},
      {"big.npy", npy_of<double>(points, ">f8")},
  };
  PointFileText& more = *std::ranges::find_if(forms, [](const auto& f) { return f.name == "more.csv"; });
  for (const auto& p : points) more.text += R"("a; ""b""";)" + number(p.y) + ";" + number(p.x) + ";c\n";
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    for (const bool list : {false, true}) {
      forms.push_back({std::string(format) + (list ? "_list" : "") + ".ply", ply(points, format, list)});
    }
  }
  return forms;
}

inline Points random_points(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> coordinate(-1000, 1000);
  Points points(count);
  for (auto& p : points) p = {coordinate(random), coordinate(random) * 1e-3};
  return points;
}

/// Uniform in a square of side 10 with its lower left corner at `corner`, without a disc.
inline Points square_without_a_disc(std::size_t count, std::uint64_t seed, polylidar::Point corner = {0, 0}) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> coordinate(0, 10);
  Points points;
  while (points.size() < count) {
    const polylidar::Point p = {coordinate(random), coordinate(random)};
    if (std::hypot(p.x - 5, p.y - 4) > 2) points.push_back({corner.x + p.x, corner.y + p.y});
  }
  return points;
}

}  // namespace hullbench::testing
