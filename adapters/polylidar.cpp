// The polylidar core as a method.
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "adapters/adapter.hpp"
#include "polylidar/concave_hull.hpp"

namespace hullbench {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// No shape has triangles within an alpha of 0, so that the number is free to mean this.
constexpr double kNotGiven = 0;

MethodInfo describe() {
  MethodInfo info;
  info.name = "polylidar";
  info.title = "Polylidar";
  info.version = POLYLIDAR_VERSION;
  info.licence = "MIT";
  info.citation = "J. Castagno, E. Atkins, Polylidar - Polygons from Triangular Meshes";
  info.native_output = "multipolygon as indices of the points";
  const auto limit = [](const char* name, const char* description, double default_value) {
    return ParameterInfo{.name = name,
                         .unit = "length",
                         .description = description,
                         .minimum = 0,
                         .maximum = kInfinity,
                         .default_value = default_value};
  };
  // The perimeter first: it is what a search of one parameter is to search.
  info.parameters = {limit("max_perimeter", "Largest perimeter of a triangle inside the shape.", kInfinity),
                     limit("alpha",
                           "Largest circumradius of a triangle inside the shape; 0: not given. With no limit "
                           "given, one is chosen from the points, place by place.",
                           kNotGiven),
                     limit("max_edge_length", "Longest edge of a triangle inside the shape.", kInfinity),
                     {.name = "detail",
                      .unit = "",
                      .description = "Divides the size of triangles that is chosen where no limit is given.",
                      .minimum = 0.01,
                      .maximum = 100,
                      .default_value = 1}};
  info.capabilities = {.holes = true, .several_polygons = true};
  return info;
}

class PolylidarAdapter final : public Adapter {
 public:
  const MethodInfo& info() const override { return info_; }

  void load(std::span<const Point> points) override {
    shape_ = nullptr;
    points_.assign(points.begin(), points.end());
  }

  void run(const Parameters& parameters, Steps& steps) override {
    const Parameters complete = complete_parameters(info_, parameters);
    const auto limit = [&](const char* name, double not_given) {
      const double value = complete.at(name);
      return value == not_given ? std::nullopt : std::optional(value);
    };
    const polylidar::Options options = {.alpha = limit("alpha", kNotGiven),
                                        .max_edge_length = limit("max_edge_length", kInfinity),
                                        .max_perimeter = limit("max_perimeter", kInfinity),
                                        .detail = complete.at("detail")};
    steps.begin("triangulation");
    extractor_.triangulate(points_);
    steps.begin("shape");
    extractor_.extract_regions(options);
    steps.begin("polygon");
    shape_ = &extractor_.extract_polygons();
  }

  MultiPolygon extract(Steps& steps) override {
    if (!shape_) throw std::logic_error("extract comes after run");
    steps.begin("polygon");
    return polylidar::to_coordinates(*shape_, points_);
  }

  void reset() override { shape_ = nullptr; }

 private:
  MethodInfo info_ = describe();
  std::vector<Point> points_;
  polylidar::Extractor extractor_;
  /// The extractor's result of the last run; null before the first one.
  const polylidar::IndexedMultiPolygon* shape_ = nullptr;
};

}  // namespace

std::unique_ptr<Adapter> make_polylidar() {
  return std::make_unique<PolylidarAdapter>();
}

}  // namespace hullbench
