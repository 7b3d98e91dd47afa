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
#include "polylidar/widened_hull.hpp"

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
                       double detail, std::optional<bool> fill_single_triangles, bool cover, bool one,
                       unsigned threads) {
  const std::span<const Point> points = points_of(array);
  polylidar::IndexedMultiPolygon shape;
  std::optional<polylidar::ChosenSizes> sizes;
  double area = 0;
  {
    const py::gil_scoped_release other_threads_may_run;
    polylidar::Extractor extractor;
    const polylidar::Options options = {.alpha = alpha,
                                        .max_edge_length = max_edge_length,
                                        .max_perimeter = max_perimeter,
                                        .detail = detail,
                                        .fill_single_triangles = fill_single_triangles,
                                        .threads = threads};
    shape = cover || one
                ? polylidar::widened_hull(extractor, points, options, {.cover = cover, .one = one}).shape
                : extractor.extract(points, options);
    sizes = extractor.chosen_sizes();
    area = polylidar::area(polylidar::to_coordinates(shape, points));
  }
  return py::make_tuple(
      to_array(std::move(shape.vertices)), to_array(std::move(shape.ring_ends)),
      to_array(std::move(shape.polygon_ends)), area,
      sizes ? py::object(py::make_tuple(sizes->least, sizes->median, sizes->most)) : py::object(py::none()));
}

/// (label, vertices, ring_ends, polygon_ends, area) of every label.
py::list concave_hulls(const PointArray& array,
                       const py::array_t<std::int64_t, py::array::c_style>& label_array,
                       const std::optional<double>& alpha, const std::optional<double>& max_edge_length,
                       const std::optional<double>& max_perimeter, double detail,
                       const std::optional<bool>& fill_single_triangles, bool cover, bool one,
                       unsigned threads) {
  const std::span<const Point> points = points_of(array);
  if (label_array.ndim() != 1) throw py::value_error("labels must have the shape (n,)");
  const std::span<const std::int64_t> labels(label_array.data(),
                                             static_cast<std::size_t>(label_array.size()));
  std::vector<polylidar::LabelledHull> hulls;
  std::vector<double> areas;
  {
    const py::gil_scoped_release other_threads_may_run;
    hulls = polylidar::concave_hulls(points, labels,
                                     {.alpha = alpha,
                                      .max_edge_length = max_edge_length,
                                      .max_perimeter = max_perimeter,
                                      .detail = detail,
                                      .fill_single_triangles = fill_single_triangles,
                                      .threads = threads},
                                     {.cover = cover, .one = one});
    for (const polylidar::LabelledHull& hull : hulls) {
      areas.push_back(polylidar::area(polylidar::to_coordinates(hull.shape, points)));
    }
  }
  py::list result;
  for (std::size_t h = 0; h < hulls.size(); ++h) {
    polylidar::IndexedMultiPolygon& shape = hulls[h].shape;
    result.append(py::make_tuple(hulls[h].label, to_array(std::move(shape.vertices)),
                                 to_array(std::move(shape.ring_ends)),
                                 to_array(std::move(shape.polygon_ends)), areas[h]));
  }
  return result;
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
  module.def(
      "concave_hull", &concave_hull, py::arg("points").noconvert(), py::arg("alpha"),
      py::arg("max_edge_length"), py::arg("max_perimeter"), py::arg("detail"),
      py::arg("fill_single_triangles"), py::arg("cover"), py::arg("one"), py::arg("threads"),
      "The arrays vertices, ring_ends and polygon_ends of the shape, its area, and the least, the median "
      "and the largest size that was chosen, or None.");
  module.def("concave_hulls", &concave_hulls, py::arg("points").noconvert(), py::arg("labels").noconvert(),
             py::arg("alpha"), py::arg("max_edge_length"), py::arg("max_perimeter"), py::arg("detail"),
             py::arg("fill_single_triangles"), py::arg("cover"), py::arg("one"), py::arg("threads"),
             "Of every label the label, the three arrays of its shape, and its area.");
  module.def("delaunay", &delaunay, py::arg("points").noconvert(), "The triangles, three indices a row.");
}
