// SFCGAL's alpha shape, which PostGIS's ST_OptimalAlphaShape and ST_AlphaShape call, by its C API.
//
// The library is loaded when the method is first made, not when the program starts: no other method's worker
// then has it in its memory, and the CGAL templates that it exports meet none of those compiled here.
//
// Degenerate input: fewer than 3 distinct points, or points all on a line, give an empty multipolygon without
// a call of SFCGAL, which crashes on them. Of fewer than 4 points SFCGAL makes nothing.
//
// SFCGAL (1.4.1 and 2.0) puts all shells into one ring and all holes into another, and leaves out a ring of
// three vertices: where the shape falls apart, has several holes or touches itself in a vertex, its polygon
// is not valid. It is given as it is.
#include <SFCGAL/capi/sfcgal_c.h>
#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "adapters/adapter.hpp"

namespace hullbench {
namespace {

/// No shape has triangles within an alpha of 0, so that the number is free to mean this.
constexpr double kNotGiven = 0;
/// For infinity, which SFCGAL's exact numbers do not have.
constexpr double kLargest = std::numeric_limits<double>::max();

/// What SFCGAL said last; it has one handler for the whole process.
std::string& last_error() {
  static std::string message;
  return message;
}

extern "C" {

int keep_error(const char* format, ...) {
  std::array<char, 1024> text{};
  std::va_list arguments;
  va_start(arguments, format);
  const int length = std::vsnprintf(text.data(), text.size(), format, arguments);
  va_end(arguments);
  last_error() = text.data();
  return length;
}

int ignore_warning(const char* /*format*/, ...) {
  return 0;
}

}  // extern "C"

/// The functions of the C API, out of the library that is loaded here and stays.
struct Sfcgal {
  decltype(&::sfcgal_init) init;
  decltype(&::sfcgal_version) version;
  decltype(&::sfcgal_set_error_handlers) set_error_handlers;
  decltype(&::sfcgal_geometry_delete) destroy;
  decltype(&::sfcgal_geometry_type_id) type_id;
  decltype(&::sfcgal_multi_point_create) create_multi_point;
  decltype(&::sfcgal_geometry_collection_add_geometry) add_geometry;
  decltype(&::sfcgal_point_create_from_xy) create_point;
  decltype(&::sfcgal_geometry_alpha_shapes) alpha_shapes;
  decltype(&::sfcgal_geometry_optimal_alpha_shapes) optimal_alpha_shapes;
  decltype(&::sfcgal_polygon_exterior_ring) exterior_ring;
  decltype(&::sfcgal_polygon_num_interior_rings) interior_ring_count;
  decltype(&::sfcgal_polygon_interior_ring_n) interior_ring;
  decltype(&::sfcgal_linestring_num_points) point_count;
  decltype(&::sfcgal_linestring_point_n) point;
  decltype(&::sfcgal_point_x) x;
  decltype(&::sfcgal_point_y) y;

  /// Throws NotInstalled when the library is not there or lacks a function.
  Sfcgal() {
    void* library = ::dlopen(SFCGAL_LIBRARY, RTLD_NOW | RTLD_LOCAL);
    const auto bind = [&](auto& function, const char* name) {
      void* found = library == nullptr ? nullptr : ::dlsym(library, name);
      if (found == nullptr) {
        throw NotInstalled(std::string("SFCGAL cannot be loaded: ") + ::dlerror(), SFCGAL_REMEDY);
      }
      function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(found);
    };
    bind(init, "sfcgal_init");
    bind(version, "sfcgal_version");
    bind(set_error_handlers, "sfcgal_set_error_handlers");
    bind(destroy, "sfcgal_geometry_delete");
    bind(type_id, "sfcgal_geometry_type_id");
    bind(create_multi_point, "sfcgal_multi_point_create");
    bind(add_geometry, "sfcgal_geometry_collection_add_geometry");
    bind(create_point, "sfcgal_point_create_from_xy");
    bind(alpha_shapes, "sfcgal_geometry_alpha_shapes");
    bind(optimal_alpha_shapes, "sfcgal_geometry_optimal_alpha_shapes");
    bind(exterior_ring, "sfcgal_polygon_exterior_ring");
    bind(interior_ring_count, "sfcgal_polygon_num_interior_rings");
    bind(interior_ring, "sfcgal_polygon_interior_ring_n");
    bind(point_count, "sfcgal_linestring_num_points");
    bind(point, "sfcgal_linestring_point_n");
    bind(x, "sfcgal_point_x");
    bind(y, "sfcgal_point_y");
    init();
    set_error_handlers(&ignore_warning, &keep_error);
  }
};

MethodInfo describe(const Sfcgal& sfcgal) {
  MethodInfo info;
  info.name = "sfcgal_alpha_shape";
  info.title = "SFCGAL alpha shape";
  info.version = sfcgal.version();
  info.licence = "LGPL-2.0-or-later AND GPL-3.0-or-later";  // CGAL's alpha shapes are in it
  info.citation =
      "SFCGAL, sfcgal_geometry_optimal_alpha_shapes; PostGIS manual, ST_OptimalAlphaShape; the method: H. "
      "Edelsbrunner, D. Kirkpatrick, R. Seidel, On the Shape of a Set of Points in the Plane, IEEE "
      "Transactions on Information Theory 29(4), 1983";
  info.native_output = "polygon";
  info.parameters = {
      {.name = "alpha",
       .unit = "length^2",
       .description = "Largest squared circumradius of a triangle inside the shape; 0: not given, SFCGAL "
                      "takes the least that leaves one polygon round all points.",
       .minimum = 0,
       .maximum = std::numeric_limits<double>::infinity(),
       .default_value = kNotGiven},
      off_switch("allow_holes", "Whether the polygon may have holes.")};
  info.capabilities = {.holes = true, .several_polygons = false};
  return info;
}

class SfcgalAlphaShape final : public Adapter {
 public:
  SfcgalAlphaShape() { info_ = describe(sfcgal_); }

 private:
  using Geometry = std::unique_ptr<sfcgal_geometry_t, decltype(&::sfcgal_geometry_delete)>;

  void do_load(std::span<const Point> points) override {
    points_.reset();
    if (!has_area()) return;
    points_ = own(sfcgal_.create_multi_point());
    for (const Point& point : points) {
      sfcgal_.add_geometry(points_.get(), sfcgal_.create_point(point.x, point.y));
    }
  }

  void do_run(const Parameters& parameters, Steps& /*steps*/) override {
    const double alpha = parameters.at("alpha");
    const bool allow_holes = parameters.at("allow_holes") == 1;
    if (!points_) return;
    last_error().clear();
    shape_ =
        own(alpha == kNotGiven ? sfcgal_.optimal_alpha_shapes(points_.get(), allow_holes, 1)
                               : sfcgal_.alpha_shapes(points_.get(), std::min(alpha, kLargest), allow_holes));
    if (!shape_ && last_error().find("bad_alloc") != std::string::npos) throw std::bad_alloc();
    if (!shape_) throw std::runtime_error("SFCGAL gave no shape: " + last_error());
  }

  MultiPolygon do_extract(Steps& /*steps*/) override {
    // A collection is SFCGAL's word for nothing, as is a polygon without a shell.
    if (!shape_ || sfcgal_.type_id(shape_.get()) != SFCGAL_TYPE_POLYGON) return {};
    Polygon polygon = {.shell = ring_of(sfcgal_.exterior_ring(shape_.get()), true), .holes = {}};
    if (polygon.shell.empty()) return {};
    const std::size_t holes = sfcgal_.interior_ring_count(shape_.get());
    for (std::size_t i = 0; i < holes; ++i) {
      polygon.holes.push_back(ring_of(sfcgal_.interior_ring(shape_.get(), i), false));
    }
    return {std::move(polygon)};
  }

  void do_reset() override { shape_.reset(); }

  Geometry own(sfcgal_geometry_t* geometry) const { return {geometry, sfcgal_.destroy}; }

  /// Without the repeated first point, counter-clockwise or not.
  Ring ring_of(const sfcgal_geometry_t* line, bool counter_clockwise) const {
    const std::size_t count = sfcgal_.point_count(line);
    Ring ring;
    ring.reserve(count);
    for (std::size_t i = 0; i + 1 < count; ++i) {
      const sfcgal_geometry_t* point = sfcgal_.point(line, i);
      ring.push_back({sfcgal_.x(point), sfcgal_.y(point)});
    }
    if ((polylidar::signed_area(ring) > 0) != counter_clockwise) std::reverse(ring.begin(), ring.end());
    return ring;
  }

  Sfcgal sfcgal_;
  Geometry points_ = own(nullptr);  // none: points without an area
  Geometry shape_ = own(nullptr);   // of the last run; none: points without an area
};

}  // namespace

std::unique_ptr<Adapter> make_sfcgal_alpha_shape() {
  return std::make_unique<SfcgalAlphaShape>();
}

}  // namespace hullbench
