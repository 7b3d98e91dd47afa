#include "shards.hpp"

#include <algorithm>
#include <functional>
#include <queue>

#include "coordinate_range.hpp"
#include "interior.hpp"
#include "options_check.hpp"

namespace polylidar {
namespace {

std::invalid_argument do_not_fit() {
  return std::invalid_argument(
      "the shards do not fit together: their points are not those of one source; make them again");
}

/// Throws unless both were asked for the same of the same source.
void check_belong(const StreamShard& first, const StreamShard& other) {
  const auto fail = [&](const std::string& what) {
    throw std::invalid_argument(detail::name_of(first.shard) + " and " + detail::name_of(other.shard) + what);
  };
  if (other.shard.count != first.shard.count) {
    fail(" do not belong together: cut the source into as many shards for each");
  }
  Options options = other.options;
  options.threads = first.options.threads;
  if (options != first.options) {
    fail(" were made with different limits or options: make them with the same");
  }
  if (other.source_points != first.source_points || other.source_checksum != first.source_checksum ||
      other.box != first.box) {
    fail(" are of different points, or of a source that changed in between: make them of the same");
  }
  if (other.cells_per_length != first.cells_per_length) {
    fail(" have different grids: let all use as much memory for their maps");
  }
}

/// Throws unless all are there, once each.
void check_complete(std::span<const StreamShard> shards) {
  const std::uint32_t count = shards.front().shard.count;
  std::vector<std::uint32_t> numbers;
  for (const StreamShard& shard : shards) numbers.push_back(shard.shard.number);
  std::sort(numbers.begin(), numbers.end());
  if (numbers.front() < 1 || numbers.back() > count) {
    throw std::invalid_argument(
        "there is no " + detail::name_of({numbers.front() < 1 ? numbers.front() : numbers.back(), count}));
  }
  const auto twice = std::adjacent_find(numbers.begin(), numbers.end());
  if (twice != numbers.end()) {
    throw std::invalid_argument(detail::name_of({*twice, count}) + " is there twice");
  }
  std::uint32_t missing = 1;
  while (missing <= numbers.size() && numbers[missing - 1] == missing) ++missing;
  if (missing <= count) throw std::invalid_argument(detail::name_of({missing, count}) + " is missing");
}

/// All points of the shards by their numbers, as if one had found them.
StreamShard joined(std::span<const StreamShard> shards) {
  const StreamShard& first = shards.front();
  StreamShard all{.shard = {},
                  .options = first.options,
                  .source_points = first.source_points,
                  .source_checksum = first.source_checksum,
                  .box = first.box,
                  .cells_per_length = first.cells_per_length,
                  .points = {},
                  .numbers = {},
                  .uncertain = {}};
  std::size_t count = 0;
  for (const StreamShard& shard : shards) count += shard.points.size();
  all.points.reserve(count);
  all.numbers.reserve(count);
  all.uncertain.reserve(count);
  struct Next {
    std::uint64_t number;
    const StreamShard* shard;
    std::size_t place;
    bool operator<(const Next& other) const { return number > other.number; }  // the least on top
  };
  std::priority_queue<Next> queue;
  const auto push = [&](const StreamShard& shard, std::size_t place) {
    if (place < shard.numbers.size()) queue.push({shard.numbers[place], &shard, place});
  };
  for (const StreamShard& shard : shards) push(shard, 0);
  while (!queue.empty()) {
    const Next next = queue.top();
    queue.pop();
    all.points.push_back(next.shard->points[next.place]);
    all.numbers.push_back(next.number);
    all.uncertain.push_back(next.shard->uncertain[next.place]);
    push(*next.shard, next.place + 1);
  }
  return all;
}

/// Throws unless the numbers are those of points of the source, ascending.
void check_numbers(const StreamShard& all) {
  const std::vector<std::uint64_t>& numbers = all.numbers;
  const bool ascend =
      std::adjacent_find(numbers.begin(), numbers.end(), std::greater_equal<>()) == numbers.end();
  if (!ascend || (!numbers.empty() && numbers.back() >= all.source_points)) throw do_not_fit();
}

StreamedHull hull_of_part(const StreamShard& all, unsigned threads) {
  check_numbers(all);
  if (all.source_points <= detail::kAlwaysInMemory) return detail::hull_in_memory(all, threads);
  if (detail::is_flat(all.box)) return detail::hull_without_area(all);
  if (!detail::is_any_limit_given(all.options)) throw do_not_fit();  // what is dropped cannot be known
  const Limits limits = detail::checked_limits(all.options);
  detail::ThreadPool pool;
  pool.use(threads);
  detail::PartHull part(all, pool);
  if (part.filter(detail::filter_rules(limits), detail::is_filled(all.options))) {
    throw detail::rounding_decides();
  }
  return part.trace();
}

}  // namespace

namespace detail {

PartHull::PartHull(const StreamShard& part, ThreadPool& pool) : part_(part), pool_(pool) {
  const std::size_t count = part.points.size();
  if (count > kMaxPoints) throw too_much_outline();
  RangeOfBlocks blocks;
  blocks.add(part.points);
  // The corners of the convex hull are uncertain, so that the part reaches as far as all points.
  if (count == 0 || blocks.not_finite() || blocks.box() != part.box) throw do_not_fit();
  const CoordinateRange range = blocks.range();
  if (range.scale_exponent != 0) throw do_not_fit();
  builder_.build(part.points, range, pool);
  is_tested_.resize(count);
  for (std::size_t v = 0; v < count; ++v) is_tested_[v] = part.uncertain[builder_.caller_index()[v]];
}

std::optional<Way> PartHull::filter(const FilterRules& rules, bool fill_single) {
  return filter_.run_on_part(builder_.mesh(), builder_.vertices(), is_tested(), rules, fill_single, pool_,
                             boundary_);
}

std::optional<Way> PartHull::filter(const SizeField& field, const SizeFilter::IsSure& is_sure,
                                    bool fill_single) {
  return filter_.run_on_part(builder_.mesh(), builder_.vertices(), is_tested(), field, is_sure, fill_single,
                             pool_, boundary_);
}

StreamedHull PartHull::trace() {
  BoundaryTracer tracer;
  IndexedMultiPolygon shape;
  tracer.trace(builder_.mesh(), builder_.vertices(), part_.points.size(), builder_.caller_index(), boundary_,
               shape);
  StreamedHull hull = hull_without_area(part_);
  hull.polygons = to_coordinates(shape, part_.points);
  for (const std::uint32_t vertex : shape.vertices) hull.vertices.push_back(part_.numbers[vertex]);
  hull.triangulated_points = part_.points.size();
  return hull;
}

StreamedHull hull_without_area(const StreamShard& all) {
  StreamedHull hull;
  hull.points = all.source_points;
  hull.box = all.box;
  return hull;
}

StreamedHull hull_in_memory(const StreamShard& all, unsigned threads) {
  if (all.points.size() != all.source_points) throw do_not_fit();
  Options options = all.options;
  options.threads = threads;
  Extractor extractor;
  const IndexedMultiPolygon& shape = extractor.extract(all.points, options);
  StreamedHull hull = hull_without_area(all);
  hull.polygons = to_coordinates(shape, all.points);
  hull.vertices.assign(shape.vertices.begin(), shape.vertices.end());
  hull.triangulated_points = extractor.statistics().triangulated_points;
  hull.chosen_sizes = extractor.chosen_sizes();
  hull.by_outlines = extractor.statistics().by_outlines;
  return hull;
}

}  // namespace detail

StreamedHull concave_hull_of_shards(std::span<const StreamShard> shards, unsigned threads) {
  detail::check_threads(threads);
  if (shards.empty()) throw std::invalid_argument("there is no shard");
  for (const StreamShard& shard : shards) {
    check_belong(shards.front(), shard);
    if (shard.numbers.size() != shard.points.size() || shard.uncertain.size() != shard.points.size()) {
      throw do_not_fit();
    }
  }
  check_complete(shards);
  return shards.size() == 1 ? hull_of_part(shards.front(), threads) : hull_of_part(joined(shards), threads);
}

}  // namespace polylidar
