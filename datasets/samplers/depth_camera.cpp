#include "datasets/samplers/depth_camera.hpp"

#include <algorithm>
#include <cmath>

#include "datasets/rgbd/floor_scenes.hpp"
#include "polylidar/point_locator.hpp"

namespace hullbench {

using polylidar::Box;
using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::PointLocator;

namespace {

/// The pixels of an image that sees the whole shape, with a margin of one on every side.
class PixelGrid {
 public:
  PixelGrid(double low_row, double high_row, double low_column, double high_column)
      : first_row_(std::ceil(low_row)),
        first_column_(std::ceil(low_column)),
        rows_(count_between(low_row, high_row)),
        columns_(count_between(low_column, high_column)) {}

  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return columns_; }
  /// With the margin.
  std::size_t size() const { return (rows_ + 2) * width(); }
  std::size_t width() const { return columns_ + 2; }
  std::size_t at(std::size_t row, std::size_t column) const { return (row + 1) * width() + column + 1; }

  /// In the image, from the optical axis.
  double v(const DepthShot& shot, std::size_t row) const {
    return first_row_ + static_cast<double>(row) + shot.row_offset;
  }
  double u(const DepthShot& shot, std::size_t column) const {
    return first_column_ + static_cast<double>(column) + shot.column_offset;
  }

 private:
  /// How many whole numbers there are from `low` to `high`.
  static std::size_t count_between(double low, double high) {
    return static_cast<std::size_t>(std::max(std::floor(high) - std::ceil(low) + 1, 0.0));
  }

  double first_row_;
  double first_column_;
  std::size_t rows_;
  std::size_t columns_;
};

/// A shot without points, half the shape's extent in front of it.
DepthShot place_camera(const MultiPolygon& shape, double turns, double pitch, double level, Random& random) {
  const ScanFrame frame(shape, turns);
  const Box& box = frame.bounds();
  const double extent = box.max.x - box.min.x;
  DepthShot shot{.frame = frame,
                 .foot = {box.min.x - extent / 2, (box.min.y + box.max.y) / 2},
                 .view = {.distance = extent, .height = extent / level},
                 .row_offset = random.uniform(),
                 .column_offset = random.uniform(),
                 .points = {}};
  // At the middle a row is slant / height columns deep.
  DepthView& view = shot.view;
  const double slant = std::sqrt(view.distance * view.distance + view.height * view.height);
  view.focal = slant / (pitch * std::sqrt(view.height / slant));
  return shot;
}

PixelGrid pixels_of(const DepthShot& shot) {
  const Box& box = shot.frame.bounds();
  const double extent = shot.view.distance;
  // The near side is the widest in the image.
  const Point near_left = {extent / 2, (box.max.y - box.min.y) / 2};
  const double far_column = shot.view.column(near_left);
  return {shot.view.row(near_left) - shot.row_offset, shot.view.row({1.5 * extent, 0}) - shot.row_offset,
          -far_column - shot.column_offset, far_column - shot.column_offset};
}

Point in_plane(const DepthShot& shot, const Point& place) {
  return shot.frame.in_plane({shot.foot.x + place.x, shot.foot.y + place.y});
}

/// By pixel of the grid: 1 where it sees the shape. (std::vector<bool> packs bits, which is slower.)
std::vector<unsigned char> find_shape(const MultiPolygon& shape, const DepthShot& shot,
                                      const PixelGrid& grid) {
  const PointLocator locator(shape);
  std::vector<unsigned char> is_floor(grid.size());
  for (std::size_t row = 0; row < grid.rows(); ++row) {
    for (std::size_t column = 0; column < grid.columns(); ++column) {
      const Point point = in_plane(shot, shot.view.seen(grid.v(shot, row), grid.u(shot, column)));
      is_floor[grid.at(row, column)] = locator.contains(point) ? 1 : 0;
    }
  }
  return is_floor;
}

bool is_edge(const std::vector<unsigned char>& is_floor, std::size_t pixel, std::size_t width) {
  return is_floor[pixel - 1] == 0 || is_floor[pixel + 1] == 0 || is_floor[pixel - width] == 0 ||
         is_floor[pixel + width] == 0;
}

/// Of variance 1, when `white` is, over the nine pixels of a matching window: neighbours share two thirds.
double window_noise(const std::vector<double>& white, std::size_t pixel, std::size_t width) {
  double sum = 0;
  for (const std::size_t middle : {pixel - width, pixel, pixel + width}) {
    sum += white[middle - 1] + white[middle] + white[middle + 1];
  }
  return sum / 3;
}

}  // namespace

// With the optical axis and the image's up at right angles to it, a floor point `forward` of the foot has the
// depth (forward * distance + height^2) / slant along the axis, and height * (forward - distance) / slant
// across it.

double DepthView::slant() const {
  return std::sqrt(distance * distance + height * height);
}

double DepthView::depth(double forward) const {
  return (forward * distance + height * height) / slant();
}

double DepthView::row(const Point& place) const {
  return focal * (height * (place.x - distance) / slant()) / depth(place.x);
}

double DepthView::column(const Point& place) const {
  return focal * place.y / depth(place.x);
}

double DepthView::disparity(double forward) const {
  return focal * (kDepthBaseline * distance) / depth(forward);
}

Point DepthView::place(double row, double column) const {
  const double forward = height * (row * height + focal * distance) / (focal * height - row * distance);
  return {forward, column * depth(forward) / focal};
}

Point DepthView::seen(double row, double column) const {
  const double stretch = 1 + kLensDistortion * ((row * row + column * column) / (focal * focal));
  return place(row * stretch, column * stretch);
}

DepthShot take_depth_shot(const MultiPolygon& shape, double turns, double pitch, double level,
                          Random& random) {
  const SensorNoise sensor;
  DepthShot shot = place_camera(shape, turns, pitch, level, random);
  const PixelGrid grid = pixels_of(shot);
  const std::vector<unsigned char> is_floor = find_shape(shape, shot, grid);
  std::vector<double> white(grid.size());
  for (double& one : white) one = random.normal();
  for (std::size_t row = 0; row < grid.rows(); ++row) {
    for (std::size_t column = 0; column < grid.columns(); ++column) {
      const std::size_t pixel = grid.at(row, column);
      if (is_floor[pixel] == 0) continue;
      if (is_edge(is_floor, pixel, grid.width()) && random.uniform() < sensor.edge_dropout) continue;
      const double disparity = shot.view.disparity(shot.view.seen(grid.v(shot, row), grid.u(shot, column)).x);
      const double wrong = disparity + sensor.subpixel_error * window_noise(white, pixel, grid.width());
      const double measured = sensor.disparity_step * std::round(wrong / sensor.disparity_step);
      // So few pixels of disparity come with a coarse image only; the depth would be anything.
      if (measured < disparity / 2) continue;
      // A wrong depth moves the point along the pixel's ray; on the floor that is the line through the foot.
      const Point taken_for = shot.view.place(grid.v(shot, row), grid.u(shot, column));
      const double stretch = shot.view.disparity(taken_for.x) / measured;
      shot.points.push_back(in_plane(shot, {stretch * taken_for.x, stretch * taken_for.y}));
    }
  }
  return shot;
}

std::vector<Point> sample_depth_camera(const MultiPolygon& shape, std::size_t n, double level,
                                       std::uint64_t seed) {
  return scan_exactly(shape, n, derive_seed(seed, "depthcamera"), [&](double pitch, Random& random) {
    const double turns = random.uniform();
    return take_depth_shot(shape, turns, pitch, level, random).points;
  });
}

}  // namespace hullbench
