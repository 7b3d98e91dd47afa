// Both ways to a shape: by all triangles, and without those of the interior.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/src/interior.hpp"
#include "polylidar/concave_hull.hpp"

namespace polylidar::testing {

// Takes the way without the interior wherever it can be gone, however little it pays.
constexpr detail::InteriorGuard kAlways{0, 1e5, 1, 1, 1};

// Which block of a field by corners a point belongs to.
using BlockOf = std::function<std::uint32_t(const Point&)>;

// Both ways, with memory that is kept. Points that come again are not triangulated again for the whole way.
class BothWays {
 public:
  const IndexedMultiPolygon& whole(const std::vector<Point>& points, const Options& options) {
    if (points != points_of_whole_ || options.threads != threads_of_whole_) {
      whole_.triangulate(points, options.threads);
      points_of_whole_ = points;
      threads_of_whole_ = options.threads;
    }
    whole_.extract_regions(options);
    return whole_.extract_polygons();
  }

  const IndexedMultiPolygon& whole(const std::vector<Point>& points, const detail::SizeField& field,
                                   bool fill_single, const BlockOf& block_of = nullptr) {
    pool_.use(1);
    if (points != points_of_builder_) {
      whole_builder_.build(points, pool_);
      points_of_builder_ = points;
    }
    filter_.run(whole_builder_.mesh(), whole_builder_.vertices(), placed(field, block_of, whole_builder_),
                fill_single, pool_, boundary_);
    tracer_.trace(whole_builder_.mesh(), whole_builder_.vertices(), points.size(),
                  whole_builder_.caller_index(), boundary_, whole_shape_);
    return whole_shape_;
  }
  // As the other go(), for a field of one limit, or one by corners.
  Statistics go(const std::vector<Point>& points, const detail::SizeField& field, bool fill_single,
                unsigned threads, const BlockOf& block_of = nullptr) {
    pool_.use(threads);
    return path_.extract(
        points, detail::measure_coordinates(points, pool_), field.wide_radius,
        [&](const std::uint8_t*) -> const detail::SizeField& { return placed(field, block_of, builder_); },
        fill_single, {pool_, builder_, filter_, boundary_, tracer_}, part_, kAlways);
  }

  // Of at least one point. What the way without the interior says; its shape is in part().
  Statistics go(const std::vector<Point>& points, const Options& options,
                const detail::InteriorGuard& guard = kAlways) {
    pool_.use(options.threads);
    const Limits limits{options.alpha.value_or(kNoLimit), options.max_edge_length.value_or(kNoLimit),
                        options.max_perimeter.value_or(kNoLimit)};
    return path_.extract(points, detail::measure_coordinates(points, pool_), limits,
                         options.fill_single_triangles.value_or(false),
                         {pool_, builder_, filter_, boundary_, tracer_}, part_, guard);
  }
  const IndexedMultiPolygon& part() const { return part_; }

 private:
  const detail::SizeField& placed(const detail::SizeField& field, const BlockOf& block_of,
                                  const detail::DelaunayBuilder& builder) {
    if (!block_of) return field;
    placed_ = field;
    placed_.is_by_corners = true;
    placed_.block_of_vertex.resize(builder.vertex_count());
    std::transform(builder.vertices(), builder.vertices() + builder.vertex_count(),
                   placed_.block_of_vertex.begin(), block_of);
    return placed_;
  }

  detail::SizeField placed_;
  Extractor whole_;
  std::vector<Point> points_of_whole_;
  unsigned threads_of_whole_ = 0;
  detail::DelaunayBuilder whole_builder_;
  std::vector<Point> points_of_builder_;
  detail::ThreadPool pool_;
  detail::DelaunayBuilder builder_;
  detail::RegionFilter filter_;
  std::vector<detail::Mesh::Index> boundary_;
  detail::BoundaryTracer tracer_;
  detail::InteriorPath path_;
  IndexedMultiPolygon part_;
  IndexedMultiPolygon whole_shape_;
};

}  // namespace polylidar::testing
