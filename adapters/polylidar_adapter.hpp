// What the two methods of the core share.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "adapters/adapter.hpp"
#include "polylidar/concave_hull.hpp"

namespace hullbench {

/// The description of the method `polylidar`.
MethodInfo describe_polylidar();

/// The core as a method, but for how it goes from points to a shape.
class PolylidarAdapter : public Adapter {
 public:
  explicit PolylidarAdapter(MethodInfo info) { info_ = std::move(info); }

 private:
  void do_load(std::span<const Point> points) override { points_.assign(points.begin(), points.end()); }
  void do_run(const Parameters& parameters, Steps& steps) override;
  MultiPolygon do_extract(Steps& steps) override;

  /// Points to a shape, which lives until the next call.
  virtual const polylidar::IndexedMultiPolygon& make_shape(polylidar::Extractor& extractor,
                                                           std::span<const Point> points,
                                                           const polylidar::Options& options,
                                                           Steps& steps) = 0;

  std::vector<Point> points_;
  polylidar::Extractor extractor_;
  /// The extractor's result of the last run.
  const polylidar::IndexedMultiPolygon* shape_ = nullptr;
};

}  // namespace hullbench
