// Any number of threads gives the same result, bit for bit; run with the thread sanitizer too.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

#include "core/src/thread_pool.hpp"
#include "polylidar/concave_hull.hpp"
#include "polylidar/stream.hpp"
#include "tests/complaint.hpp"
#include "tests/point_sets.hpp"

namespace polylidar {
namespace {

using testing::PointSet;
using testing::repeated;

constexpr std::size_t kCount = 30'000;  // enough for several parts on each of eight threads

std::vector<Point> clusters(std::size_t count, std::size_t of_points, double distance) {
  const std::vector<Point> places = testing::lattice(10, 10, distance);
  std::vector<Point> result;
  for (std::size_t c = 0; c < count; ++c) {
    result =
        testing::joined(result, testing::transformed(testing::uniform_points(of_points, c), 1, places[c]));
  }
  return result;
}

// Sets that are cut into parts in different ways: evenly, at cells that need a curve of their own, or not at
// all.
std::vector<PointSet> large_point_sets() {
  return {
      {"uniform", testing::uniform_points(kCount, 1)},
      {"lattice", testing::lattice(200, 150)},
      {"rotated lattice", testing::rotated(testing::lattice(200, 150), 0.3)},
      {"two far clusters", clusters(2, kCount / 2, 1e9)},
      {"many clusters", clusters(100, kCount / 100, 1e4)},
      {"every point ten times", testing::shuffled(repeated(testing::uniform_points(kCount / 10, 2), 10), 3)},
      {"few points, many times",
       testing::shuffled(repeated(testing::integer_points(40, 4, 5), kCount / 40), 5)},
      {"one point", std::vector<Point>(kCount, Point{1, 2})},
      {"on a line", testing::lattice(kCount, 1)},
      {"on a circle", testing::circle(kCount, 1)},
      {"tiny", [] {
         std::vector<Point> points = testing::uniform_points(kCount, 6);
         for (Point& p : points) p = {p.x * 0x1p-480, p.y * 0x1p-480};
         return points;
       }()}};
}

// The automatic limit, and limits that keep everything, the whole without its interior, about the whole, and
// about half of it.
std::vector<Options> limits_for(const std::vector<Point>& points) {
  const Box box = bounding_box(points);
  const double spacing = (box.max.x - box.min.x) / 150;
  return {{},
          {.alpha = kNoLimit},
          {.alpha = 2 * spacing, .max_perimeter = 15 * spacing},
          {.alpha = spacing},
          {.alpha = spacing, .fill_single_triangles = true},
          {.alpha = spacing / 2, .max_edge_length = spacing}};
}

TEST(Threads, GiveTheSameResultWhateverTheirNumber) {
  Extractor one_thread;
  Extractor extractor;  // its number of threads goes up and down
  for (const PointSet& set : large_point_sets()) {
    SCOPED_TRACE(set.name);
    for (Options options : limits_for(set.points)) {
      const IndexedMultiPolygon& expected = one_thread.extract(set.points, options);
      for (const unsigned threads : {2U, 8U, 1U, 3U}) {
        options.threads = threads;
        EXPECT_EQ(extractor.extract(set.points, options), expected) << threads << " threads";
      }
    }
  }
}

TEST(Threads, GiveTheSameResultStepByStep) {
  const std::vector<Point> points = testing::uniform_points(kCount, 7);
  const Options options{.alpha = 0.007};
  Extractor extractor;
  extractor.triangulate(points, 2);
  extractor.extract_regions({.alpha = options.alpha, .threads = 3});
  EXPECT_EQ(extractor.extract_polygons(), concave_hull(points, options));
}

TEST(Threads, NameTheFirstCoordinateThatIsNotFinite) {
  std::vector<Point> points = testing::uniform_points(kCount, 8);
  points[20'000].x = points[29'000].y = std::numeric_limits<double>::quiet_NaN();
  Extractor extractor;
  EXPECT_EQ(hullbench::testing::complaint_of<std::invalid_argument>(
                [&] { extractor.extract(points, {.threads = 4}); }),
            "point 20000 is not finite");
  points[20'000].x = points[29'000].y = 0;
  EXPECT_EQ(extractor.extract(points, {.threads = 4}), concave_hull(points));
}

TEST(Threads, ReadSourcesOfAStreamAtTheSameTime) {
  const std::vector<Point> points = testing::uniform_points(100'000, 7);
  constexpr std::size_t kSources = 5;
  std::vector<PointSource> sources;
  for (std::size_t s = 0; s < kSources; ++s) {
    const std::size_t begin = points.size() * s / kSources;
    sources.emplace_back([&points, begin, end = points.size() * (s + 1) / kSources](const TakePoints& take) {
      constexpr std::size_t kBlock = 3'000;
      for (std::size_t next = begin; next < end; next += kBlock) {
        take(std::span(points).subspan(next, std::min(kBlock, end - next)));
      }
    });
  }
  for (const Options& options : {Options{.threads = 4}, Options{.alpha = 0.01, .threads = 4}}) {
    std::uint64_t told = 0;
    const StreamedHull hull = concave_hull_of_stream(
        sources, options,
        {.progress = [&](const StreamProgress& progress) { told = progress.points; }, .reads_at_once = true});
    EXPECT_EQ(hull.polygons, to_coordinates(concave_hull(points, options), points));
    EXPECT_EQ(told, points.size());
  }
}

TEST(Threads, MayBeVeryMany) {
  const std::vector<Point> few = testing::uniform_points(200, 1);
  EXPECT_EQ(concave_hull(few, {.threads = 1U << 29U}), concave_hull(few)) << "parts are counted in 64 bits";
}

TEST(Threads, MustBeOneOrMore) {
  const std::vector<Point> points = testing::uniform_points(10, 9);
  EXPECT_THROW(concave_hull(points, {.threads = 0}), std::invalid_argument);
  Extractor extractor;
  EXPECT_THROW(extractor.triangulate(points, 0), std::invalid_argument);
  extractor.triangulate(points);
  EXPECT_THROW(extractor.extract_regions({.threads = 0}), std::invalid_argument);
}

TEST(ThreadPool, RunsEveryTaskOnce) {
  detail::ThreadPool pool;
  for (const unsigned threads : {1U, 2U, 5U, 2U}) {
    pool.use(threads);
    for (std::size_t count = 0; count < 100; ++count) {
      std::vector<std::atomic<int>> runs(count);
      pool.for_each(count, [&](std::size_t i) { ++runs[i]; });
      for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(runs[i], 1) << i << " of " << count;
    }
  }
}

// With more threads than cores, a thread often comes when its job is over and the next one has begun: it must
// not take part in a job that is for fewer threads.
TEST(ThreadPool, RunsEveryTaskOnceWhereThreadsComeLate) {
  detail::ThreadPool pool;
  pool.use(8);
  constexpr std::size_t kTasks = 16;
  constexpr std::size_t kMostThreads = 2;
  std::vector<std::atomic<std::size_t>> runs(kTasks);
  std::atomic<std::size_t> others = 0;  // tasks on threads that should take no part
  const auto take_a_while = [] {
    for (int i = 0; i < 300; ++i) std::atomic_signal_fence(std::memory_order_seq_cst);
  };
  for (std::size_t job = 1; job <= 20'000; ++job) {
    if (job % 2 == 0) {
      pool.for_each(kTasks, [&](std::size_t i) { take_a_while(), ++runs[i]; });
    } else {
      pool.for_each_by_thread(kTasks, kMostThreads, [&](std::size_t thread, std::size_t i) {
        if (thread >= kMostThreads) ++others;
        take_a_while(), ++runs[i];
      });
    }
    for (std::size_t i = 0; i < kTasks; ++i) ASSERT_EQ(runs[i], job) << "task " << i;
  }
  EXPECT_EQ(others, 0U);
}

TEST(ThreadPool, GivesEachThreadANumberOfItsOwn) {
  detail::ThreadPool pool;
  pool.use(5);
  for (const std::size_t most : {1U, 2U, 3U, 5U, 9U}) {
    std::vector<std::atomic<bool>> is_busy(most);
    std::atomic<std::size_t> runs = 0;
    for (int repeat = 0; repeat < 200; ++repeat) {
      pool.for_each_by_thread(20, most, [&](std::size_t thread, std::size_t) {
        ASSERT_LT(thread, most);
        EXPECT_FALSE(is_busy[thread].exchange(true));
        ++runs;
        is_busy[thread] = false;
      });
    }
    EXPECT_EQ(runs, 200U * 20U);
  }
}

TEST(ThreadPool, PassesOnAnException) {
  detail::ThreadPool pool;
  for (const unsigned threads : {1U, 4U}) {
    pool.use(threads);
    const auto task = [](std::size_t i) {
      if (i == 37) throw std::runtime_error("37");
    };
    EXPECT_THROW(pool.for_each(100, task), std::runtime_error);
    std::atomic<int> runs = 0;
    pool.for_each(100, [&](std::size_t) { ++runs; });
    EXPECT_EQ(runs, 100);
  }
}

TEST(Chunks, CoverEverythingInOrder) {
  detail::ThreadPool pool;
  for (const unsigned threads : {1U, 3U}) {
    pool.use(threads);
    for (const std::size_t count : {0U, 1U, 5'000U, 100'001U}) {
      const detail::Chunks chunks(pool, count);
      std::size_t covered = 0;
      for (std::size_t c = 0; c < chunks.size(); ++c) {
        EXPECT_EQ(chunks.begin(c), covered);
        covered = chunks.end(c);
      }
      EXPECT_EQ(covered, count);
    }
  }
}

}  // namespace
}  // namespace polylidar
