// The concave hull of points that do not fit into memory, by one machine or by many.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "polylidar/concave_hull.hpp"

namespace polylidar {

/// What takes a block of points; it does not keep the span.
using TakePoints = std::function<void(std::span<const Point>)>;
/// Reads points from the first to the last and hands them to `take`, in blocks of some thousand to some
/// million: a file. It is called several times and gives the same points each time, in the same order.
using PointSource = std::function<void(const TakePoints& take)>;

/// How far a stream has come.
struct StreamProgress {
  int pass = 0;              ///< which pass over the source, from 1 on
  int passes = 4;            ///< of how many, as far as is known yet; other where no limit is given
  std::uint64_t points = 0;  ///< of the source, in this pass
};

/// What is said of all points of a stream before they are read, such as in the header of a file.
struct ExpectedPoints {
  std::uint64_t count = 0;  ///< how many
  Box box;                  ///< round them, as bounding_box() gives it
};

/// What of a stream is not in Options.
struct StreamOptions {
  /// The most that the map of occupied cells may take, in bytes; of a shard, that of its band. It makes up
  /// most of the memory where points are many and the outline is short. Points that are kept to save a pass
  /// may take what the map leaves, up to six bytes for each point of the source.
  double most_map_bytes = 0x1p30;
  /// Called after each block, by one thread at a time; may throw, which ends the work.
  std::function<void(const StreamProgress&)> progress = {};
  /// Where no limit is given and the shape is found by the triangulation of all points, up to so many are put
  /// into memory for that, with some 150 bytes each; for more, NeedsAllPoints is thrown.
  std::uint64_t most_points_in_memory = 0;
  /// Whether different sources may be read at the same time, each by one of Options::threads threads. It is
  /// fastest with as many sources as threads, such as parts of a file. Not for shards.
  bool reads_at_once = false;
  /// Saves a pass if it is true: so many points, and exactly this box. If it is not, the result is the same
  /// and no pass is saved. Not for shards.
  std::optional<ExpectedPoints> expected = {};
};

/// The concave hull of a source.
struct StreamedHull {
  /// As to_coordinates() gives it.
  MultiPolygon polygons;
  /// The numbers of the points that are its vertices, ring after ring in the order of `polygons`; the first
  /// point of the source has the number 0.
  std::vector<std::uint64_t> vertices;
  std::uint64_t points = 0;               ///< of the source
  Box box = bounding_box({});             ///< of these points
  std::uint64_t triangulated_points = 0;  ///< near the outline
  /// If no limit was given: the sizes that a triangle of the shape may have, as Extractor::chosen_sizes().
  std::optional<ChosenSizes> chosen_sizes;
  bool by_outlines = false;  ///< Statistics::by_outlines
};

/// Thrown where no limit is given and the shape cannot be found without more points in memory than are
/// allowed.
class NeedsAllPoints : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// The concave hull of all points of `sources`, which are one after the other as one source. They are read
/// three times: where the points are, which cells of a grid they occupy, and which of them may be on the
/// outline (core/INTERIOR.md). The last time, all points that may be near the outline are kept. If they are
/// more than a quarter of all, or take more than 256 MB or than StreamOptions::most_map_bytes has room for,
/// the sources are read a fourth time to find them. If no limit is given, the sources are read two or three
/// times more after the first time: how many points are where, and which lie in small windows
/// (core/AUTOMATIC.md). With StreamOptions::expected they are read once less. Memory: some bits a cell of a
/// sixth of the limit's radius, and 125 bytes a point near the outline.
///
/// The result is that of concave_hull() for the same points in memory, with one exception: where two
/// different points are closer than 2^-40 of `alpha`, rounding may there drop slivers that are kept here. Up
/// to 65,536 points are put into memory. At most 2^28 points may be near the outline.
///
/// Throws NeedsAllPoints where no limit is given, and the density varies so much, or the points are so
/// clustered or so few, that the limit is chosen by the triangulation of all of them, or `detail` is so large
/// that the shape depends on triangles far from its outline, and the points are more than
/// StreamOptions::most_points_in_memory. Throws std::invalid_argument as concave_hull; where coordinates
/// would have to be scaled (see Extractor); where the limit is too small for the distances between the
/// points, so that the maps would be too large or too much is near the outline; or where the rounding of a
/// triangle's size decides whether it is kept (a slightly different limit helps). std::runtime_error where
/// it is noticed that a source gives other points than the time before; and what a source throws.
StreamedHull concave_hull_of_stream(std::span<const PointSource> sources, const Options& options,
                                    const StreamOptions& stream_options = {});
/// The same of one source.
StreamedHull concave_hull_of_stream(const PointSource& source, const Options& options,
                                    const StreamOptions& stream_options = {});

/// One of several runs over the same source, which may be on different machines.
struct Shard {
  std::uint32_t number = 1;  ///< from 1 to `count`
  std::uint32_t count = 1;   ///< how many there are

  /// Both.
  friend bool operator==(const Shard&, const Shard&) = default;
};

/// What a shard found: the points near the outline that lie in its band. The box of all points is cut into as
/// many bands of rows as there are shards, all of the same height to within a row of cells, a sixth of the
/// limit's radius; what each keeps in memory while it reads is then the same, too.
struct StreamShard {
  Shard shard;                          ///< which of how many
  Options options;                      ///< that it was asked for; `threads` may differ between shards
  std::uint64_t source_points = 0;      ///< how many points the source has
  std::uint64_t source_checksum = 0;    ///< of their numbers and coordinates; finds changes by accident only
  Box box;                              ///< of all points; of none, as bounding_box()
  double cells_per_length = 0;          ///< of the grid; 0 where none was needed
  std::vector<Point> points;            ///< by ascending number
  std::vector<std::uint64_t> numbers;   ///< of each of `points`, among all points of the source
  std::vector<std::uint8_t> uncertain;  ///< for each of `points`, whether it may be on the outline: 1 or 0
};

/// Reads `sources`, which are one after the other as one source, as concave_hull_of_stream does, and finds a
/// shard's part of what that would triangulate (core/INTERIOR.md, "Many machines"). Each shard reads all
/// points once, and two or three more times those sources, such as the tiles of a cloud, that reach into its
/// band or 4 radii beyond it; its maps have the cells of these rows. Up to 65,536 points are all in the first
/// shard; of more, `options` must give a limit.
///
/// Throws as concave_hull_of_stream, and std::invalid_argument where there is no such shard. Whether the
/// rounding of a triangle's size decides is not known yet.
StreamShard part_of_stream(std::span<const PointSource> sources, const Options& options, const Shard& shard,
                           const StreamOptions& stream_options = {});

/// What concave_hull_of_stream gives for the source and the options of these shards, bit by bit; `points` are
/// the source's. They may come in any order. Memory: 25 bytes a point of theirs and 125 bytes for the
/// triangulation; `threads` as in Options.
///
/// Throws std::invalid_argument where a shard is missing or there twice, where they differ in their options,
/// source or grid, where their points cannot be those of one source, and where the rounding of a triangle's
/// size decides.
StreamedHull concave_hull_of_shards(std::span<const StreamShard> shards, unsigned threads = 1);

}  // namespace polylidar
