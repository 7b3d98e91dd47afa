// The hull of a stream is that of the same points in memory.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "polylidar/stream.hpp"
#include "tests/complaint.hpp"
#include "tests/point_sets.hpp"

namespace polylidar {
namespace {

using Points = std::vector<Point>;

constexpr const char* kOtherPoints = "the source has other points than when it was read before";
constexpr const char* kTooSmall =
    "the limit is too small for the distances between the points: give a larger one, or more memory";

// Points in memory, in blocks of one size; what it gives in the second pass may be other points.
class MemorySource {
 public:
  explicit MemorySource(Points points, std::size_t block = 10'000)
      : points_(std::move(points)), block_(block) {}

  StreamedHull hull(const Options& options, const StreamOptions& stream_options = {}) {
    return concave_hull_of_stream([this](const TakePoints& take) { read(take); }, options, stream_options);
  }
  StreamShard part(const Options& options, const Shard& shard, const StreamOptions& stream_options = {}) {
    const PointSource source = [this](const TakePoints& take) { read(take); };
    return part_of_stream({&source, 1}, options, shard, stream_options);
  }
  void change(int pass, Points to) {
    changes_in_pass_ = pass;
    changed_ = std::move(to);
  }
  int passes() const { return passes_; }

 private:
  void read(const TakePoints& take) {
    if (++passes_ == changes_in_pass_) points_ = changed_;
    for (std::size_t next = 0; next < points_.size(); next += block_) {
      take(std::span(points_).subspan(next, std::min(block_, points_.size() - next)));
    }
  }

  Points points_;
  std::size_t block_;
  int passes_ = 0;
  int changes_in_pass_ = 0;
  Points changed_;
};

std::string complaint(MemorySource& source, const Options& options,
                      const StreamOptions& stream_options = {}) {
  return hullbench::testing::complaint_of<std::exception>([&] { source.hull(options, stream_options); });
}

/// How many bytes the map takes, to within a fifth.
double map_bytes(MemorySource& source, const Options& options) {
  double bytes = 1000;
  while (complaint(source, options, {.most_map_bytes = bytes}) != hullbench::testing::kNoComplaint) {
    bytes *= 1.2;
    if (bytes > 1e9) throw std::runtime_error("no map is large enough");
  }
  return bytes;
}

/// The shards' parts, the last one first, each read in blocks of another size and by more threads.
std::vector<StreamShard> parts(const Points& points, Options options, std::uint32_t count,
                               const StreamOptions& stream_options = {}) {
  std::vector<StreamShard> shards;
  for (std::uint32_t number = count; number >= 1; --number) {
    options.threads = 1 + number % 2;
    shards.push_back(
        MemorySource(points, 5000 + 3777 * (number % 8)).part(options, {number, count}, stream_options));
  }
  return shards;
}

std::string complaint(std::span<const StreamShard> shards) {
  return hullbench::testing::complaint_of<std::invalid_argument>([&] { concave_hull_of_shards(shards); });
}

/// A square lattice with holes: four points on a circle everywhere, which the limits can tell apart.
Points lattice_with_holes(int side) {
  Points points;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const bool in_hole = std::hypot(x % 100 - 50, y % 90 - 40) < 17;
      if (!in_hole && (x * 7 + y * 13) % 31 != 0)
        points.push_back({static_cast<double>(x), static_cast<double>(y)});
    }
  }
  return points;
}

// `shape` is what `extractor` has just made of the points.
void expect_as_in_memory(const StreamedHull& hull, const Points& points, const Extractor& extractor,
                         const IndexedMultiPolygon& shape) {
  EXPECT_EQ(hull.polygons, to_coordinates(shape, points));
  EXPECT_TRUE(
      std::equal(hull.vertices.begin(), hull.vertices.end(), shape.vertices.begin(), shape.vertices.end()));
  EXPECT_EQ(hull.points, points.size());
  EXPECT_EQ(hull.box, bounding_box(points));
  EXPECT_EQ(hull.chosen_sizes, extractor.chosen_sizes());
  EXPECT_EQ(hull.by_outlines, extractor.statistics().by_outlines);
}

void expect_as_in_memory(const StreamedHull& hull, const Points& points, const Options& options) {
  Extractor extractor;
  const IndexedMultiPolygon& shape = extractor.extract(points, options);
  expect_as_in_memory(hull, points, extractor, shape);
}

TEST(Stream, GivesTheShapeOfThePointsInMemory) {
  std::size_t rings = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    testing::Random random(seed);
    Points points = testing::uniform_points(70'000 + random.below(60'000), seed);
    std::erase_if(points, [](const Point& p) {
      return std::hypot(p.x - 0.4, p.y - 0.5) < 0.1 || std::hypot(p.x - 0.7, p.y - 0.6) < 0.03;
    });
    if (seed % 3 == 0) points.insert(points.end(), points.begin(), points.begin() + 5000);
    const double spacing = 1 / std::sqrt(static_cast<double>(points.size()));
    Options options{.threads = 1 + static_cast<unsigned>(random.below(3))};
    if (seed % 2 == 0) options.max_perimeter = random.between(9, 25) * spacing;
    if (seed % 2 == 1) options.alpha = random.between(1.8, 5) * spacing;
    if (seed % 4 == 3) options.max_edge_length = 6 * spacing;
    options.fill_single_triangles = seed % 5 == 0;
    SCOPED_TRACE(seed);
    MemorySource source(points, 1 + random.below(30'000));
    const StreamedHull hull = source.hull(options);
    expect_as_in_memory(hull, points, options);
    EXPECT_LT(hull.triangulated_points, points.size() / 2);
    EXPECT_GE(source.passes(), 3);
    EXPECT_LE(source.passes(), 4);
    for (const Polygon& polygon : hull.polygons) rings += 1 + polygon.holes.size();
  }
  EXPECT_GT(rings, 36U) << "the shapes have holes";
}

/// Points in memory as `count` sources, the second of which has no points.
std::vector<PointSource> sources_of(const Points& points, std::size_t count, std::size_t block) {
  std::vector<PointSource> sources;
  const std::size_t with_points = std::max<std::size_t>(count, 2) - 1;
  for (std::size_t s = 0; s < count; ++s) {
    const std::size_t begin = s == 0 ? 0 : points.size() * std::max<std::size_t>(s - 1, 1) / with_points;
    const std::size_t end = points.size() * std::max<std::size_t>(s, 1) / with_points;
    sources.emplace_back([&points, begin, end, block](const TakePoints& take) {
      for (std::size_t next = begin; next < end; next += block) {
        take(std::span(points).subspan(next, std::min(block, end - next)));
      }
    });
  }
  return sources;
}

/// `count` points in a square with round holes, `ratio` times as dense at its right side as at its left.
Points square_with_holes(std::size_t count, double ratio, std::uint64_t seed) {
  return testing::points_where(count, seed, 1, 1, [&](const Point& p, testing::Random& random) {
    const bool is_in_hole = std::hypot(p.x - 0.4, p.y - 0.5) < 0.1 || std::hypot(p.x - 0.8, p.y - 0.2) < 0.05;
    return !is_in_hole && random.between(0, 1) * ratio < 1 + (ratio - 1) * p.x;
  });
}

TEST(Stream, ChoosesTheSizesThatAreChosenInMemory) {
  for (std::uint64_t seed = 0; seed < 9; ++seed) {
    SCOPED_TRACE(seed);
    const bool by_places = seed % 3 == 2;
    Points points = square_with_holes(by_places ? 300'000 : 90'000, by_places ? 3 : 1, seed);
    // Outliers, some triangles of which reach far.
    if (seed % 3 == 1) points.insert(points.end(), {{0.4, 0.52}, {1.2, 1.1}, {-0.1, 0.3}});
    if (seed % 4 == 3) points.insert(points.end(), points.begin(), points.begin() + 5000);
    const Options options{.detail = 0.7 + 0.1 * static_cast<double>(seed % 5),
                          .threads = 1 + static_cast<unsigned>(seed % 3)};
    MemorySource source(points, 20'000 + 3'000 * seed);
    const StreamedHull hull = source.hull(options);
    expect_as_in_memory(hull, points, options);
    EXPECT_LT(hull.triangulated_points, points.size() / 2);
    EXPECT_GE(source.passes(), 5);  // two for the sizes
  }
}

TEST(Stream, ReadsSourcesAtTheSameTime) {
  const Points points = square_with_holes(300'000, 3, 1);
  for (Options options : {Options{}, Options{.alpha = 0.01}}) {
    Extractor in_memory;
    const IndexedMultiPolygon& shape = in_memory.extract(points, options);
    for (const unsigned threads : {1U, 3U}) {
      for (const std::size_t count : {1U, 2U, 5U}) {
        SCOPED_TRACE(std::to_string(threads) + " threads, " + std::to_string(count) + " sources");
        const std::vector<PointSource> sources = sources_of(points, count, 7'777);
        options.threads = threads;
        std::uint64_t told = 0;
        const StreamedHull hull = concave_hull_of_stream(
            sources, options,
            {.progress = [&](const StreamProgress& progress) { told = progress.points; },
             .reads_at_once = true});
        expect_as_in_memory(hull, points, in_memory, shape);
        EXPECT_EQ(told, points.size());
      }
    }
  }
}

TEST(Stream, SaysWhatIsWrongOfSourcesAtTheSameTime) {
  Points points = testing::uniform_points(200'000, 4);
  const std::vector<PointSource> sources = sources_of(points, 5, 7'777);
  const auto complaint_of = [&](const StreamOptions& stream_options) {
    return hullbench::testing::complaint_of<std::exception>(
        [&] { concave_hull_of_stream(sources, {.threads = 2}, stream_options); });
  };
  points[154'321].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(complaint_of({.reads_at_once = true}), "point 154321 is not finite");
  points[154'321].y = 0.5;
  int pass = 0;
  const auto change = [&](const StreamProgress& progress) {
    if (progress.pass != 3 || std::exchange(pass, progress.pass) == 3) return;
    points[199'999].x = 2;
  };
  EXPECT_EQ(complaint_of({.progress = change, .reads_at_once = true}), kOtherPoints);
}

// The other sources end, too: they are not read in vain.
TEST(Stream, AnExceptionEndsAllSourcesThatAreReadAtTheSameTime) {
  const Points points = testing::uniform_points(400'000, 5);
  const std::size_t block = 1000;
  std::atomic<std::size_t> begun = 0;
  std::atomic<std::size_t> blocks = 0;
  std::vector<PointSource> sources = sources_of(points, 10, block);
  for (PointSource& source : sources) {
    source = [&begun, &blocks, read = source](const auto& take) {
      ++begun;
      while (begun < 2) std::this_thread::yield();  // so that another one is being read
      read([&](std::span<const Point> points_of_block) {
        ++blocks;
        take(points_of_block);
      });
    };
  }
  const auto give_up = [thrown = false](const StreamProgress& progress) mutable {
    if (progress.points < 20'000 || std::exchange(thrown, true)) return;
    throw std::runtime_error("given up");
  };
  EXPECT_EQ(hullbench::testing::complaint_of<std::runtime_error>([&] {
              concave_hull_of_stream(sources, {.threads = 2}, {.progress = give_up, .reads_at_once = true});
            }),
            "given up");
  EXPECT_GE(blocks, 20U);
  EXPECT_LE(blocks, 24U);  // of 400
}

// Points near the outline are kept when uncertain ones are looked for, as long as there is room for them.
TEST(Stream, ReadsThePointsOnceLessWhereThereIsMemory) {
  const Points points = square_with_holes(300'000, 1, 3);
  for (const bool at_once : {false, true}) {
    const Options options{.alpha = 0.008, .threads = at_once ? 2U : 1U};
    Extractor in_memory;
    const IndexedMultiPolygon& shape = in_memory.extract(points, options);
    std::vector<int> passes;
    MemorySource source(points);
    const double least = map_bytes(source, options);
    for (int k = 0; k < 24; ++k) {
      StreamProgress last;
      const StreamOptions stream_options{.most_map_bytes = least * std::pow(1.2, k),
                                         .progress = [&](const StreamProgress& progress) { last = progress; },
                                         .reads_at_once = at_once};
      const StreamedHull hull =
          concave_hull_of_stream(sources_of(points, at_once ? 3 : 1, 20'000), options, stream_options);
      expect_as_in_memory(hull, points, in_memory, shape);
      EXPECT_EQ(last.pass, last.passes);
      passes.push_back(last.pass);
    }
    EXPECT_EQ(passes.front(), 4);
    EXPECT_EQ(passes.back(), 3);
    EXPECT_TRUE(std::is_sorted(passes.rbegin(), passes.rend()));
  }
  for (int pass = 2; pass <= 3; ++pass) {
    Points moved = points;
    moved.front() = {2, 2};
    MemorySource source(points);
    source.change(pass, moved);
    EXPECT_EQ(complaint(source, {.alpha = 0.008}), kOtherPoints);
  }
}

// The first pass does what the second one does where it is known before how many points there are, and where.
// If that is wrong, nothing changes, be it an error.
TEST(Stream, ReadsThePointsOnceLessWhereItKnowsWhatToExpect) {
  const Points points = square_with_holes(300'000, 3, 1);
  const ExpectedPoints right{points.size(), bounding_box(points)};
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const Box& box = right.box;
  const std::vector<ExpectedPoints> wrong = {{points.size() - 1, box},
                                             {points.size() + 1, box},
                                             {3 * points.size(), box},
                                             {70'000, box},
                                             {0, box},
                                             {points.size(), {}},
                                             {points.size(), bounding_box({})},
                                             {points.size(), {box.min, {box.max.x, 0.7}}},
                                             {points.size(), {{0.2, 0.2}, {0.3, 0.3}}},
                                             {points.size(), {{0.5, 0.5}, {0.5, 0.9}}},
                                             {points.size(), {{0.5, 0.5}, {0.5 + 1e-16, 0.9}}},
                                             {points.size(), {box.min, {100, box.max.y}}},
                                             {points.size(), {box.min, {1e6, box.max.y}}},
                                             {points.size(), {{-1e99, -1e99}, {1e99, 1e99}}},
                                             {points.size(), {{-1e300, box.min.y}, {1e300, box.max.y}}},
                                             {points.size(), {{-kInfinity, box.min.y}, box.max}},
                                             {points.size(), {{kNan, box.min.y}, box.max}}};
  for (Options options : {Options{}, Options{.alpha = 0.01}}) {
    Extractor in_memory;
    const IndexedMultiPolygon& shape = in_memory.extract(points, options);
    for (const unsigned threads : {1U, 3U}) {
      options.threads = threads;
      const std::vector<PointSource> sources = sources_of(points, threads, 7'777);
      const auto passes = [&](const std::optional<ExpectedPoints>& expected) {
        StreamProgress last;
        const StreamedHull hull =
            concave_hull_of_stream(sources, options,
                                   {.progress = [&](const StreamProgress& progress) { last = progress; },
                                    .reads_at_once = threads > 1,
                                    .expected = expected});
        expect_as_in_memory(hull, points, in_memory, shape);
        EXPECT_EQ(last.pass, last.passes);
        return last.pass;
      };
      const int without = passes({});
      EXPECT_EQ(passes(right), without - 1);
      for (const ExpectedPoints& expected : wrong) EXPECT_EQ(passes(expected), without);
    }
  }
  // Few points, points on a line, and none at all, of which the same was expected.
  for (const Points& others : {testing::uniform_points(1000, 1), Points(70'000, Point{0.5, 0.5}), Points()}) {
    for (const Options& options : {Options{}, Options{.alpha = 0.01}}) {
      expect_as_in_memory(MemorySource(others).hull(options, {.expected = right}), others, options);
    }
  }
  Points bad = points;
  bad[254'321].y = kNan;
  for (const Options& options : {Options{}, Options{.alpha = 0.01}}) {
    MemorySource not_finite(bad);
    EXPECT_EQ(complaint(not_finite, options, {.expected = right}), "point 254321 is not finite");
    for (int pass = 2; pass <= 3; ++pass) {
      Points shorter = points;
      shorter.pop_back();
      MemorySource changes(points);
      changes.change(pass, shorter);
      if (pass == 3 && options.alpha) continue;  // there is none
      EXPECT_EQ(complaint(changes, options, {.expected = right}), kOtherPoints);
    }
  }
  MemorySource source(points);
  for (const ExpectedPoints& expected : {right, wrong[0], wrong[7]}) {
    EXPECT_EQ(complaint(source, {.alpha = 1e-9}, {.expected = expected}), complaint(source, {.alpha = 1e-9}));
  }
  Points tiny = points;
  tiny[0] = {1e-200, 1e-200};
  const ExpectedPoints of_tiny{tiny.size(), bounding_box(tiny)};
  MemorySource extreme(tiny);
  for (const Options& options : {Options{}, Options{.alpha = 0.01}}) {
    EXPECT_EQ(complaint(extreme, options, {.expected = of_tiny}), complaint(extreme, options));
  }
}

TEST(Stream, NeedsALimitWhereAllTrianglesChooseIt) {
  // Points in clusters.
  testing::Random random(1);
  Points points;
  while (points.size() < 300'000) {
    const Point middle{random.between(0, 1), random.between(0, 1)};
    for (int k = 0; k < 30; ++k) {
      points.push_back({middle.x + random.between(0, 2e-3), middle.y + random.between(0, 2e-3)});
    }
  }
  MemorySource source(points);
  EXPECT_THROW(source.hull({}), NeedsAllPoints);
  EXPECT_THROW(source.hull({}, {.most_points_in_memory = points.size() - 1}), NeedsAllPoints);
  EXPECT_NO_THROW(source.hull({.alpha = 0.02}));
  expect_as_in_memory(source.hull({}, {.most_points_in_memory = points.size()}), points, {});
  const std::vector<PointSource> sources = sources_of(points, 3, 50'000);
  const Options two_threads{.threads = 2};
  expect_as_in_memory(concave_hull_of_stream(sources, two_threads,
                                             {.most_points_in_memory = points.size(), .reads_at_once = true}),
                      points, two_threads);
}

void expect_same(const StreamedHull& hull, const StreamedHull& expected) {
  EXPECT_EQ(hull.polygons, expected.polygons);
  EXPECT_EQ(hull.vertices, expected.vertices);
  EXPECT_EQ(hull.points, expected.points);
  EXPECT_EQ(hull.triangulated_points, expected.triangulated_points);
}

// That the shards' points are those of one run, too, says that no halo is too small.
TEST(StreamShards, GiveWhatOneRunGives) {
  std::size_t rings = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    testing::Random random(seed + 100);
    Points points = seed % 3 == 2 ? lattice_with_holes(300)
                                  : testing::uniform_points(70'000 + random.below(20'000), seed);
    if (seed % 3 != 2) {
      std::erase_if(points, [](const Point& p) { return std::hypot(p.x - 0.4, p.y - 0.5) < 0.1; });
    }
    if (seed % 2 == 0) points.insert(points.end(), points.begin(), points.begin() + 5000);
    const double spacing = seed % 3 == 2 ? 1 : 1 / std::sqrt(static_cast<double>(points.size()));
    Options options{.max_perimeter = random.between(6, 15) * spacing};
    if (seed % 3 == 1) options = {.alpha = random.between(1.2, 2.5) * spacing};
    if (seed % 3 == 2) options.max_edge_length = (1.4 + 0.2 * static_cast<double>(seed)) * spacing;
    options.fill_single_triangles = seed % 4 == 0;
    const StreamShard all = MemorySource(points).part(options, {});
    const StreamedHull expected = MemorySource(points).hull(options);
    EXPECT_EQ(expected.polygons, to_coordinates(concave_hull(points, options), points));
    for (const std::uint32_t count : {1U, 2U, 3U, 7U, 23U}) {
      SCOPED_TRACE(std::to_string(count) + " shards, seed " + std::to_string(seed));
      const std::vector<StreamShard> shards = parts(points, options, count);
      std::vector<std::pair<std::uint64_t, std::uint8_t>> found;
      for (const StreamShard& shard : shards) {
        EXPECT_EQ(shard.cells_per_length, all.cells_per_length);
        for (std::size_t i = 0; i < shard.points.size(); ++i) {
          found.emplace_back(shard.numbers[i], shard.uncertain[i]);
        }
      }
      std::sort(found.begin(), found.end());
      ASSERT_EQ(found.size(), all.points.size());
      for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i], std::pair(all.numbers[i], all.uncertain[i]));
      }
      expect_same(concave_hull_of_shards(shards, 1 + count % 2), expected);
    }
    for (const Polygon& polygon : expected.polygons) rings += 1 + polygon.holes.size();
  }
  EXPECT_GT(rings, 100U);
}

// Dense cells from 13 rows below a band on, few below these. So whether a point of the lowest dense row is
// uncertain depends on cells up to 24 rows below the band, and whether one of the band's lowest row is in the
// part on such a point. With a row less of either, the shard would find another part than one run.
TEST(StreamShards, LookAsFarBeyondTheirBandsAsIsNecessary) {
  constexpr std::size_t kBand = 800;  // the lowest row of the second of two bands
  constexpr std::size_t kDense = kBand - 13;
  // So that cells have the side 1 (kSafety and kUneven of interior.hpp).
  const Options options{.alpha = 6 / ((1 - 0x1p-8) * (1 - 0.0006180339887498949))};
  std::size_t in_lowest_row = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE(seed);
    testing::Random random(seed);
    Points points{{0, 0}, {300, 1600}};
    const double density = 0.02 + 0.02 * static_cast<double>(seed);
    for (std::size_t row = kDense - 60; row < kDense + 240; ++row) {
      for (std::size_t column = 0; column < 300; ++column) {
        if (row < kDense && random.unit() >= density) continue;
        const double in_cell = row < kDense ? random.unit() : row == kDense ? 0.1 : 0.9;
        points.push_back({static_cast<double>(column) + random.unit(), static_cast<double>(row) + in_cell});
      }
    }
    const StreamShard all = MemorySource(points).part(options, {});
    EXPECT_DOUBLE_EQ(all.cells_per_length, 1);
    std::vector<std::uint64_t> expected;
    for (std::size_t i = 0; i < all.points.size(); ++i) {
      if (all.points[i].y >= kBand) expected.push_back(all.numbers[i]);
      if (all.points[i].y >= kBand && all.points[i].y < kBand + 1) ++in_lowest_row;
    }
    EXPECT_EQ(MemorySource(points).part(options, {2, 2}).numbers, expected);
  }
  EXPECT_GT(in_lowest_row, 100U);
  EXPECT_LT(in_lowest_row, 8U * 300 - 100);
}

// Tiles in any order, an empty one among them: those that do not reach into a shard's band are read once
// only.
TEST(StreamShards, ReadTilesThatTheyNeed) {
  Points points;
  std::vector<Points> tiles(12);
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    if (t == 7) continue;
    tiles[t] = testing::uniform_points(12'000, t);
    for (Point& p : tiles[t]) p.y += static_cast<double>(t * 5 % tiles.size());
    points.insert(points.end(), tiles[t].begin(), tiles[t].end());
  }
  const Options options{.max_perimeter = 0.06};
  std::vector<StreamShard> shards;
  std::size_t times = 0;
  std::vector<PointSource> sources;
  sources.reserve(tiles.size());
  for (const Points& tile : tiles) {
    sources.emplace_back([&](const TakePoints& take) {
      ++times;
      if (!tile.empty()) take(tile);
    });
  }
  StreamProgress last;
  for (std::uint32_t number = 1; number <= 4; ++number) {
    shards.push_back(part_of_stream(sources, options, {number, 4},
                                    {.progress = [&](const StreamProgress& progress) { last = progress; }}));
  }
  EXPECT_LE(last.points, points.size());
  // Each shard all once, and then three times the three or four that are in its band, and neighbours.
  EXPECT_LT(times, 4 * (12 + 3 * 6));
  expect_same(concave_hull_of_shards(shards), MemorySource(points).hull(options));
}

TEST(StreamShards, MayHaveNothing) {
  // Fewer rows of cells than shards.
  Points flat = testing::uniform_points(80'000, 21);
  for (Point& p : flat) p.y *= 0.001;
  const Options options{.alpha = 0.0006};
  const std::vector<StreamShard> shards = parts(flat, options, 60);
  EXPECT_GT(
      std::count_if(shards.begin(), shards.end(), [](const StreamShard& s) { return s.points.empty(); }), 20);
  expect_same(concave_hull_of_shards(shards), MemorySource(flat).hull(options));
  // A band without a point between two with some.
  Points apart = testing::uniform_points(80'000, 22);
  for (std::size_t i = 0; i < apart.size(); i += 2) apart[i].y += 20;
  expect_same(concave_hull_of_shards(parts(apart, {.alpha = 0.02}, 5)),
              MemorySource(apart).hull({.alpha = 0.02}));

  for (const Points& few : {Points(), Points{{1, 2}}, testing::uniform_points(3000, 23)}) {
    expect_same(concave_hull_of_shards(parts(few, {}, 3)), MemorySource(few).hull({}));
  }
  Points line(70'000);
  for (std::size_t i = 0; i < line.size(); ++i) line[i] = {static_cast<double>(i), 1};
  expect_same(concave_hull_of_shards(parts(line, {.alpha = 10}, 3)), MemorySource(line).hull({.alpha = 10}));
}

// The maps of a shard have the rows of its band and 24 on either side.
TEST(StreamShards, NeedLessMemoryThanOneRun) {
  const Points points = testing::uniform_points(400'000, 24);
  const Options options{.alpha = 0.003};
  const StreamOptions little{.most_map_bytes = 120'000};
  MemorySource source(points);
  EXPECT_EQ(complaint(source, options, little), kTooSmall);
  expect_same(concave_hull_of_shards(parts(points, options, 8, little)), MemorySource(points).hull(options));
}

TEST(StreamShards, SayWhyTheyDoNotFitTogether) {
  const Points points = testing::uniform_points(70'000, 25);
  const Options options{.max_perimeter = 0.1};
  const std::vector<StreamShard> right = parts(points, options, 3);
  EXPECT_EQ(complaint(right), hullbench::testing::kNoComplaint);
  EXPECT_EQ(complaint(std::span<const StreamShard>()), "there is no shard");
  EXPECT_EQ(complaint(std::span(right).first(2)), "shard 1 of 3 is missing");
  EXPECT_EQ(complaint(std::span(right).last(2)), "shard 3 of 3 is missing");
  const auto with = [&](StreamShard last) {
    std::vector<StreamShard> shards = right;
    shards.back() = std::move(last);
    return complaint(shards);
  };
  EXPECT_EQ(with(right[1]), "shard 2 of 3 is there twice");
  EXPECT_EQ(
      with(MemorySource(points).part(options, {1, 4})),
      "shard 3 of 3 and shard 1 of 4 do not belong together: cut the source into as many shards for each");
  EXPECT_EQ(
      with(MemorySource(points).part({.max_perimeter = 0.11}, {1, 3})),
      "shard 3 of 3 and shard 1 of 3 were made with different limits or options: make them with the same");
  Points moved = points;
  std::swap(moved[7], moved[8]);
  EXPECT_EQ(
      with(MemorySource(moved).part(options, {1, 3})),
      "shard 3 of 3 and shard 1 of 3 are of different points, or of a source that changed in between: make "
      "them of the same");
  EXPECT_EQ(with(MemorySource(points).part(options, {1, 3}, {.most_map_bytes = 15'000})),
            "shard 3 of 3 and shard 1 of 3 have different grids: let all use as much memory for their maps");

  const std::string not_one_source =
      "the shards do not fit together: their points are not those of one source; make them again";
  const auto damaged = [&](const auto& damage) {
    StreamShard shard = right.back();
    damage(shard);
    return with(shard);
  };
  EXPECT_EQ(damaged([](StreamShard& s) { s.numbers.pop_back(); }), not_one_source);
  EXPECT_EQ(damaged([](StreamShard& s) { s.uncertain.pop_back(); }), not_one_source);
  EXPECT_EQ(damaged([](StreamShard& s) { std::swap(s.numbers[0], s.numbers[1]); }), not_one_source);
  EXPECT_EQ(damaged([](StreamShard& s) { s.numbers.back() = 70'000; }), not_one_source);
  EXPECT_EQ(damaged([&](StreamShard& s) { s.numbers[0] = right[0].numbers[0]; }), not_one_source);
  EXPECT_EQ(damaged([](StreamShard& s) { s.points[5] = {3, 3}; }), not_one_source);
  EXPECT_EQ(damaged([](StreamShard& s) { s.points[5] = {1e300, 3}; }), not_one_source);
  std::vector<StreamShard> unlimited = right;
  for (StreamShard& shard : unlimited) shard.options = {};
  EXPECT_EQ(complaint(unlimited), not_one_source) << "nobody knows what is dropped without a limit";
  EXPECT_EQ(damaged([](StreamShard& s) { s.shard.number = 0; }), "there is no shard 0 of 3");
  StreamShard empty = MemorySource(points).part(options, {1, 1});
  empty.points.clear();
  empty.numbers.clear();
  empty.uncertain.clear();
  empty.box = bounding_box({});
  EXPECT_EQ(complaint({&empty, 1}), not_one_source);
  const Points few = testing::uniform_points(100, 26);
  StreamShard whole = MemorySource(few).part({}, {});
  whole.points.pop_back();
  whole.numbers.pop_back();
  whole.uncertain.pop_back();
  EXPECT_EQ(complaint(std::span(&whole, 1)), not_one_source);
}

TEST(StreamShards, AreThoseThatThereAre) {
  MemorySource source(testing::uniform_points(70'000, 27));
  for (const Shard& shard : {Shard{0, 3}, Shard{4, 3}, Shard{1, 0}}) {
    EXPECT_THROW(source.part({.alpha = 0.02}, shard), std::invalid_argument);
  }
}

TEST(StreamShards, NoticeASourceThatChanges) {
  const Points points = testing::uniform_points(70'000, 28);
  for (int pass = 2; pass <= 3; ++pass) {
    Points shorter = points;
    shorter.pop_back();
    MemorySource source(points);
    source.change(pass, shorter);
    EXPECT_THROW(source.part({.alpha = 0.02}, {2, 3}), std::runtime_error);
  }
}

// A wider radius than usual, up to the limit's, keeps the maps small.
TEST(Stream, KeepsToTheMemoryThatItMayUse) {
  const Points points = testing::uniform_points(100'000, 1);
  const Options options{.max_edge_length = 0.1};
  const IndexedMultiPolygon shape = concave_hull(points, options);
  MemorySource source(points);
  EXPECT_EQ(source.hull(options, {.most_map_bytes = 8000}).polygons, to_coordinates(shape, points));
  EXPECT_EQ(complaint(source, options, {.most_map_bytes = 1000}), kTooSmall);
  EXPECT_EQ(complaint(source, {.alpha = 1e-9}), kTooSmall);
  EXPECT_EQ(complaint(source, {}, {.most_map_bytes = 8000}),
            "the map of cells needs more memory than it may take: allow more, or give alpha, max_edge_length "
            "or max_perimeter");
}

TEST(Stream, PutsFewPointsIntoMemory) {
  const Points points = testing::uniform_points(3000, 2);
  MemorySource source(points);
  EXPECT_EQ(source.hull({}).polygons, to_coordinates(concave_hull(points), points));
  EXPECT_EQ(source.passes(), 2);
  MemorySource none({});
  EXPECT_TRUE(none.hull({}).polygons.empty());
}

TEST(Stream, PointsOnALineHaveNoShape) {
  for (const Point& step : {Point{1, 0}, Point{0, 1}, Point{0, 0}}) {
    Points points(70'000);
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i] = {static_cast<double>(i) * step.x, static_cast<double>(i) * step.y};
    }
    const StreamedHull hull = MemorySource(points).hull({.alpha = 10});
    EXPECT_TRUE(hull.polygons.empty());
    EXPECT_EQ(hull.points, points.size());
  }
}

TEST(Stream, TellsHowFarItHasCome) {
  MemorySource source(testing::uniform_points(70'000, 3), 7000);
  int calls = 0;
  StreamProgress last;
  source.hull({.alpha = 0.02}, {.progress = [&](const StreamProgress& progress) {
                EXPECT_TRUE(progress.pass > last.pass || progress.points > last.points);
                last = progress;
                ++calls;
              }});
  EXPECT_EQ(calls, 30);
  EXPECT_EQ(last.pass, last.passes);
  EXPECT_EQ(last.points, 70'000U);
}

TEST(Stream, SaysWhatIsWrong) {
  const Points points = testing::uniform_points(70'000, 4);
  MemorySource many(points);
  EXPECT_EQ(hullbench::testing::complaint_of<std::invalid_argument>([&] {
              many.part({}, {1, 2});
            }),
            "a shard of more than 65536 points needs a limit: give alpha, max_edge_length or max_perimeter");
  EXPECT_EQ(complaint(many, {.alpha = -1}), "alpha must be zero or more");
  Points bad = points;
  bad[54'321].y = std::numeric_limits<double>::quiet_NaN();
  MemorySource not_finite(bad);
  EXPECT_EQ(complaint(not_finite, {.alpha = 0.02}), "point 54321 is not finite");
  Points huge = points;
  for (Point& p : huge) p.x *= 1e300;
  MemorySource extreme(huge);
  hullbench::testing::expect_says(complaint(extreme, {.alpha = 0.02}),
                                  "coordinates span more than a factor of 2^265");
}

TEST(Stream, NoticesASourceThatChanges) {
  const Points points = testing::uniform_points(70'000, 5);
  const Options options{.alpha = 0.02};
  Points longer = points;
  longer.push_back({0.5, 0.5});
  Points shorter = points;
  shorter.pop_back();
  Points moved = points;
  moved[100] = {2, 2};
  Points lost = points;
  lost[100].x = std::numeric_limits<double>::quiet_NaN();
  Points shrunk = points;  // all of them, within the box
  for (Point& p : shrunk) p = {0.1 + 0.8 * p.x, 0.1 + 0.8 * p.y};
  MemorySource usual(points);
  const StreamOptions little{.most_map_bytes = map_bytes(usual, options)};
  for (const auto& [passes, stream_options] : {std::pair(3, StreamOptions()), std::pair(4, little)}) {
    for (int pass = 2; pass <= passes; ++pass) {
      for (const Points& changed : {longer, shorter, moved, lost, shrunk}) {
        MemorySource source(points);
        source.change(pass, changed);
        EXPECT_EQ(complaint(source, options, stream_options), kOtherPoints);
      }
    }
  }
  MemorySource few(testing::uniform_points(100, 6));
  few.change(2, testing::uniform_points(101, 6));
  EXPECT_EQ(complaint(few, {}), kOtherPoints);
}

// After the sizes were found place by place, in the last three passes, the outline of a hole runs through a
// place that had no points, that of the hole before.
TEST(Stream, NoticesAnOutlineWhereNoPointsWere) {
  Points points = square_with_holes(300'000, 3, 1);
  points.insert(points.end(), {{0, 0}, {1, 0}, {0, 1}, {1, 1}});  // so that the box stays
  Points mirrored = points;
  for (Point& p : mirrored) std::swap(p.x, p.y);
  MemorySource source(points);
  source.hull({});
  MemorySource changes(points);
  changes.change(source.passes() - 2, mirrored);
  EXPECT_EQ(complaint(changes, {}), kOtherPoints);
}

}  // namespace
}  // namespace polylidar
