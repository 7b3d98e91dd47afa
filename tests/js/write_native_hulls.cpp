// Writes point sets and what the native core makes of them, for the tests of the JavaScript package: into the
// folder that is the argument cases.json, and the points of each set as raw doubles.
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "polylidar/concave_hull.hpp"
#include "tests/point_sets.hpp"

namespace polylidar::testing {
namespace {

std::string number(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

template <class Range, class Text>
std::string list(const Range& range, const Text& text) {
  std::string listed;
  for (const auto& value : range) listed += (listed.empty() ? "" : ",") + text(value);
  return "[" + listed + "]";
}

std::string indices(const std::vector<std::uint32_t>& values) {
  return list(values, [](std::uint32_t value) { return std::to_string(value); });
}

std::string shape(const IndexedMultiPolygon& hull) {
  return R"("vertices":)" + indices(hull.vertices) + R"(,"ringEnds":)" + indices(hull.ring_ends) +
         R"(,"polygonEnds":)" + indices(hull.polygon_ends);
}

/// Options by the names that they have in JavaScript. One of infinity is as good as one that JSON can say.
std::string in_javascript(const Options& options) {
  std::string text = R"("detail":)" + number(options.detail);
  const auto add = [&](const char* name, const std::optional<double>& limit) {
    if (limit) text += std::string(",\"") + name + "\":" + (*limit == kNoLimit ? "1e999" : number(*limit));
  };
  add("alpha", options.alpha);
  add("maxEdgeLength", options.max_edge_length);
  add("maxPerimeter", options.max_perimeter);
  if (const auto& fill = options.fill_single_triangles)
    text += std::string(R"(,"fillSingleTriangles":)") + (*fill ? "true" : "false");
  return "{" + text + "}";
}

/// Nothing where the coordinates are so large that it overflows.
std::string area_of(const IndexedMultiPolygon& hull, const std::vector<Point>& points) {
  const double value = area(to_coordinates(hull, points));
  return std::isfinite(value) ? R"(,"area":)" + number(value) : "";
}

/// The chosen limit and those that are about as large: each kind alone, all together, filled.
std::vector<Options> options_for(const std::vector<Point>& points) {
  Extractor extractor;
  extractor.extract(points);
  const auto sizes = extractor.chosen_sizes();
  const double size = sizes ? sizes->median : 1;
  return {{},
          {.detail = 0.25},
          {.detail = 3, .fill_single_triangles = false},
          {.alpha = 0.6 * size},
          {.max_edge_length = 1.1 * size},
          {.max_perimeter = 2.9 * size, .fill_single_triangles = true},
          {.alpha = size, .max_edge_length = 1.3 * size, .max_perimeter = 3.5 * size},
          {.alpha = kNoLimit},
          {.max_edge_length = 0}};
}

class Writer {
 public:
  explicit Writer(std::string folder) : folder_(std::move(folder)), cases_(folder_ + "/cases.json") {
    cases_ << '[';
  }
  ~Writer() { cases_ << "\n]\n"; }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  void add(const std::string& name, const std::vector<Point>& points, const std::vector<Options>& options) {
    begin(name, points);
    cases_ << ",\"hulls\":" << list(options, [&](const Options& given) {
      Extractor extractor;
      const IndexedMultiPolygon hull = extractor.extract(points, given);
      const auto sizes = extractor.chosen_sizes();
      return "\n{\"options\":" + in_javascript(given) + "," + shape(hull) + R"(,"chosenSizes":)" +
             (sizes ? R"({"least":)" + number(sizes->least) + R"(,"median":)" + number(sizes->median) +
                          R"(,"most":)" + number(sizes->most) + "}"
                    : "null") +
             area_of(hull, points) + "}";
    }) << "}";
  }

  void add_labelled(const std::string& name, const std::vector<Point>& points,
                    const std::vector<std::int64_t>& labels, const Options& options) {
    begin(name, points);
    cases_ << ",\"options\":" << in_javascript(options)
           << ",\"labels\":" << list(labels, [](std::int64_t label) { return std::to_string(label); })
           << ",\"labelled\":"
           << list(concave_hulls(points, labels, options),
                   [](const LabelledHull& hull) {
                     return "\n{\"label\":" + std::to_string(hull.label) + "," + shape(hull.shape) + "}";
                   })
           << "}";
  }

 private:
  void begin(const std::string& name, const std::vector<Point>& points) {
    const std::string file = std::to_string(count_) + ".f64";
    std::ofstream(folder_ + "/" + file, std::ios::binary)
        .write(reinterpret_cast<const char*>(points.data()),
               static_cast<std::streamsize>(points.size() * sizeof(Point)));
    cases_ << (count_++ == 0 ? "" : ",") << "\n"
           << R"({"name":")" << name << R"(","points":")" << file << '"';
  }

  std::string folder_;
  std::ofstream cases_;
  int count_ = 0;
};

void write(const std::string& folder) {
  Writer writer(folder);
  for (const PointSet& set : nasty_point_sets()) writer.add(set.name, set.points, options_for(set.points));
  for (const NamedCase& named : named_cases()) writer.add(named.name, named.points, named.options);
  const std::vector<Point> many = uniform_points(200'000, 5, 100);
  writer.add("many", many, options_for(many));

  const std::vector<Point> points = uniform_points(5000, 6, 10);
  std::vector<std::int64_t> labels;
  labels.reserve(points.size());
  for (const Point& p : points) labels.push_back(static_cast<std::int64_t>(p.x) * 3 - 11);
  labels[17] = -4000;  // with one point only
  writer.add_labelled("stripes", points, labels, {});
  writer.add_labelled("stripes with a limit", points, labels, {.max_edge_length = 0.4});
}

}  // namespace
}  // namespace polylidar::testing

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: write_native_hulls FOLDER\n";
    return EXIT_FAILURE;
  }
  polylidar::testing::write(argv[1]);
  return EXIT_SUCCESS;
}
