#include "outline_fill.hpp"

#include <algorithm>

#include "filter_rules.hpp"
#include "kept_words.hpp"
#include "vector.hpp"

namespace polylidar::detail {

namespace {

/// Calls visit(touch) for those of `touches`, which are sorted by `member`, that have `value` there.
template <class Touch, class Visit>
void for_each_with(const std::vector<Touch>& touches, Mesh::Index Touch::*member, Mesh::Index value,
                   const Visit& visit) {
  const auto first = std::lower_bound(touches.begin(), touches.end(), value,
                                      [&](const Touch& touch, Mesh::Index v) { return touch.*member < v; });
  for (auto touch = first; touch != touches.end() && (*touch).*member == value; ++touch) visit(*touch);
}

}  // namespace

bool OutlineFill::run(const Mesh& mesh, const Point* vertices, const OutlineSteps& outlines,
                      std::uint64_t* kept) {
  find_walls_and_faces(mesh, vertices, outlines.squared_step);
  find_depths();
  const auto is_enclosed = [&](Index t) {
    return is_wall_[t] != 0 || depth_[faces_.standing_for(t)] % 2 == 1;
  };
  double twice_area = 0;
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.is_ghost(t) && is_enclosed(t)) twice_area += Triangle(mesh, vertices, t).twice_area();
  }
  constexpr double kMostWithin = 0.4;
  constexpr double kLeastBetween = 0.5;
  if (outlines.twice_area >= kMostWithin * twice_area && share_between(mesh) < kLeastBetween) return false;
  fill_words(mesh, 0, mesh.word_count(), kept, [&](Index t) {
    return !mesh.is_ghost(t) &&
           (is_enclosed(t) || Triangle(mesh, vertices, t).squared_longest_edge() <= outlines.squared_reach);
  });
  return true;
}

void OutlineFill::find_walls_and_faces(const Mesh& mesh, const Point* vertices, double squared_step) {
  const Index outside = mesh.triangle_count();
  walls_.reset(mesh.triangle_count() / 2 + 1);
  faces_.reset(std::size_t{outside} + 1);
  is_wall_.assign(outside, 1);
  for (Index t = 0; t < outside; ++t) {
    if (mesh.is_ghost(t)) continue;
    for (Index k = 0; k < 3; ++k) {
      const Index edge = Mesh::kStride * t + k;
      const Index a = mesh.origin(edge);
      const Index b = mesh.origin(Mesh::next(edge));
      if (squared_length(vertices[a] - vertices[b]) <= squared_step) {
        walls_.join(a, b);
        continue;
      }
      is_wall_[t] = 0;
      const Index other = neighbour(mesh, t, k);
      faces_.join(t, mesh.is_ghost(other) ? outside : other);
    }
  }

  walls_of_face_.clear();
  for (Index t = 0; t < outside; ++t) {
    if (mesh.is_unused(t)) continue;
    const bool is_ghost = mesh.is_ghost(t);
    if (!is_ghost && is_wall_[t] != 0) continue;
    const Index face = faces_.standing_for(is_ghost ? outside : t);
    for (Index k = 0; k < (is_ghost ? 2U : 3U); ++k) {
      walls_of_face_.push_back({face, walls_.standing_for(mesh.corners(t)[k])});
    }
  }
  const auto sort_by = [](std::vector<Touch>& touches, auto first, auto second) {
    std::sort(touches.begin(), touches.end(), [&](const Touch& a, const Touch& b) {
      return a.*first < b.*first || (a.*first == b.*first && a.*second < b.*second);
    });
  };
  sort_by(walls_of_face_, &Touch::face, &Touch::wall);
  const auto last =
      std::unique(walls_of_face_.begin(), walls_of_face_.end(),
                  [](const Touch& a, const Touch& b) { return a.face == b.face && a.wall == b.wall; });
  walls_of_face_.erase(last, walls_of_face_.end());
  faces_of_wall_ = walls_of_face_;
  sort_by(faces_of_wall_, &Touch::wall, &Touch::face);
}

/// From the outside on, face by face; each is reached, since triangles that share a corner touch one wall.
void OutlineFill::find_depths() {
  const auto outside = static_cast<Index>(is_wall_.size());
  depth_.assign(is_wall_.size() + 1, kNone);
  is_passed_.assign(is_wall_.size() / 2 + 1, 0);
  queue_.assign(1, faces_.standing_for(outside));
  depth_[queue_.front()] = 0;
  for (std::size_t next = 0; next < queue_.size(); ++next) {
    const Index face = queue_[next];
    for_each_with(walls_of_face_, &Touch::face, face, [&](const Touch& border) {
      if (is_passed_[border.wall] != 0) return;
      is_passed_[border.wall] = 1;
      for_each_with(faces_of_wall_, &Touch::wall, border.wall, [&](const Touch& beyond) {
        if (depth_[beyond.face] != kNone) return;
        depth_[beyond.face] = depth_[face] + 1;
        queue_.push_back(beyond.face);
      });
    });
  }
}

/// The share of the points that stand between inside and outside: of each wall as many as touch the side that
/// fewer of its points touch.
double OutlineFill::share_between(const Mesh& mesh) {
  enum Side : std::uint8_t { kOutside = 1, kInside = 2, kNeither = 4 };
  sides_.assign(is_wall_.size() / 2 + 1, 0);
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.is_unused(t)) continue;
    const bool is_ghost = mesh.is_ghost(t);
    const Index face = is_ghost ? mesh.triangle_count() : t;
    const bool is_face = is_ghost || is_wall_[t] == 0;
    const Side side = !is_face ? kNeither : depth_[faces_.standing_for(face)] % 2 == 1 ? kInside : kOutside;
    for (Index k = 0; k < (is_ghost ? 2U : 3U); ++k) {
      std::uint8_t& sides = sides_[mesh.corners(t)[k]];
      sides = static_cast<std::uint8_t>(sides | side);
    }
  }
  points_of_wall_.assign(sides_.size(), {});
  double points = 0;
  for (Index v = 0; v < sides_.size(); ++v) {
    WallPoints& wall = points_of_wall_[walls_.standing_for(v)];
    wall.outside += (sides_[v] & kOutside) != 0 ? 1U : 0U;
    wall.inside += (sides_[v] & kInside) != 0 ? 1U : 0U;
    points += sides_[v] != 0 ? 1 : 0;
  }
  double between = 0;
  for (const WallPoints& wall : points_of_wall_) between += std::min(wall.outside, wall.inside);
  return between / points;
}

}  // namespace polylidar::detail
