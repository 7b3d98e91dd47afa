// Points -> multipolygon: the whole pipeline.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "polylidar/geometry.hpp"

namespace polylidar {

/// A limit that every triangle is within.
inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// How large a triangle of the shape may be, in the length unit of the points; >= 0. The limits are inclusive
/// and all must hold; one of kNoLimit is not tested. With all at kNoLimit the shape is the convex hull.
struct Limits {
  double alpha = kNoLimit;            ///< largest circumradius
  double max_edge_length = kNoLimit;  ///< longest edge
  double max_perimeter = kNoLimit;    ///< largest perimeter

  /// Limit by limit.
  friend bool operator==(const Limits&, const Limits&) = default;
};

/// The limit that is chosen where none is given: the largest size of a triangle, place by place. A triangle's
/// size is a length: (4 / sqrt 3 e^2 A)^(1/4) with its area A and its second-longest edge e, or e / 2 where
/// that is more; of an equilateral triangle it is the edge. In the unit of the points.
struct ChosenSizes {
  double least = 0;   ///< where the points are densest
  double median = 0;  ///< in half of the places, each of which has about the same number of points
  double most = 0;    ///< where they are sparsest

  /// Value by value.
  friend bool operator==(const ChosenSizes&, const ChosenSizes&) = default;
};

/// What shape to extract. Where no limit is given, one is chosen from the points alone, place by place (how:
/// src/automatic_limit.hpp; what: Extractor::chosen_sizes()). Where one is given, those that are not are
/// kNoLimit.
struct Options {
  /// Largest circumradius of a kept triangle, in the length unit of the points; >= 0. The paper's alpha
  /// (section III-B): 2 * sqrt(area / number of points) suits uniform samples of a shape of known area.
  std::optional<double> alpha = std::nullopt;
  /// Longest edge of a kept triangle, in the length unit of the points; >= 0. The paper's l_max.
  std::optional<double> max_edge_length = std::nullopt;
  /// Largest perimeter of a kept triangle, in the length unit of the points; >= 0. Between the two: of
  /// triangles with equal longest edges it keeps the sliver, as one along the outline is, before the one that
  /// spans a hole.
  std::optional<double> max_perimeter = std::nullopt;
  /// How much of the outline is kept where the limit is chosen; > 0 and finite, no unit. Twice the detail
  /// keeps triangles of half the size: holes and notches of half the width are found, and more by chance. A
  /// larger one never adds a triangle. Not used where a limit is given.
  double detail = 1;
  /// Whether a triangle beyond a limit is kept all the same when its three neighbours are within: points that
  /// are spread at random leave such holes of one triangle by chance. Not given: true where the limit is
  /// chosen, false where one is given.
  std::optional<bool> fill_single_triangles = std::nullopt;
  /// How many threads to use, the caller's among them; >= 1. The result is the same bit for bit. An
  /// Extractor keeps the threads it has started, waiting, until another number above 1 is asked for. Threads
  /// are worth their start from some 10,000 points on. std::system_error when the system refuses one.
  unsigned threads = 1;

  /// Field by field.
  friend bool operator==(const Options&, const Options&) = default;
};

/// A multipolygon whose vertices are the caller's points, by index: three flat arrays. Every polygon is valid
/// in the sense of OGC 06-103r4; shells run counter-clockwise, holes clockwise; the first vertex of a ring is
/// not repeated.
///
/// A ring starts at its vertex of the lowest index. Polygons come in the order of their shells' first
/// vertices, the holes of a polygon in that of theirs; where two start at one vertex, their second vertices
/// decide. One shape therefore has one way to be listed.
struct IndexedMultiPolygon {
  /// Indices into the caller's points, ring after ring.
  std::vector<std::uint32_t> vertices;
  /// ring r is vertices[ring_ends[r - 1] .. ring_ends[r]), the first one starting at 0.
  std::vector<std::uint32_t> ring_ends;
  /// polygon p is rings[polygon_ends[p - 1] .. polygon_ends[p]), shell first, then its holes.
  std::vector<std::uint32_t> polygon_ends;

  /// How many polygons there are.
  std::size_t polygon_count() const { return polygon_ends.size(); }
  /// Makes it empty; its memory is kept.
  void clear();

  /// Index by index in the order they are listed, not as shapes.
  friend bool operator==(const IndexedMultiPolygon&, const IndexedMultiPolygon&) = default;
};

/// `shape` with coordinates instead of indices. `points` are those that it was made of.
MultiPolygon to_coordinates(const IndexedMultiPolygon& shape, std::span<const Point> points);

/// The concave hull of `points` (the paper's Polylidar, sections III-A to III-D): Delaunay triangulation,
/// triangles filtered by `options`, edge-connected regions, one polygon a region. O(n log n).
///
/// Points may come in any order and may repeat; of equal points the lowest index is used. Fewer than 3
/// distinct points, points all on a line, or no triangle kept: an empty multipolygon. Throws
/// std::invalid_argument when a coordinate is not finite (naming the first such index), when coordinates span
/// more than the supported range (see Extractor), or when an option is negative or NaN. At most 2^28 points
/// (std::invalid_argument beyond).
IndexedMultiPolygon concave_hull(std::span<const Point> points, const Options& options = {});

/// One label's shape.
struct LabelledHull {
  std::int64_t label = 0;     ///< as the caller gave it
  IndexedMultiPolygon shape;  ///< by indices into all points
};

/// A concave hull for every label: point i belongs to labels[i]. By ascending label; each is that of its
/// points alone, as concave_hull() makes it, so shapes of different labels may overlap. Labels are shared
/// among the threads. O(n log n). Throws as concave_hull, with indices into all points, and
/// std::invalid_argument where there are not as many labels as points.
std::vector<LabelledHull> concave_hulls(std::span<const Point> points, std::span<const std::int64_t> labels,
                                        const Options& options = {});

/// How a shape was extracted. The result does not depend on it; the time does.
enum class Way : std::uint8_t {
  kInteriorLeftOut,     ///< only what is near the outline was triangulated
  kWhole,               ///< all points were triangulated: asked for, or the limit is chosen place by place
  kFewPoints,           ///< all points were: they are too few to gain by less
  kExtremeCoordinates,  ///< all points were: their coordinates had to be scaled
  kTooSparse,           ///< all points were: the limit is too small for their distances
  kMuchOutline,         ///< all points were: most of them are near an outline
  kClosePoints,         ///< all points were: two may be so close that the rounding of circumradii decides
  kRoundingDecides,     ///< all points were: the rounding of a triangle's size decides whether it is kept
  kSmallLimit,          ///< all points were: the limit that was chosen is too small for what was triangulated
  kReachesFar,          ///< all points were: what is dropped reaches beyond what would be triangulated
};

/// What an extraction did.
struct Statistics {
  Way way = Way::kWhole;                ///< how
  std::size_t points = 0;               ///< that were given
  std::size_t uncertain_points = 0;     ///< that may be on the outline; `points` where all were triangulated
  std::size_t triangulated_points = 0;  ///< those and their neighbours; `points` where all were triangulated
  /// Whether no limit was given and the points lie on outlines only, so that the shape is what these enclose.
  /// Sizes did not decide then.
  bool by_outlines = false;
};

/// concave_hull() with memory that is kept between calls, for callers that extract again and again. Not for
/// use from several threads at once. `extract` gives what the three steps give in order; they can be called
/// one by one to be timed.
///
/// `extract` leaves the interior out where it can (statistics() says whether): it triangulates the points
/// near the outline only. `triangulate` always triangulates all points, and what needs all triangles after an
/// `extract` that left some out triangulates all points then: extract_regions() and count_triangles(). Until
/// the next `extract` or `triangulate` the points given to `extract` must therefore stay where they are if
/// one of these two is called.
///
/// Points and options are checked before anything is computed: std::invalid_argument leaves an extractor as
/// it was before the call. After any other exception (no memory, no thread) the next call must be extract or
/// triangulate.
///
/// Supported range: every coordinate is zero or has a magnitude between 2^-116 and 2^150 after scaling all of
/// them by one common power of two (which the extractor does by itself); inside it no product that the exact
/// predicates and the filter form can overflow or underflow.
class Extractor {
 public:
  /// Starts no thread; threads and memory for points come with the first call.
  Extractor();
  /// Ends the threads that were started.
  ~Extractor();
  /// What was moved from can only be assigned to or destroyed.
  Extractor(Extractor&&) noexcept;
  /// As the constructor.
  Extractor& operator=(Extractor&&) noexcept;

  /// All three steps, with the contract of concave_hull(). The result is valid until the next call.
  const IndexedMultiPolygon& extract(std::span<const Point> points, const Options& options = {});

  /// Step 1: the Delaunay triangulation of `points`, on `threads` >= 1 threads.
  void triangulate(std::span<const Point> points, unsigned threads = 1);
  /// Step 2: the kept triangles and their edge-connected regions.
  void extract_regions(const Options& options);
  /// After extract_regions: the limits that were given, in the unit of the points; where none was, all are
  /// kNoLimit.
  Limits limits() const;
  /// After extract_regions: the limit that was chosen; none where one was given or there is no triangle.
  std::optional<ChosenSizes> chosen_sizes() const;
  /// Step 3: the boundary of every region as a polygon.
  const IndexedMultiPolygon& extract_polygons();

  /// After triangulate: whether there is a triangle: three distinct points that are not on a line. O(n) when
  /// there is none.
  bool has_triangles() const;
  /// After extract_polygons: how many triangles each of its polygons is made of, in its order. O(n), but
  /// O(n log n) after an extract() that left the interior out, as all points are triangulated for it.
  std::vector<std::size_t> count_triangles() const;
  /// After extract, triangulate or extract_regions: how it was done.
  const Statistics& statistics() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace polylidar
