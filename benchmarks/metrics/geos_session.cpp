#include "benchmarks/metrics/geos_session.hpp"

#include <stdexcept>
#include <vector>

namespace hullbench::metrics {
namespace {

/// Hands over geometries to GEOS, which then owns them even when it fails.
std::vector<GEOSGeometry*> release(std::vector<GeosSession::Geometry>& geometries) {
  std::vector<GEOSGeometry*> raw;
  raw.reserve(geometries.size());
  for (GeosSession::Geometry& geometry : geometries) raw.push_back(geometry.release());
  return raw;
}

}  // namespace

GeosSession::GeosSession() : context_(GEOS_init_r()) {
  if (context_ == nullptr) throw std::runtime_error("GEOS could not be started");
  GEOSContext_setErrorMessageHandler_r(context_, &GeosSession::keep_message, &message_);
}

GeosSession::~GeosSession() {
  GEOS_finish_r(context_);
}

void GeosSession::keep_message(const char* message, void* place) {
  *static_cast<std::string*>(place) = message;
}

GeosSession::Geometry GeosSession::own(GEOSGeometry* geometry, const char* operation) const {
  if (geometry == nullptr) fail(operation);
  return Geometry(geometry, DestroyGeometry{context_});
}

void GeosSession::fail(const std::string& operation) const {
  throw std::runtime_error("GEOS failed in " + operation + ": " + message_);
}

GeosSession::Geometry GeosSession::make_ring(const Ring& ring) const {
  if (ring.empty()) throw std::runtime_error("a ring without points is no geometry");
  const auto size = static_cast<unsigned>(ring.size());
  GEOSCoordSequence* sequence = GEOSCoordSeq_create_r(context_, size + 1, 2);
  if (sequence == nullptr) fail("making a ring");
  for (unsigned i = 0; i <= size; ++i) {
    const Point& point = ring[i % size];
    GEOSCoordSeq_setXY_r(context_, sequence, i, point.x, point.y);
  }
  return own(GEOSGeom_createLinearRing_r(context_, sequence), "making a ring");
}

GeosSession::Geometry GeosSession::make_polygon(const Polygon& polygon) const {
  Geometry shell = make_ring(polygon.shell);
  std::vector<Geometry> holes;
  for (const Ring& hole : polygon.holes) holes.push_back(make_ring(hole));
  std::vector<GEOSGeometry*> raw_holes = release(holes);
  return own(GEOSGeom_createPolygon_r(context_, shell.release(), raw_holes.data(),
                                      static_cast<unsigned>(raw_holes.size())),
             "making a polygon");
}

GeosSession::Geometry GeosSession::make_multi_polygon(const MultiPolygon& shape) const {
  std::vector<Geometry> polygons;
  for (const Polygon& polygon : shape) polygons.push_back(make_polygon(polygon));
  std::vector<GEOSGeometry*> raw = release(polygons);
  return own(
      GEOSGeom_createCollection_r(context_, GEOS_MULTIPOLYGON, raw.data(), static_cast<unsigned>(raw.size())),
      "making a multipolygon");
}

GeosSession::Geometry GeosSession::clone(const Geometry& geometry) const {
  return own(GEOSGeom_clone_r(context_, geometry.get()), "copying a geometry");
}

double GeosSession::area(const Geometry& geometry) const {
  double area = 0;
  if (GEOSArea_r(context_, geometry.get(), &area) != 1) fail("computing an area");
  return area;
}

double GeosSession::common_area(const Geometry& a, const Geometry& b) const {
  return area(own(GEOSIntersection_r(context_, a.get(), b.get()), "intersection"));
}

}  // namespace hullbench::metrics
