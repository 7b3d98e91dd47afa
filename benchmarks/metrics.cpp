#include "benchmarks/metrics.hpp"

#include <geos_c.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace hullbench {
namespace {

using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::Polygon;
using polylidar::Ring;

// GEOS as a session: its handle, and what it last complained of. GEOS reports errors through a callback and a
// null or out-of-range return value; `fail` turns them into an exception.
class Geos {
 public:
  struct DestroyGeometry {
    GEOSContextHandle_t context;
    void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(context, geometry); }
  };
  using Geometry = std::unique_ptr<GEOSGeometry, DestroyGeometry>;

  Geos() : context_(GEOS_init_r()) {
    if (context_ == nullptr) throw std::runtime_error("GEOS could not be started");
    GEOSContext_setErrorMessageHandler_r(context_, &Geos::keep_message, &message_);
  }
  ~Geos() { GEOS_finish_r(context_); }
  Geos(const Geos&) = delete;
  Geos& operator=(const Geos&) = delete;

  GEOSContextHandle_t context() const { return context_; }

  Geometry own(GEOSGeometry* geometry, const char* operation) const {
    if (geometry == nullptr) fail(operation);
    return Geometry(geometry, DestroyGeometry{context_});
  }

  [[noreturn]] void fail(const std::string& operation) const {
    throw std::runtime_error("GEOS failed in " + operation + ": " + message_);
  }

 private:
  static void keep_message(const char* message, void* place) { *static_cast<std::string*>(place) = message; }

  GEOSContextHandle_t context_;
  std::string message_;
};

using Geometry = Geos::Geometry;

Geometry make_ring(const Geos& geos, const Ring& ring) {
  const auto size = static_cast<unsigned>(ring.size());
  GEOSCoordSequence* sequence = GEOSCoordSeq_create_r(geos.context(), size + 1, 2);
  if (sequence == nullptr) geos.fail("making a ring");
  for (unsigned i = 0; i <= size; ++i) {
    const Point& point = ring[i % size];
    GEOSCoordSeq_setXY_r(geos.context(), sequence, i, point.x, point.y);
  }
  return geos.own(GEOSGeom_createLinearRing_r(geos.context(), sequence), "making a ring");
}

// Hands over geometries to GEOS, which then owns them even when it fails.
std::vector<GEOSGeometry*> release(std::vector<Geometry>& geometries) {
  std::vector<GEOSGeometry*> raw;
  raw.reserve(geometries.size());
  for (Geometry& geometry : geometries) raw.push_back(geometry.release());
  return raw;
}

Geometry make_polygon(const Geos& geos, const Polygon& polygon) {
  Geometry shell = make_ring(geos, polygon.shell);
  std::vector<Geometry> holes;
  for (const Ring& hole : polygon.holes) holes.push_back(make_ring(geos, hole));
  std::vector<GEOSGeometry*> raw_holes = release(holes);
  return geos.own(GEOSGeom_createPolygon_r(geos.context(), shell.release(), raw_holes.data(),
                                           static_cast<unsigned>(raw_holes.size())),
                  "making a polygon");
}

Geometry make_multi_polygon(const Geos& geos, const MultiPolygon& shape) {
  std::vector<Geometry> polygons;
  for (const Polygon& polygon : shape) polygons.push_back(make_polygon(geos, polygon));
  std::vector<GEOSGeometry*> raw = release(polygons);
  return geos.own(GEOSGeom_createCollection_r(geos.context(), GEOS_MULTIPOLYGON, raw.data(),
                                              static_cast<unsigned>(raw.size())),
                  "making a multipolygon");
}

double area_of(const Geos& geos, const Geometry& geometry) {
  double area = 0;
  if (GEOSArea_r(geos.context(), geometry.get(), &area) != 1) geos.fail("computing an area");
  return area;
}

double convexity_of(const Geos& geos, const Geometry& geometry) {
  const Geometry hull = geos.own(GEOSConvexHull_r(geos.context(), geometry.get()), "making a convex hull");
  return area_of(geos, geometry) / area_of(geos, hull);
}

std::string place_of(const Point& point) {
  std::ostringstream text;
  text << '[' << point.x << ' ' << point.y << ']';
  return text.str();
}

// Faults that keep GEOS from making a geometry at all; in the words it has for the others.
std::string fault_before_geos(const MultiPolygon& shape) {
  const auto fault_of_ring = [](const Ring& ring) -> std::string {
    if (ring.empty()) return "Ring without points";
    if (ring.size() < 3) return "Too few points in ring" + place_of(ring.front());
    for (const Point& point : ring) {
      if (!std::isfinite(point.x) || !std::isfinite(point.y)) return "Invalid Coordinate" + place_of(point);
    }
    return {};
  };
  for (const Polygon& polygon : shape) {
    if (std::string fault = fault_of_ring(polygon.shell); !fault.empty()) return fault;
    for (const Ring& hole : polygon.holes) {
      if (std::string fault = fault_of_ring(hole); !fault.empty()) return fault;
    }
  }
  return {};
}

struct Checked {
  Geometry geometry{nullptr, Geos::DestroyGeometry{nullptr}};  // null when it could not be made
  std::string invalid_reason;                                  // empty when valid
};

Checked check(const Geos& geos, const MultiPolygon& shape) {
  Checked checked;
  checked.invalid_reason = fault_before_geos(shape);
  if (!checked.invalid_reason.empty()) return checked;
  checked.geometry = make_multi_polygon(geos, shape);
  const char valid = GEOSisValid_r(geos.context(), checked.geometry.get());
  if (valid == 1) return checked;
  if (valid != 0) geos.fail("testing validity");
  char* reason = GEOSisValidReason_r(geos.context(), checked.geometry.get());
  if (reason == nullptr) geos.fail("testing validity");
  checked.invalid_reason = reason;
  GEOSFree_r(geos.context(), reason);
  return checked;
}

std::optional<double> ratio(double numerator, double denominator) {
  if (!(denominator > 0)) return std::nullopt;
  return numerator / denominator;
}

}  // namespace

std::string invalid_reason(const MultiPolygon& shape) {
  return check(Geos(), shape).invalid_reason;
}

Metrics score(const MultiPolygon& result, const MultiPolygon& ground_truth) {
  const Geos geos;
  if (ground_truth.empty())
    throw std::runtime_error("the ground truth is empty; there is nothing to score against");
  const Checked truth = check(geos, ground_truth);
  if (!truth.invalid_reason.empty()) {
    throw std::runtime_error("the ground truth is not a valid multipolygon: " + truth.invalid_reason);
  }
  const Checked shape = check(geos, result);

  Metrics metrics;
  metrics.valid = shape.invalid_reason.empty();
  metrics.invalid_reason = shape.invalid_reason;
  // Records hold no NaN: a shape with a coordinate that is not finite has no area, and its reason says why.
  const double area = polylidar::area(result);
  metrics.area = std::isfinite(area) ? area : 0;
  metrics.ground_truth_area = area_of(geos, truth.geometry);
  metrics.ground_truth_convexity = convexity_of(geos, truth.geometry);
  metrics.polygons = result.size();
  for (const Polygon& polygon : result) metrics.holes += polygon.holes.size();
  metrics.vertices = polylidar::vertex_count(result);
  if (!metrics.valid) return metrics;

  const Geometry difference =
      geos.own(GEOSSymDifference_r(geos.context(), truth.geometry.get(), shape.geometry.get()),
               "symmetric difference");
  const double apart = area_of(geos, difference);
  // What is in one of two shapes only is the sum of their areas less twice what they share, so a second
  // overlay would tell nothing new.
  const double shared = std::max(0.0, (metrics.ground_truth_area + metrics.area - apart) / 2);
  metrics.symmetric_difference_area = apart;
  metrics.l2 = ratio(apart, metrics.ground_truth_area);
  metrics.l2_paper = ratio(apart, metrics.area);
  metrics.iou = ratio(shared, shared + apart);
  return metrics;
}

}  // namespace hullbench
