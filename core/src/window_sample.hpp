// Samples the triangles in a few small windows, without triangulating all points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cell_numbers.hpp"
#include "delaunay_builder.hpp"
#include "number_counts.hpp"
#include "point_passes.hpp"
#include "polylidar/geometry.hpp"
#include "thread_pool.hpp"

namespace polylidar::detail {

/// Windows are squares. Each has the points in it and in a margin round it. A triangle belongs to the window
/// that has its circumcentre, so all sizes have the same chance. Triangles whose circle is no wider than the
/// margin are exactly those of the triangulation of all points. Some wider ones may be missing or wrong.
///
/// look() takes a few windows, drawn with a probability in proportion to the number of points there: enough
/// if the density is the same everywhere. look_by_places() divides the box into squares, the places, and
/// takes one window of each.
class WindowSample {
 public:
  /// Few points get fewer windows, as each window costs the same.
  static constexpr std::size_t kMostWindows = 27;
  /// With fewer points a sample is not worth its time.
  static constexpr std::size_t kLeastPoints = 7'500;
  /// With fewer there are too few places to follow a density.
  static constexpr std::size_t kLeastPointsForPlaces = std::size_t{1} << 18U;

  /// The triangles of about so many windows are kept.
  static constexpr std::size_t kMostKept = 256;

  struct Measured {
    double size4;            ///< fourth power of the triangle's size
    double twice_area;       ///< its doubled area
    double squared_radius;   ///< its circumradius, squared
    double squared_longest;  ///< its longest edge, squared
  };
  struct Place {
    double usual4;  ///< the fourth power of the usual size in its window; infinity if that has few triangles
    double points;  ///< how many do not repeat others, as far as the window tells
  };

  /// The settings of look().
  struct Wanted {
    double most_spread;  ///< standard deviation of the logarithm of the spacing, beside what chance makes
    double margin;       ///< of a window, in spacings of the points
    double quantile;     ///< of a window's sizes, which is its usual one
  };

  /// The settings of look_by_places().
  struct WantedPlaces {
    double margin;    ///< of a window whose triangles are kept, in spacings of the points of its place
    double quantile;  ///< of a window's sizes, which is its usual one
    double points_in_circle;  ///< of a triangle that counts as wide, where the points are densest
  };

  /// Looks at points whose box is `box`. Returns false if their density varies by more than `wanted`
  /// allows, if there are fewer than kLeastPoints, or if they are few and their outline is long. There is no
  /// sample then. The result does not depend on the order of the points or the number of threads, nor, apart
  /// from rounding, on their position and unit. O(n), a pass or two.
  bool look(const PointPasses& points, const Box& box, const Wanted& wanted, ThreadPool& pool);

  /// After look() of the same points, whatever it returned: looks at a window of each place. Returns false if
  /// there are fewer than kLeastPointsForPlaces, or if the density varies by so much that triangles are often
  /// as large where the points are sparse as wide ones are where they are densest. The result depends on the
  /// same as that of look(). O(n), a pass.
  bool look_by_places(const PointPasses& points, const WantedPlaces& wanted, ThreadPool& pool);
  /// After look_by_places() returned true, as the next two: place -> what was found in its window, which has
  /// the same number.
  const std::vector<Place>& places() const { return places_; }
  /// The pairs of places with points in cells that touch.
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& borders() const { return borders_; }
  /// Puts the place of each of `some` of the points into `places`, which has room for them; kNone for one
  /// that was not among those looked at and lies where none of them does. Returns whether there is no such
  /// one. All must lie in the box.
  bool places_of(std::span<const Point> some, std::uint32_t* places) const;

  /// After a look: window -> one past its last triangle in triangles(). Some windows may have few triangles,
  /// or none. Of many windows only every kept_step()-th has its triangles there.
  const std::vector<std::size_t>& window_ends() const { return window_ends_; }
  const std::vector<Measured>& triangles() const { return triangles_; }
  std::size_t kept_step() const { return windows_.size() / kMostKept + 1; }
  /// The fourth powers of the usual sizes of the windows that have enough triangles.
  const std::vector<double>& usual4() const { return usual4_; }
  /// After look(): the width of the margin.
  double margin() const { return margin_; }
  /// The share of the points that do not repeat others.
  double distinct_share() const { return distinct_share_; }

 private:
  struct Window {
    Point centre;
    double half_side = 0;   ///< with the margin
    double half_inner = 0;  ///< without
    std::span<const Point> points;
    std::size_t distinct = 0;   ///< of the points
    std::size_t triangles = 0;  ///< their number
    std::optional<double> usual4;
  };
  /// The memory of one share of the points.
  struct Share {
    std::vector<std::pair<std::uint32_t, Point>> gathered;  ///< window and point
    std::vector<Measured> triangles;                        ///< of its windows, in order
    DelaunayBuilder builder;
    std::vector<double> sizes4;
    ThreadPool this_thread;
  };

  /// Where a place lies, and what is in it.
  struct PlaceCells {
    std::uint32_t row;  ///< its lowest
    std::uint32_t column;
    std::uint32_t side;     ///< so many cells in a row
    std::uint32_t typical;  ///< a cell with as many points as are usual inside the shape
    std::uint64_t points;
  };

  bool count_cells(const PointPasses& points, const Box& box);
  void add_up_points(const PointPasses& points);
  template <class Visit>
  void for_each_inside_cell(const Visit& visit) const;
  double usual_count(std::uint64_t points, double most_spread);
  void place_windows(std::uint64_t points, std::size_t windows, double half_side);
  bool is_wide_rare(std::uint64_t points, double points_in_circle) const;
  bool is_smooth() const;
  void divide(std::uint64_t points);
  void find_borders();
  double place_window_of_each(const WantedPlaces& wanted);
  template <class IsReached, class ForEachWindow>
  std::size_t gather(const PointPasses& points, std::size_t most, const IsReached& is_reached,
                     const ForEachWindow& for_each_window);
  void measure_windows(double quantile, ThreadPool& pool);
  static void measure(Window& window, double quantile, Share& share);

  std::uint32_t column(double x) const {
    return static_cast<std::uint32_t>((x - minimum_.x) * cells_per_length_);
  }
  std::uint32_t row(double y) const {
    return static_cast<std::uint32_t>((y - minimum_.y) * cells_per_length_);
  }
  CellNumbering numbering() const { return {minimum_, cells_per_length_, columns_, 0}; }

  Point minimum_;
  double cells_per_length_ = 0;
  std::uint32_t columns_ = 0;
  std::uint32_t rows_ = 0;
  std::vector<std::uint32_t> counts_;                    ///< cell, row by row -> how many points
  std::deque<std::vector<std::uint32_t>> other_counts_;  ///< the same, while several threads count
  bool are_counted_ = false;                             ///< whether counts_ is of the last points
  std::vector<std::uint64_t> windows_of_cell_;           ///< cell -> bit w: window w reaches it
  std::vector<std::uint32_t> window_of_cell_;            ///< cell -> the window that reaches it, or kNone
  std::vector<std::uint32_t> place_of_cell_;             ///< cell -> its place, or kNone if it has no points
  std::vector<PlaceCells> cells_of_place_;
  std::vector<Window> windows_;
  std::vector<Point> points_of_windows_;  ///< window by window
  NumberCounts numbers_;                  ///< of points in the cells inside the shape
  std::deque<Share> shares_;
  std::vector<std::size_t> window_ends_;
  std::vector<Measured> triangles_;
  std::vector<double> usual4_;
  std::vector<Place> places_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> borders_;
  double margin_ = 0;
  double distinct_share_ = 1;
};

}  // namespace polylidar::detail
