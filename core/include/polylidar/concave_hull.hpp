// The whole pipeline, from points to a multipolygon.
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
/// and all must hold. A limit of kNoLimit is not tested; if all are, the shape is the convex hull.
struct Limits {
  double alpha = kNoLimit;            ///< largest circumradius
  double max_edge_length = kNoLimit;  ///< longest edge
  double max_perimeter = kNoLimit;    ///< largest perimeter

  /// Limit by limit.
  friend bool operator==(const Limits&, const Limits&) = default;
};

/// The limit that is chosen if none is given: the largest size of a triangle, which varies from place to
/// place. A triangle's size is a length in the unit of the points: (4 / sqrt 3 e^2 A)^(1/4) with area A and
/// second-longest edge e, or e / 2 if that is more. The size of an equilateral triangle is its edge.
struct ChosenSizes {
  double least = 0;   ///< where the points are densest
  double median = 0;  ///< not exceeded in half of the places, which all have about as many points
  double most = 0;    ///< where they are sparsest

  /// Value by value.
  friend bool operator==(const ChosenSizes&, const ChosenSizes&) = default;
};

/// What shape to extract. If no limit is given, one is chosen from the points, place by place
/// (core/AUTOMATIC.md says how, Extractor::chosen_sizes() what it was). If one is given, the others are
/// kNoLimit.
struct Options {
  /// Largest circumradius of a kept triangle, in the length unit of the points; >= 0. The paper's alpha
  /// (section III-B): 2 * sqrt(area / number of points) suits uniform samples of a shape of known area.
  std::optional<double> alpha = std::nullopt;
  /// Longest edge of a kept triangle, in the length unit of the points; >= 0. The paper's l_max.
  std::optional<double> max_edge_length = std::nullopt;
  /// Largest perimeter of a kept triangle, in the length unit of the points; >= 0. A compromise between the
  /// two: of triangles with equal longest edges it prefers a sliver, as along the outline, to one that spans
  /// a hole.
  std::optional<double> max_perimeter = std::nullopt;
  /// How much detail the outline has if the limit is chosen; > 0 and finite, no unit. Twice the detail halves
  /// the largest size of a triangle: it finds holes and notches half as wide, but also more that are due to
  /// chance. More detail makes every limit smaller. Two things may come back all the same: the inside of a
  /// hole, where the triangles round it have become others, and small regions, where no large one is left
  /// beside them. Ignored if a limit is given.
  double detail = 1;
  /// Whether to keep a triangle beyond a limit if its three neighbours are within it: random points leave
  /// such holes of one triangle by chance. Default: true if the limit is chosen, false if one is given.
  std::optional<bool> fill_single_triangles = std::nullopt;
  /// How many threads to use, including the caller's; >= 1, and above 1024 no more are used. The result is
  /// the same bit for bit. An Extractor keeps its threads waiting until another number above 1 is asked for.
  /// Threads save time from about 10,000 points on. Throws std::system_error if the system refuses a thread.
  unsigned threads = 1;

  /// Field by field.
  friend bool operator==(const Options&, const Options&) = default;
};

/// What a hull must have. The limit is widened until it does (polylidar/widened_hull.hpp). If both are asked
/// for, the hull first covers all points.
struct Wanted {
  bool cover = false;  ///< no point is outside
  /// What the limit gave before is in one polygon, and only that one is kept. A wider limit may add parts
  /// that lie apart from it; these are dropped. If the limit gave nothing, that polygon covers all points.
  bool one = false;

  /// Field by field.
  friend bool operator==(const Wanted&, const Wanted&) = default;
};

/// A multipolygon as three flat arrays. Its vertices are indices into the caller's points. Every polygon is
/// valid in the sense of OGC 06-103r4; shells run counter-clockwise, holes clockwise; the first vertex of a
/// ring is not repeated.
///
/// A ring starts at its vertex of the lowest index. Polygons are sorted by the first vertex of their shells,
/// the holes of a polygon by their first vertices; second vertices break ties. So each shape has exactly one
/// listing.
struct IndexedMultiPolygon {
  /// Indices into the caller's points, ring after ring.
  std::vector<std::uint32_t> vertices;
  /// ring r is vertices[ring_ends[r - 1] .. ring_ends[r]), the first one starting at 0.
  std::vector<std::uint32_t> ring_ends;
  /// polygon p is rings[polygon_ends[p - 1] .. polygon_ends[p]), shell first, then its holes.
  std::vector<std::uint32_t> polygon_ends;

  /// How many polygons there are.
  std::size_t polygon_count() const { return polygon_ends.size(); }
  /// Makes it empty, but keeps its memory.
  void clear();

  /// Compares index by index in the listed order, not as shapes.
  friend bool operator==(const IndexedMultiPolygon&, const IndexedMultiPolygon&) = default;
};

/// `shape` with coordinates instead of indices. `points` are the points that it was made from.
MultiPolygon to_coordinates(const IndexedMultiPolygon& shape, std::span<const Point> points);

/// The concave hull of `points` (the paper's Polylidar, sections III-A to III-D): Delaunay triangulation,
/// triangles filtered by `options`, edge-connected regions, one polygon for each region. O(n log n).
///
/// Points may come in any order and may repeat; the lowest index stands for equal points. The result is empty
/// if there are fewer than 3 distinct points, if all lie on a line, or if no triangle is kept. Throws
/// std::invalid_argument if a coordinate is not finite (naming the first such index), if coordinates span
/// more than the supported range (see Extractor), if an option is out of its range, or if there are more than
/// 2^28 points.
IndexedMultiPolygon concave_hull(std::span<const Point> points, const Options& options = {},
                                 const Wanted& wanted = {});

/// One label's shape.
struct LabelledHull {
  std::int64_t label = 0;     ///< as the caller gave it
  IndexedMultiPolygon shape;  ///< by indices into all points
};

/// A concave hull for every label, by ascending label. Point i belongs to labels[i]. Each hull is made by
/// concave_hull() from the points with its label only, so hulls may overlap. The threads share the labels.
/// O(n log n). Throws as concave_hull, with indices into all points, and std::invalid_argument if there are
/// not as many labels as points.
std::vector<LabelledHull> concave_hulls(std::span<const Point> points, std::span<const std::int64_t> labels,
                                        const Options& options = {}, const Wanted& wanted = {});

/// How a shape was extracted. It changes the time, not the result.
enum class Way : std::uint8_t {
  kInteriorLeftOut,     ///< only what is near the outline was triangulated
  kWhole,               ///< all points were triangulated: asked for, or only all triangles say the limit
  kFewPoints,           ///< all points were: there are too few for a part to save time
  kExtremeCoordinates,  ///< all points were: their coordinates had to be scaled
  kTooSparse,           ///< all points were: the limit is too small for their spacing, or they are on a line
                        ///< parallel to an axis
  kMuchOutline,         ///< all points were: too many of them are near an outline to save time
  kClosePoints,         ///< all points were: two may be so close that rounding of circumradii decides
  kRoundingDecides,     ///< all points were: rounding decides whether some triangle is kept
  kReachesFar,          ///< all points were: dropped triangles reach beyond the part
};

/// What an extraction did.
struct Statistics {
  Way way = Way::kWhole;                ///< how it was done
  std::size_t points = 0;               ///< points given
  std::size_t uncertain_points = 0;     ///< may be on the outline; `points` if all were triangulated
  std::size_t triangulated_points = 0;  ///< these and their neighbours; `points` if all were triangulated
  /// Whether the shape is what outlines enclose, because no limit was given and all points lie on outlines.
  /// Sizes did not decide then.
  bool by_outlines = false;
  /// If by_outlines: the longest distance between neighbours on an outline, a length in the unit of the
  /// points; kNoLimit if all points lie on their convex hull, which is the shape then. 0 if sizes decided.
  double outline_step = 0;
};

/// concave_hull() that keeps its memory between calls, for callers that extract again and again. Do not use
/// one from several threads at once. `extract` gives the same result as the three steps in order, which can
/// be called one by one to time them.
///
/// If it can, `extract` leaves the interior out: it triangulates only the points near the outline
/// (statistics() says whether it did). `triangulate` always triangulates all points. After an `extract` that
/// left the interior out, extract_regions() and count_triangles() triangulate all points first. So before
/// calling one of these two, keep the points given to `extract` in place.
///
/// Points and options are checked before anything is computed: std::invalid_argument leaves the extractor
/// unchanged. After any other exception (no memory, no thread) the next call must be extract or triangulate.
///
/// Supported range: the extractor scales all coordinates by one common power of two; after that each must be
/// zero or have a magnitude between 2^-116 and 2^150. In this range no product in the exact predicates and
/// the filter can overflow or underflow.
class Extractor {
 public:
  /// Starts no thread; threads and memory for points come with the first call.
  Extractor();
  /// Ends the threads that were started.
  ~Extractor();
  /// A moved-from extractor can only be assigned to or destroyed.
  Extractor(Extractor&&) noexcept;
  /// As the constructor.
  Extractor& operator=(Extractor&&) noexcept;

  /// All three steps, with the contract of concave_hull(). The result is valid until the next call.
  const IndexedMultiPolygon& extract(std::span<const Point> points, const Options& options = {});

  /// Step 1: the Delaunay triangulation of `points`, on `threads` >= 1 threads.
  void triangulate(std::span<const Point> points, unsigned threads = 1);
  /// Step 2: the kept triangles and their edge-connected regions.
  void extract_regions(const Options& options);
  /// After extract or extract_regions: the limits that were given, in the unit of the points; all are
  /// kNoLimit if none was given.
  Limits limits() const;
  /// After extract or extract_regions: the limit that was chosen; none if one was given or there is no
  /// triangle.
  std::optional<ChosenSizes> chosen_sizes() const;
  /// Step 3: the boundary of every region as a polygon.
  const IndexedMultiPolygon& extract_polygons();

  /// After triangulate: whether there is a triangle, that is, three distinct points not on a line. O(n) if
  /// there is none.
  bool has_triangles() const;
  /// After extract_polygons: the number of triangles in each polygon, in the same order. O(n), but O(n log n)
  /// after an extract() that left the interior out, because all points are triangulated for it.
  std::vector<std::size_t> count_triangles() const;
  /// After extract, triangulate or extract_regions: how it was done.
  const Statistics& statistics() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace polylidar
