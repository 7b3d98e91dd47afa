// The polylidar core as a method.
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include "adapters/adapter.hpp"
#include "polylidar/concave_hull.hpp"

namespace hullbench {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

MethodInfo describe() {
  MethodInfo info;
  info.name = "polylidar";
  info.title = "Polylidar";
  info.version = POLYLIDAR_VERSION;
  info.licence = "MIT";
  info.citation = "J. Castagno, E. Atkins, Polylidar - Polygons from Triangular Meshes";
  info.native_output = "multipolygon as indices of the points";
  info.parameters = {{.name = "alpha",
                      .unit = "length",
                      .description = "Largest circumradius of a triangle inside the shape.",
                      .minimum = 0,
                      .maximum = kInfinity,
                      .default_value = kInfinity},
                     {.name = "max_edge_length",
                      .unit = "length",
                      .description = "Longest edge of a triangle inside the shape.",
                      .minimum = 0,
                      .maximum = kInfinity,
                      .default_value = kInfinity}};
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
    const polylidar::Options options = {.alpha = complete.at("alpha"),
                                        .max_edge_length = complete.at("max_edge_length")};
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
