#include "benchmarks/hull/simplify.hpp"

#include <geos_c.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "adapters/wkb.hpp"
#include "benchmarks/metrics/validity.hpp"

namespace hullbench::hull {
namespace {

using Session = std::unique_ptr<GEOSContextHandle_HS, decltype(&GEOS_finish_r)>;

void keep_message(const char* message, void* to) {
  *static_cast<std::string*>(to) = message;
}

[[noreturn]] void fail(const std::string& why) {
  throw std::runtime_error("the shape cannot be simplified (" + why +
                           "); give --simplify a smaller distance or leave it out");
}

}  // namespace

polylidar::MultiPolygon simplify(const polylidar::MultiPolygon& shape, double tolerance) {
  const Session session(GEOS_init_r(), &GEOS_finish_r);
  GEOSContextHandle_t geos = session.get();
  std::string message;
  GEOSContext_setErrorMessageHandler_r(geos, &keep_message, &message);
  const auto destroy = [&](GEOSGeometry* geometry) { GEOSGeom_destroy_r(geos, geometry); };
  using Geometry = std::unique_ptr<GEOSGeometry, decltype(destroy)>;
  const std::vector<std::uint8_t> given = to_wkb(shape);
  const Geometry before(GEOSGeomFromWKB_buf_r(geos, given.data(), given.size()), destroy);
  if (!before) fail(message);
  const Geometry after(GEOSTopologyPreserveSimplify_r(geos, before.get(), tolerance), destroy);
  if (!after) fail(message);
  std::size_t size = 0;
  const auto free_bytes = [&](unsigned char* bytes) { GEOSFree_r(geos, bytes); };
  const std::unique_ptr<unsigned char, decltype(free_bytes)> bytes(
      GEOSGeomToWKB_buf_r(geos, after.get(), &size), free_bytes);
  if (!bytes) fail(message);
  polylidar::MultiPolygon simple = from_wkb({bytes.get(), size});
  const std::string fault = metrics::invalid_reason(simple);
  if (!fault.empty()) fail("GEOS made an invalid one of it: " + fault);
  return simple;
}

}  // namespace hullbench::hull
