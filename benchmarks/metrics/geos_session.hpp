// GEOS for one call or thread: its context, its geometries, its errors as exceptions.
#pragma once

#include <geos_c.h>

#include <memory>
#include <string>

#include "benchmarks/base/names.hpp"

namespace hullbench::metrics {

/// A GEOS context. GEOS reports errors through a callback and a null or out-of-range return value; `fail`
/// turns them into an exception. Geometries end before the session they were made in. Not for use from
/// several threads at once: a geometry of another session may be cloned while other threads clone it too, but
/// nothing else, because GEOS keeps what it works out about a geometry inside it.
class GeosSession {
 public:
  struct DestroyGeometry {
    GEOSContextHandle_t context = nullptr;
    void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(context, geometry); }
  };
  using Geometry = std::unique_ptr<GEOSGeometry, DestroyGeometry>;

  /// Throws std::runtime_error when GEOS cannot be started.
  GeosSession();
  ~GeosSession();
  GeosSession(const GeosSession&) = delete;
  GeosSession& operator=(const GeosSession&) = delete;

  GEOSContextHandle_t context() const { return context_; }

  /// Takes what GEOS has made; fails when it is null.
  Geometry own(GEOSGeometry* geometry, const char* operation) const;

  /// Throws std::runtime_error with what GEOS last complained of.
  [[noreturn]] void fail(const std::string& operation) const;

  /// Every ring needs at least 3 points with finite coordinates; the rest may be wrong.
  Geometry make_ring(const Ring& ring) const;
  Geometry make_polygon(const Polygon& polygon) const;
  Geometry make_multi_polygon(const MultiPolygon& shape) const;

  Geometry clone(const Geometry& geometry) const;
  double area(const Geometry& geometry) const;
  /// Of what both cover. Both are valid.
  double common_area(const Geometry& a, const Geometry& b) const;

 private:
  static void keep_message(const char* message, void* place);

  GEOSContextHandle_t context_;
  std::string message_;
};

}  // namespace hullbench::metrics
