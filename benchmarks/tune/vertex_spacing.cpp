#include "benchmarks/tune/vertex_spacing.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

#include "core/src/filter_rules.hpp"
#include "core/src/kept_words.hpp"
#include "core/src/vector.hpp"

namespace hullbench::tune {

namespace {

using polylidar::kNone;
using polylidar::detail::Mesh;
using polylidar::detail::operator-;  // NOLINT(misc-unused-using-decls): distance() uses it
using polylidar::detail::Triangle;

double distance(const Point& a, const Point& b) {
  return std::sqrt(polylidar::detail::squared_length(a - b));
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

class VertexRule {
 public:
  VertexRule(const Mesh& mesh, const Point* vertices) : mesh_(mesh), vertices_(vertices) {
    find_neighbours();
    find_spacings();
    bound_growth();
  }

  std::vector<bool> keep() {
    const std::size_t count = mesh_.triangle_count();
    std::vector<bool> kept(count, false);
    held_.assign(count, 0);
    std::size_t fullest = count;
    for_each_finite([&](Mesh::Index t) {
      const Triangle triangle(mesh_, vertices_, t);
      const double edge = std::sqrt(second_longest_squared(triangle));
      const double area = std::max(triangle.twice_area() / 2, 0.0);
      const double s = least_spacing(t);
      held_[t] = 1.4 * edge * std::sqrt(area) / (s * s);
      kept[t] = held_[t] <= most_held();
      if (fullest == count || held_[t] < held_[fullest]) fullest = t;
    });
    drop_spikes(kept);
    for_each_region(kept, true, [&](std::span<const Mesh::Index> region, bool /*is_open*/) {
      if (static_cast<double>(region.size()) >= std::sqrt(points_) / 3) return;
      for (const Mesh::Index t : region) kept[t] = false;
    });
    for_each_region(kept, false, [&](std::span<const Mesh::Index> hole, bool is_open) {
      if (is_open) return;
      double area = 0;
      double spacing = 0;
      for (const Mesh::Index t : hole) {
        area += Triangle(mesh_, vertices_, t).twice_area() / 2;
        for (std::size_t k = 0; k < 3; ++k) spacing += spacing_[mesh_.corners(t)[k]];
      }
      spacing /= 3 * static_cast<double>(hole.size());
      if (0.88 * area / (spacing * spacing) >= most_held() + 2) return;
      for (const Mesh::Index t : hole) kept[t] = true;
    });
    if (std::ranges::find(kept, true) == kept.end() && fullest < count) kept[fullest] = true;
    return kept;
  }

 private:
  double most_held() const { return std::max(std::log(points_), 6.5); }

  template <class Visit>
  void for_each_finite(const Visit& visit) const {
    for (Mesh::Index t = 0; t < mesh_.triangle_count(); ++t) {
      if (!mesh_.is_ghost(t)) visit(t);
    }
  }

  static double second_longest_squared(const Triangle& triangle) {
    const double ab = triangle.squared_ab();
    const double bc = triangle.squared_bc();
    const double ca = triangle.squared_ca();
    return std::max(std::min(ab, bc), std::min(std::max(ab, bc), ca));
  }

  double least_spacing(Mesh::Index t) const {
    const Mesh::Index* const corner = mesh_.corners(t);
    return std::min({spacing_[corner[0]], spacing_[corner[1]], spacing_[corner[2]]});
  }

  std::span<const Mesh::Index> neighbours_of(std::size_t v) const {
    return {neighbours_.data() + first_[v], first_[v + 1] - first_[v]};
  }

  /// Every edge is two half-edges, one of which may belong to a ghost.
  void find_neighbours() {
    const std::size_t vertices = std::size_t{mesh_.triangle_count()} / 2 + 1;
    first_.assign(vertices + 1, 0);
    const auto for_each_edge = [&](const auto& visit) {
      for (Mesh::Index t = 0; t < mesh_.triangle_count(); ++t) {
        if (mesh_.is_unused(t)) continue;
        for (Mesh::Index k = 0; k < 3; ++k) {
          const Mesh::Index from = mesh_.corners(t)[k];
          const Mesh::Index to = mesh_.corners(t)[(k + 1) % 3];
          if (from != kNone && to != kNone) visit(from, to);
        }
      }
    };
    for_each_edge([&](Mesh::Index from, Mesh::Index) { ++first_[from + 1]; });
    for (std::size_t v = 0; v < vertices; ++v) {
      points_ += first_[v + 1] > 0 ? 1 : 0;
      first_[v + 1] += first_[v];
    }
    neighbours_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for_each_edge([&](Mesh::Index from, Mesh::Index to) { neighbours_[next[from]++] = to; });
  }

  void find_spacings() {
    const std::size_t vertices = first_.size() - 1;
    spacing_.assign(vertices, 0);
    for_each_finite([&](Mesh::Index t) {
      const double area = std::max(Triangle(mesh_, vertices_, t).twice_area() / 2, 0.0);
      for (std::size_t k = 0; k < 3; ++k) spacing_[mesh_.corners(t)[k]] += area;
    });
    std::vector<double> values;
    for (std::size_t v = 0; v < vertices; ++v) {
      if (neighbours_of(v).empty()) continue;
      values.clear();
      for (const Mesh::Index u : neighbours_of(v)) values.push_back(distance(vertices_[u], vertices_[v]));
      spacing_[v] = std::min(std::sqrt(spacing_[v] / 3), median(values));
    }
    std::vector<double> before = spacing_;
    for (std::size_t v = 0; v < vertices; ++v) {
      values.assign(1, before[v]);
      for (const Mesh::Index u : neighbours_of(v)) values.push_back(before[u]);
      spacing_[v] = median(values);
    }
    for (int round = 0; round < 3; ++round) {
      before = spacing_;
      for (std::size_t v = 0; v < vertices; ++v) {
        double inverses = 1 / before[v];
        for (const Mesh::Index u : neighbours_of(v)) inverses += 1 / before[u];
        spacing_[v] = static_cast<double>(neighbours_of(v).size() + 1) / inverses;
      }
    }
  }

  void bound_growth() {
    const double growth = std::clamp(6.7 / std::sqrt(points_), 0.1, 0.3);
    const std::vector<double> own = spacing_;
    for (int round = 0; round < 4; ++round) {
      const std::vector<double> before = spacing_;
      for (std::size_t v = 0; v + 1 < first_.size(); ++v) {
        for (const Mesh::Index u : neighbours_of(v)) {
          const double length = distance(vertices_[u], vertices_[v]);
          if (length > 4.5 * own[v]) continue;
          spacing_[v] = std::min(spacing_[v], before[u] + growth * std::min(length, 1.5 * before[u]));
        }
      }
    }
  }

  void drop_spikes(std::vector<bool>& kept) const {
    constexpr double kLeastAngle = 80 * std::numbers::pi / 180;
    std::vector<double> angle(first_.size() - 1, 0);
    for_each_finite([&](Mesh::Index t) {
      if (!kept[t]) return;
      const Mesh::Index* const corner = mesh_.corners(t);
      for (std::size_t k = 0; k < 3; ++k) {
        const auto a = vertices_[corner[(k + 1) % 3]] - vertices_[corner[k]];
        const auto b = vertices_[corner[(k + 2) % 3]] - vertices_[corner[k]];
        angle[corner[k]] += std::atan2(polylidar::detail::cross(a, b), polylidar::detail::dot(a, b));
      }
    });
    for_each_finite([&](Mesh::Index t) {
      if (!kept[t] || held_[t] <= 3) return;
      const Mesh::Index* const corner = mesh_.corners(t);
      if (std::min({angle[corner[0]], angle[corner[1]], angle[corner[2]]}) < kLeastAngle) kept[t] = false;
    });
  }

  /// visit(triangles, is_open) for the edge-connected regions of kept or of dropped finite triangles;
  /// is_open: whether one is at the border of the convex hull.
  template <class Visit>
  void for_each_region(const std::vector<bool>& kept, bool of_kept, const Visit& visit) const {
    std::vector<bool> seen(kept.size(), false);
    // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): a visit may change `kept`
    const std::vector<bool> is_kept = kept;
    std::vector<Mesh::Index> region;
    for_each_finite([&](Mesh::Index start) {
      if (seen[start] || is_kept[start] != of_kept) return;
      seen[start] = true;
      region.assign(1, start);
      bool is_open = false;
      for (std::size_t next = 0; next < region.size(); ++next) {
        for (Mesh::Index k = 0; k < 3; ++k) {
          const Mesh::Index other = polylidar::detail::neighbour(mesh_, region[next], k);
          if (mesh_.is_ghost(other)) {
            is_open = true;
          } else if (is_kept[other] == of_kept && !seen[other]) {
            seen[other] = true;
            region.push_back(other);
          }
        }
      }
      visit(std::span<const Mesh::Index>(region), is_open);
    });
  }

  const Mesh& mesh_;
  const Point* vertices_;
  double points_ = 0;                    ///< without repeats
  std::vector<std::size_t> first_;       ///< vertex -> its first neighbour in the next
  std::vector<Mesh::Index> neighbours_;  ///< vertex after vertex
  std::vector<double> spacing_;          ///< of a vertex
  std::vector<double> held_;             ///< triangle -> how many points its place would hold
};

}  // namespace

std::vector<bool> kept_by_vertex_spacing(const Mesh& mesh, const Point* vertices) {
  return VertexRule(mesh, vertices).keep();
}

}  // namespace hullbench::tune
