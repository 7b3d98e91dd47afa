// polylidar_core._core: the core over numpy's memory. What is friendlier to people is in the package's Python
// files.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "polylidar/concave_hull.hpp"
#include "polylidar/delaunay.hpp"
#include "polylidar/geometry.hpp"

namespace {

namespace py = pybind11;
using polylidar::Point;

// Only arrays that are so already: converting one is the package's business, and seen there.
using PointArray = py::array_t<double, py::array::c_style>;

/// The array's own memory as points. Throws ValueError unless its shape is (n, 2).
std::span<const Point> points_of(const PointArray& array) {
  static_assert(sizeof(Point) == 2 * sizeof(double) && std::is_standard_layout_v<Point>);
  if (array.ndim() != 2 || array.shape(1) != 2) throw py::value_error("points must have the shape (n, 2)");
  return {reinterpret_cast<const Point*>(array.data()), static_cast<std::size_t>(array.shape(0))};
}

/// The memory of `values` as an array of this shape, which frees it.
py::array to_array(std::vector<std::uint32_t> values, const py::array::ShapeContainer& shape) {
  auto owned = std::make_unique<std::vector<std::uint32_t>>(std::move(values));
  const py::capsule owner(owned.get(), [](void* p) { delete static_cast<std::vector<std::uint32_t>*>(p); });
  return py::array_t<std::uint32_t>(shape, owned.release()->data(), owner);
}

py::array to_array(std::vector<std::uint32_t> values) {
  const auto size = static_cast<py::ssize_t>(values.size());
  return to_array(std::move(values), {size});
}

py::tuple concave_hull(const PointArray& array, std::optional<double> alpha,
                       std::optional<double> max_edge_length, std::optional<double> max_perimeter,
                       std::optional<bool> fill_single_triangles, unsigned threads) {
  const std::span<const Point> points = points_of(array);
  polylidar::IndexedMultiPolygon shape;
  polylidar::Limits limits;
  double area = 0;
  {
    const py::gil_scoped_release other_threads_may_run;
    polylidar::Extractor extractor;
    shape = extractor.extract(points, {.alpha = alpha,
                                       .max_edge_length = max_edge_length,
                                       .max_perimeter = max_perimeter,
                                       .fill_single_triangles = fill_single_triangles,
                                       .threads = threads});
    limits = extractor.limits();
    area = polylidar::area(polylidar::to_coordinates(shape, points));
  }
  return py::make_tuple(to_array(std::move(shape.vertices)), to_array(std::move(shape.ring_ends)),
                        to_array(std::move(shape.polygon_ends)), area,
                        py::make_tuple(limits.alpha, limits.max_edge_length, limits.max_perimeter));
}

py::array delaunay(const PointArray& array) {
  const std::span<const Point> points = points_of(array);
  polylidar::Triangulation triangulation;
  {
    const py::gil_scoped_release other_threads_may_run;
    triangulation = polylidar::delaunay(points);
  }
  const auto triangles = static_cast<py::ssize_t>(triangulation.triangles.size() / 3);
  return to_array(std::move(triangulation.triangles), {triangles, py::ssize_t{3}});
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.doc() = "The polylidar core over numpy's memory: see polylidar_core.";
  module.attr("__version__") = POLYLIDAR_VERSION;
  module.def("concave_hull", &concave_hull, py::arg("points").noconvert(), py::arg("alpha"),
             py::arg("max_edge_length"), py::arg("max_perimeter"), py::arg("fill_single_triangles"),
             py::arg("threads"),
             "The arrays vertices, ring_ends and polygon_ends of the shape, its area, and its limits: alpha, "
             "max_edge_length and max_perimeter.");
  module.def("delaunay", &delaunay, py::arg("points").noconvert(), "The triangles, three indices a row.");
}
