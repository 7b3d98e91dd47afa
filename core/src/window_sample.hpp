// The triangles in a few small windows, without a triangulation of all points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "delaunay_builder.hpp"
#include "polylidar/geometry.hpp"
#include "thread_pool.hpp"

namespace polylidar::detail {

/// Squares at places that are drawn by the number of points there, each with the points in it and in a margin
/// round it. A triangle counts to the window in which its circumcentre lies, so that no size has a better
/// chance than another. A triangle whose circle is no wider than the margin, one of all points' triangulation
/// too, is there for sure; of wider ones some may be missing, and others be there instead.
class WindowSample {
 public:
  /// Of few points there are fewer, as each costs as much.
  static constexpr std::size_t kMostWindows = 27;
  /// From how many points on a sample is worth its time.
  static constexpr std::size_t kLeastPoints = 7'500;

  struct Measured {
    double size4;           ///< fourth power of the triangle's size
    double twice_area;      ///< its doubled area
    double squared_radius;  ///< its circumradius, squared
  };

  /// What look() goes by.
  struct Wanted {
    double most_spread;  ///< standard deviation of the logarithm of the spacing, beside what chance makes
    double margin;       ///< of a window, in spacings of the points
    double quantile;     ///< of a window's sizes, which is its usual one
  };

  /// Looks at `points`, whose box is `box`. Returns false where their density differs from place to place by
  /// more than `wanted` allows: then there is nothing to look at; nor is there of fewer than kLeastPoints, or
  /// of few whose outline is long. The same for any order of the points, any number of threads, and for other
  /// places and units but for rounding. O(n), a pass or two.
  bool look(std::span<const Point> points, const Box& box, const Wanted& wanted, ThreadPool& pool);

  /// After look() said yes: window -> one past its last triangle in triangles(). Of some windows there may be
  /// few, or none.
  const std::vector<std::size_t>& window_ends() const { return window_ends_; }
  const std::vector<Measured>& triangles() const { return triangles_; }
  /// The fourth powers of the windows' usual sizes, of those with enough triangles to tell.
  const std::vector<double>& usual4() const { return usual4_; }
  /// The width of the margin.
  double margin() const { return margin_; }
  /// The share of the points that do not repeat others.
  double distinct_share() const { return distinct_share_; }

 private:
  struct Window {
    Point centre;
    std::vector<Point> points;
    std::size_t distinct = 0;  ///< of the points
    std::vector<Measured> triangles;
    std::optional<double> usual4;
  };
  /// What one thread needs.
  struct Share {
    std::vector<std::uint32_t> counts;                      ///< as counts_, of a part of the points
    std::vector<std::pair<std::uint32_t, Point>> gathered;  ///< window and point
    DelaunayBuilder builder;
    std::vector<double> sizes4;
    ThreadPool this_thread;
  };

  bool count_cells(std::span<const Point> points, const Box& box, ThreadPool& pool);
  double usual_count(std::size_t points, double most_spread);
  void place_windows(std::size_t points, std::size_t windows, double half_side);
  std::size_t gather(std::span<const Point> points, double half_side, std::size_t most, ThreadPool& pool);
  static void measure(Window& window, double half_inner, double quantile, Share& share);
  std::span<const Point> share_of(std::span<const Point> points, std::size_t share) const {
    const std::size_t begin = points.size() * share / shares_.size();
    return points.subspan(begin, points.size() * (share + 1) / shares_.size() - begin);
  }

  std::uint32_t column(double x) const {
    return static_cast<std::uint32_t>((x - minimum_.x) * cells_per_length_);
  }
  std::uint32_t row(double y) const {
    return static_cast<std::uint32_t>((y - minimum_.y) * cells_per_length_);
  }

  Point minimum_;
  double cells_per_length_ = 0;
  std::uint32_t columns_ = 0;
  std::uint32_t rows_ = 0;
  std::vector<std::uint32_t> counts_;           ///< cell, row by row -> how many points
  std::vector<std::uint64_t> windows_of_cell_;  ///< cell -> bit w: window w reaches it
  std::vector<Window> windows_;
  std::vector<double> scratch_;
  std::deque<Share> shares_;
  std::vector<std::size_t> window_ends_;
  std::vector<Measured> triangles_;
  std::vector<double> usual4_;
  double margin_ = 0;
  double distinct_share_ = 1;
};

}  // namespace polylidar::detail
