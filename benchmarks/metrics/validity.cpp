#include "benchmarks/metrics/validity.hpp"

#include <cmath>
#include <sstream>

#include "benchmarks/metrics/checked_shape.hpp"

namespace hullbench::metrics {
namespace {

std::string place_of(const Point& point) {
  std::ostringstream text;
  text << '[' << point.x << ' ' << point.y << ']';
  return text.str();
}

/// Faults that keep GEOS from making a geometry at all; in the words it has for the others.
std::string fault_of_ring(const Ring& ring) {
  if (ring.empty()) return "Ring without points";
  if (ring.size() < 3) return "Too few points in ring" + place_of(ring.front());
  for (const Point& point : ring) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) return "Invalid Coordinate" + place_of(point);
  }
  return {};
}

std::string fault_before_geos(const MultiPolygon& shape) {
  for (const Polygon& polygon : shape) {
    if (std::string fault = fault_of_ring(polygon.shell); !fault.empty()) return fault;
    for (const Ring& hole : polygon.holes) {
      if (std::string fault = fault_of_ring(hole); !fault.empty()) return fault;
    }
  }
  return {};
}

}  // namespace

CheckedShape check_shape(const GeosSession& geos, const MultiPolygon& shape) {
  CheckedShape checked;
  checked.invalid_reason = fault_before_geos(shape);
  if (!checked.invalid_reason.empty()) return checked;
  checked.geometry = geos.make_multi_polygon(shape);
  const char valid = GEOSisValid_r(geos.context(), checked.geometry.get());
  if (valid == 1) return checked;
  if (valid != 0) geos.fail("testing validity");
  char* reason = GEOSisValidReason_r(geos.context(), checked.geometry.get());
  if (reason == nullptr) geos.fail("testing validity");
  checked.invalid_reason = reason;
  GEOSFree_r(geos.context(), reason);
  return checked;
}

std::string invalid_reason(const MultiPolygon& shape) {
  return check_shape(GeosSession(), shape).invalid_reason;
}

}  // namespace hullbench::metrics
