// The polylidar core with a triangulation of all points, step by step: what the paper's Table VI times. The
// polygons are those of the method polylidar, to the bit.
#include <memory>
#include <span>

#include "adapters/polylidar_adapter.hpp"
#include "polylidar/concave_hull.hpp"

namespace hullbench {
namespace {

MethodInfo describe() {
  MethodInfo info = describe_polylidar();
  info.name = "polylidar_steps";
  info.title = "Polylidar, step by step";
  return info;
}

class StepByStep final : public PolylidarAdapter {
 public:
  using PolylidarAdapter::PolylidarAdapter;

 private:
  const polylidar::IndexedMultiPolygon& make_shape(polylidar::Extractor& extractor,
                                                   std::span<const Point> points,
                                                   const polylidar::Options& options, Steps& steps) override {
    steps.begin("triangulation");
    extractor.triangulate(points);
    steps.begin("shape");
    extractor.extract_regions(options);
    steps.begin("polygon");
    return extractor.extract_polygons();
  }
};

}  // namespace

std::unique_ptr<Adapter> make_polylidar_steps() {
  return std::make_unique<StepByStep>(describe());
}

}  // namespace hullbench
