// The polylidar core as a method: concave_hull() as a caller uses it, on memory that is kept between calls.
// It does not triangulate the interior where it need not; polylidar_steps is the way with a whole
// triangulation.
#include <limits>
#include <memory>
#include <optional>

#include "adapters/polylidar_adapter.hpp"
#include "polylidar/concave_hull.hpp"

namespace hullbench {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// No shape has triangles within an alpha of 0, so that the number is free to mean this.
constexpr double kNotGiven = 0;

}  // namespace

MethodInfo describe_polylidar() {
  MethodInfo info;
  info.name = "polylidar";
  info.title = "Polylidar";
  info.version = POLYLIDAR_VERSION;
  info.licence = "MIT";
  info.citation = "J. Castagno, E. Atkins, Polylidar - Polygons from Triangular Meshes";
  info.native_output = "multipolygon as indices of the points";
  // The perimeter first: it is what a search of one parameter is to search.
  info.parameters = {
      length_limit("max_perimeter", "Largest perimeter of a triangle inside the shape.", kInfinity),
      length_limit("alpha",
                   "Largest circumradius of a triangle inside the shape; 0: not given. With no limit "
                   "given, one is chosen from the points, place by place.",
                   kNotGiven),
      length_limit("max_edge_length", "Longest edge of a triangle inside the shape.", kInfinity),
      {.name = "detail",
       .unit = "1",
       .description = "Divides the size of triangles that is chosen where no limit is given.",
       .minimum = 0.01,
       .maximum = 100,
       .default_value = 1}};
  info.capabilities = {.holes = true, .several_polygons = true};
  return info;
}

namespace {

polylidar::Options options_of(const Parameters& complete) {
  const auto limit = [&](const char* name, double not_given) {
    const double value = complete.at(name);
    return value == not_given ? std::nullopt : std::optional(value);
  };
  return {.alpha = limit("alpha", kNotGiven),
          .max_edge_length = limit("max_edge_length", kInfinity),
          .max_perimeter = limit("max_perimeter", kInfinity),
          .detail = complete.at("detail")};
}

class OneCall final : public PolylidarAdapter {
 public:
  using PolylidarAdapter::PolylidarAdapter;

 private:
  const polylidar::IndexedMultiPolygon& make_shape(polylidar::Extractor& extractor,
                                                   std::span<const Point> points,
                                                   const polylidar::Options& options, Steps& steps) override {
    steps.begin("hull");
    return extractor.extract(points, options);
  }
};

}  // namespace

void PolylidarAdapter::do_run(const Parameters& parameters, Steps& steps) {
  shape_ = &make_shape(extractor_, points_, options_of(parameters), steps);
}

MultiPolygon PolylidarAdapter::do_extract(Steps& steps) {
  steps.begin("polygon");
  return polylidar::to_coordinates(*shape_, points_);
}

std::unique_ptr<Adapter> make_polylidar() {
  return std::make_unique<OneCall>(describe_polylidar());
}

}  // namespace hullbench
