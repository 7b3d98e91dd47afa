// GEOS's ConcaveHull: the Delaunay triangulation eroded from its border, by length ratio or by edge length.
//
// One parameter decides, and one must be given: GEOS's functions have no default.
#include <geos_c.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "adapters/adapter.hpp"
#include "adapters/geos_hull_by_length.hpp"
#include "adapters/wkb.hpp"

namespace hullbench {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// "3.11.1-CAPI-1.17.1" -> "3.11.1".
std::string geos_version() {
  const std::string version = GEOSversion();
  return version.substr(0, version.find('-'));
}

MethodInfo describe() {
  MethodInfo info;
  info.name = "geos_concave_hull";
  info.title = "GEOS concave hull";
  info.version = geos_version();
  info.licence = "LGPL-2.1-or-later";
  info.citation =
      "M. Davis, ConcaveHull, JTS Topology Suite and GEOS, documentation of class "
      "geos::algorithm::hull::ConcaveHull, https://libgeos.org";
  info.native_output = "polygon";
  info.parameters = {
      {.name = "length_ratio",
       .unit = "ratio",
       .description = "Longest edge of the hull, from the triangulation's shortest edge (0) to its longest "
                      "(1, the convex hull); infinity: not given, and max_edge_length must be.",
       .minimum = 0,
       .maximum = 1,
       .default_value = kInfinity},
      length_limit("max_edge_length",
                   "Longest edge of the hull; infinity: not given, and length_ratio must be.", kInfinity),
      off_switch("allow_holes", "Whether the hull may have holes.")};
  info.capabilities = {.holes = true, .several_polygons = false};
  return info;
}

// GEOS as a session: its context and what it last complained of.
class GeosSession {
 public:
  GeosSession() : context_(GEOS_init_r()) {
    if (context_ == nullptr) throw std::runtime_error("GEOS could not be started");
    GEOSContext_setErrorMessageHandler_r(context_, &GeosSession::keep_message, &message_);
  }
  ~GeosSession() { GEOS_finish_r(context_); }
  GeosSession(const GeosSession&) = delete;
  GeosSession& operator=(const GeosSession&) = delete;

  GEOSContextHandle_t get() const { return context_; }

  struct Destroy {
    GEOSContextHandle_t context;
    void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(context, geometry); }
    void operator()(GEOSWKBReader* reader) const { GEOSWKBReader_destroy_r(context, reader); }
    void operator()(GEOSWKBWriter* writer) const { GEOSWKBWriter_destroy_r(context, writer); }
    void operator()(unsigned char* bytes) const { GEOSFree_r(context, bytes); }
  };
  template <class T>
  using Owned = std::unique_ptr<T, Destroy>;

  // Takes what GEOS made; GEOS answers null when it fails.
  template <class T>
  Owned<T> own(T* made, const char* operation) const {
    if (made == nullptr) {
      if (message_.find("bad_alloc") != std::string::npos) throw std::bad_alloc();
      throw std::runtime_error(std::string("GEOS failed in ") + operation + ": " + message_);
    }
    return Owned<T>(made, Destroy{context_});
  }

 private:
  static void keep_message(const char* message, void* place) { *static_cast<std::string*>(place) = message; }

  GEOSContextHandle_t context_;
  std::string message_;
};

class GeosConcaveHull final : public Adapter {
 public:
  GeosConcaveHull() { info_ = describe(); }

 private:
  template <class T>
  using Owned = GeosSession::Owned<T>;

  void do_load(std::span<const Point> points) override {
    points_.reset();
    const std::vector<std::uint8_t> wkb = to_wkb_multipoint(points);
    const auto reader = session_.own(GEOSWKBReader_create_r(session_.get()), "making a reader");
    points_ = session_.own(GEOSWKBReader_read_r(session_.get(), reader.get(), wkb.data(), wkb.size()),
                           "reading the points");
  }

  void do_run(const Parameters& parameters, Steps& steps) override {
    const double ratio = parameters.at("length_ratio");
    const double length = parameters.at("max_edge_length");
    const bool allow_holes = parameters.at("allow_holes") != 0;
    const bool by_length = std::isfinite(length);
    if (by_length == std::isfinite(ratio)) {
      throw std::invalid_argument(
          "geos_concave_hull takes one of 'length_ratio' and 'max_edge_length': give " +
          std::string(by_length ? "only one of them" : "one, as GEOS has no default"));
    }
    if (!has_area()) return;
    steps.begin("shape");
    hull_ =
        session_.own(by_length ? geos_hull_by_length(session_.get(), points_.get(), length, allow_holes)
                               : GEOSConcaveHull_r(session_.get(), points_.get(), ratio, allow_holes ? 1 : 0),
                     "the concave hull");
  }

  MultiPolygon do_extract(Steps& steps) override {
    steps.begin("polygon");
    if (!hull_) return {};
    const auto writer = session_.own(GEOSWKBWriter_create_r(session_.get()), "making a writer");
    std::size_t size = 0;
    const auto wkb = session_.own(GEOSWKBWriter_write_r(session_.get(), writer.get(), hull_.get(), &size),
                                  "writing the hull");
    return from_wkb({wkb.get(), size});
  }

  void do_reset() override { hull_.reset(); }

  GeosSession session_;
  Owned<GEOSGeometry> points_{nullptr, {}};  // a multipoint
  Owned<GEOSGeometry> hull_{nullptr, {}};    // null: nothing has run, or the points have no area
};

}  // namespace

std::unique_ptr<Adapter> make_geos_concave_hull() {
  return std::make_unique<GeosConcaveHull>();
}

}  // namespace hullbench
