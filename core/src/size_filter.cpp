#include "size_filter.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>

#include "kept_words.hpp"

namespace polylidar::detail {

namespace {

/// Triangles that were met on a walk.
class SeenTriangles {
 public:
  /// None of `mesh`'s yet.
  SeenTriangles(const Mesh& mesh, Scratch<std::uint64_t>& storage)
      : words_(storage.reserve(mesh.word_count())) {
    std::fill_n(words_, mesh.word_count(), 0);
  }
  bool contain(Mesh::Index t) const { return (words_[t / Mesh::kWordBits] & bit_of(t)) != 0; }
  /// Returns whether `t` is new.
  bool add(Mesh::Index t) {
    const bool is_new = !contain(t);
    words_[t / Mesh::kWordBits] |= bit_of(t);
    return is_new;
  }
  void remove(Mesh::Index t) { words_[t / Mesh::kWordBits] &= ~bit_of(t); }

 private:
  std::uint64_t* words_;
};

/// Whether `t`, dropped(k) of whose neighbours says which are not kept, stands out of the shape at an acute
/// angle: at least two are.
template <class Dropped>
bool stands_out(const Mesh& mesh, const Point* vertices, Mesh::Index t, const Dropped& dropped) {
  Mesh::Index count = 0;
  Mesh::Index base = 0;  // the half-edge that is not on the border
  for (Mesh::Index k = 0; k < 3; ++k) {
    if (dropped(k)) {
      ++count;
    } else {
      base = Mesh::kStride * t + k;
    }
  }
  if (count != 2) return count == 3;
  const Point& apex = vertices[mesh.origin(Mesh::previous(base))];
  const Vector to_start = vertices[mesh.origin(base)] - apex;
  const Vector to_end = vertices[mesh.origin(Mesh::next(base))] - apex;
  return dot(to_start, to_end) > 0;
}

/// A triangle that is no spike however it stands.
class NoSpikeRule {
 public:
  NoSpikeRule(const SizeField& field, const Mesh& mesh, Mesh::Index t)
      : most4_(field.spike_share * field.limit4_at(mesh, t)) {}
  bool keeps(const Triangle& triangle) const { return triangle.size4() <= most4_; }
  double most4() const { return most4_; }

 private:
  double most4_;
};

/// Infinite where the triangle is flat.
double squared_circumradius(const Triangle& triangle) {
  const double twice_area = triangle.twice_area();
  return triangle.squared_ab() * triangle.squared_bc() * triangle.squared_ca() /
         (4 * twice_area * twice_area);
}

/// Whether a triangle's size is at most the limit, by whichever of its corners it is computed;
/// kRoundingDecides where that may matter. The squares of its edges are the same from everywhere. The doubled
/// area is a difference of two products of edges' components, which together are at most the square of the
/// longest edge, each off by 3 2^-53 of itself, and rounded once more: from two corners it differs by less
/// than 2^-49 of that square. And the size grows with the area, in floating-point numbers too.
Answer ask_size(const Triangle& triangle, double most4) {
  const double twice_area = triangle.twice_area();
  const double rounding = 0x1p-49 * triangle.squared_longest_edge();
  if (triangle.size4(twice_area + rounding) <= most4) return Answer::kYes;
  return triangle.size4(twice_area - rounding) > most4 ? Answer::kNo : Answer::kRoundingDecides;
}

/// The mesh of all points: whatever a walk meets can be asked about.
class WholeMesh {
 public:
  static constexpr bool kIsAll = true;
  WholeMesh(const Mesh& mesh, const Point* vertices) : mesh_(mesh), vertices_(vertices) {}
  static bool is_open(Mesh::Index /*kept*/) { return true; }
  static bool is_hidden(Mesh::Index /*t*/) { return false; }
  static bool is_known_at(Mesh::Index /*vertex*/) { return true; }
  /// Whether `t` keeps to `rule`.
  template <class Rule>
  Answer ask(const Rule& rule, Mesh::Index t) const {
    return rule.keeps(Triangle(mesh_, vertices_, t)) ? Answer::kYes : Answer::kNo;
  }

 private:
  const Mesh& mesh_;
  const Point* vertices_;
};

}  // namespace

/// The mesh of a part.
struct SizeFilter::PartMesh {
  static constexpr bool kIsAll = false;
  const Mesh& mesh;
  const Point* vertices;
  const std::uint8_t* is_tested;
  const SizeField& field;
  const IsSure& is_sure_of;
  SeenTriangles& hidden;

  bool is_sure(Index t) const {
    return has_marked_corner(mesh, t, is_tested) || is_sure_of(Triangle(mesh, vertices, t));
  }
  bool is_hidden(Index t) const { return hidden.contain(t); }
  /// Whether all triangles at a vertex are those of the whole mesh.
  bool is_known_at(Index vertex) const { return is_tested[vertex] != 0; }
  template <class Rule>
  Answer ask(const Rule& rule, Index t) const {
    if constexpr (requires { rule.most4(); }) {
      const Answer answer = ask_size(Triangle(mesh, vertices, t), rule.most4());
      if (answer != Answer::kRoundingDecides) return answer;
    }
    return ask_from_all_corners(mesh, vertices, t, [&](const Triangle& one) { return rule.keeps(one); });
  }
  /// Whether a walk may go on through a kept triangle: it is one of the whole mesh, and no spike of a hole
  /// that is not looked at.
  bool is_open(Index t) const {
    if (!is_sure(t)) return false;
    if (ask(NoSpikeRule(field, mesh, t), t) == Answer::kYes) return true;
    for (Index k = 0; k < 3; ++k) {
      const Index other = neighbour(mesh, t, k);
      if (!mesh.is_ghost(other) && mesh.is_kept(other) && (is_hidden(other) || !is_sure(other))) return false;
    }
    return true;
  }
};

void SizeFilter::run(const Mesh& mesh, const Point* vertices, const SizeField& field, ThreadPool& pool,
                     std::uint64_t* kept) {
  keep_within_limit(mesh, vertices, field, pool, kept);
  drop_spikes(mesh, vertices, field, pool, kept);
  const WholeMesh whole(mesh, vertices);
  if (field.least_region > 0 && !drop_small_regions(mesh, whole, field.least_region, kept) &&
      field.detail4 > 1 && has_large_region_with_less_detail(mesh, vertices, field, pool, kept)) {
    std::fill_n(kept, mesh.word_count(), 0);
  }
  if (field.wide_square > 0) fill_small_holes(mesh, vertices, whole, field, kept);
}

/// Whether some region is large at a detail of 1. `kept` is the same afterwards.
bool SizeFilter::has_large_region_with_less_detail(const Mesh& mesh, const Point* vertices,
                                                   const SizeField& field, ThreadPool& pool,
                                                   std::uint64_t* kept) {
  SizeField usual = field;
  for (double& limit4 : usual.limit4) limit4 *= field.detail4;
  const std::vector<std::uint64_t> before(kept, kept + mesh.word_count());
  keep_within_limit(mesh, vertices, usual, pool, kept);
  drop_spikes(mesh, vertices, usual, pool, kept);
  const bool has_large = drop_small_regions(mesh, WholeMesh(mesh, vertices), field.least_region, kept);
  std::copy(before.begin(), before.end(), kept);
  return has_large;
}

namespace {

/// Where all triangles of the mesh were measured. The two triangles of a vertex have one limit. The size of a
/// ghost is NaN, which is not within it.
void keep_measured(const Mesh& mesh, const SizeField& field, ThreadPool& pool, std::uint64_t* kept) {
  for_each_word_chunk(mesh, Chunks(pool, mesh.triangle_count()), pool,
                      [&](std::size_t, std::size_t begin, std::size_t end) {
                        for (std::size_t w = begin; w < end; ++w) {
                          const auto first = static_cast<Mesh::Index>(Mesh::kWordBits * w);
                          const Mesh::Index count = std::min(Mesh::kWordBits, mesh.triangle_count() - first);
                          const double* const size4 = &field.size4[first];
                          const std::uint32_t* const block = &field.block_of_vertex[first / 2];
                          std::uint64_t word = 0;
                          for (Mesh::Index k = 0; k < count; k += 2) {
                            const double limit4 = field.limit4[block[k / 2]];
                            word |= std::uint64_t{size4[k] <= limit4} << k;
                            word |= std::uint64_t{size4[k + 1] <= limit4} << (k + 1);
                          }
                          kept[w] = word;
                        }
                      });
}

}  // namespace

void SizeFilter::keep_within_limit(const Mesh& mesh, const Point* vertices, const SizeField& field,
                                   ThreadPool& pool, std::uint64_t* kept) {
  const auto filter_by = [&](const auto& rule) {
    for_each_word_chunk(mesh, Chunks(pool, mesh.triangle_count()), pool,
                        [&](std::size_t, std::size_t begin, std::size_t end) {
                          fill_words(mesh, begin, end, kept, [&](Index t) {
                            return !mesh.is_ghost(t) && rule.keeps(Triangle(mesh, vertices, t));
                          });
                        });
  };
  if (field.size4 != nullptr) {
    keep_measured(mesh, field, pool, kept);
  } else if (field.is_one()) {
    filter_by(OneSizeRule(field.limit4.front()));
  } else {
    filter_by(SizeRule(field, mesh));
  }
}

std::optional<Way> SizeFilter::run_on_part(const Mesh& mesh, const Point* vertices,
                                           const std::uint8_t* is_tested, const SizeField& field,
                                           const IsSure& is_sure, ThreadPool& pool, std::uint64_t* kept) {
  SeenTriangles hidden(mesh, hidden_);
  const PartMesh part{mesh, vertices, is_tested, field, is_sure, hidden};
  doubt_.reset();
  doubtful_.clear();
  drop_beyond_limit(part, pool, kept);
  if (!doubt_) follow_dropped(part, kept);
  if (doubt_) return doubt_;
  if (!doubtful_.empty()) return Way::kReachesFar;
  for (const Index t : changed_) drop(kept, t);
  if (field.least_region > 0 && !drop_small_regions(mesh, part, field.least_region, kept) &&
      field.detail4 > 1) {
    doubt_ = Way::kReachesFar;  // the limit at a detail of 1 is beyond the part
  }
  if (field.wide_square > 0) fill_small_holes(mesh, vertices, part, field, kept);
  if (!doubt_ && !doubtful_.empty()) return Way::kReachesFar;
  return doubt_;
}

/// Drops the triangles with a tested corner that are beyond the limit, and puts them and the ghosts into
/// found_of_chunk_. Others beyond it, if they are sure, are hidden: kept, unless they are reached.
void SizeFilter::drop_beyond_limit(const PartMesh& part, ThreadPool& pool, std::uint64_t* kept) {
  const Mesh& mesh = part.mesh;
  const Chunks chunks(pool, mesh.triangle_count());
  clear_found(chunks);
  std::atomic<bool> agree = true;
  for_each_word_chunk(mesh, chunks, pool, [&](std::size_t c, std::size_t begin, std::size_t end) {
    std::vector<Index>& dropped = found_of_chunk_[c];
    fill_words(mesh, begin, end, kept, [&](Index t) {
      if (mesh.is_ghost(t)) {
        if (!mesh.is_unused(t)) dropped.push_back(t);
        return false;
      }
      const Answer answer = part.ask(OneSizeRule(part.field.limit4_at(mesh, t)), t);
      const bool has_tested = has_marked_corner(mesh, t, part.is_tested);
      if (answer != Answer::kYes && !has_tested) {
        if (part.is_sure_of(Triangle(mesh, part.vertices, t))) part.hidden.add(t);
      } else if (answer != Answer::kYes) {
        dropped.push_back(t);
      }
      if (answer == Answer::kRoundingDecides && part.is_sure(t)) agree = false;
      return answer == Answer::kYes || !has_tested;
    });
  });
  if (!agree) doubt_ = Way::kRoundingDecides;
}

/// Walks from what drop_beyond_limit() found to all dropped triangles that are connected to it. Drops those
/// that were hidden, and puts spikes into changed_. doubtful_ are the triangles that would have to be sure.
void SizeFilter::follow_dropped(const PartMesh& part, std::uint64_t* kept) {
  const Mesh& mesh = part.mesh;
  group_.clear();
  for (const std::vector<Index>& dropped : found_of_chunk_) {
    group_.insert(group_.end(), dropped.begin(), dropped.end());
  }
  // Before spikes are dropped.
  const auto is_dropped = [&](Index t) { return !mesh.is_kept(t) || part.hidden.contain(t); };
  SeenTriangles seen(mesh, seen_);
  changed_.clear();
  for (std::size_t next = 0; next < group_.size() && !doubt_; ++next) {
    for (Index k = 0; k < 3 && !doubt_; ++k) {
      const Index other = neighbour(mesh, group_[next], k);
      if (!mesh.is_kept(other) || seen.contain(other)) continue;
      if (part.hidden.contain(other)) {
        part.hidden.remove(other);
        drop(kept, other);
        group_.push_back(other);
        continue;
      }
      seen.add(other);
      if (!part.is_sure(other)) {
        doubtful_.push_back(other);
        continue;
      }
      const Answer no_spike = part.ask(NoSpikeRule(part.field, mesh, other), other);
      if (no_spike == Answer::kYes) continue;
      if (no_spike == Answer::kRoundingDecides) doubt_ = Way::kRoundingDecides;
      for (Index j = 0; j < 3; ++j) {
        const Index third = neighbour(mesh, other, j);
        if (!is_dropped(third) && !part.is_sure(third)) doubtful_.push_back(third);
      }
      if (!stands_out(mesh, part.vertices, other,
                      [&](Index j) { return is_dropped(neighbour(mesh, other, j)); })) {
        continue;
      }
      changed_.push_back(other);
      group_.push_back(other);
    }
  }
}

void SizeFilter::clear_found(const Chunks& chunks) {
  found_of_chunk_.resize(std::max(found_of_chunk_.size(), chunks.size()));
  for (std::vector<Index>& found : found_of_chunk_) found.clear();
}

void SizeFilter::drop_spikes(const Mesh& mesh, const Point* vertices, const SizeField& field,
                             ThreadPool& pool, std::uint64_t* kept) {
  const Chunks chunks(pool, mesh.triangle_count());
  clear_found(chunks);
  for_each_word_chunk(mesh, chunks, pool, [&](std::size_t c, std::size_t begin, std::size_t end) {
    for_each_dropped(mesh, begin, end, kept, [&](Index t) {
      for (Index k = 0; k < 3; ++k) {
        const Index other = neighbour(mesh, t, k);
        if (mesh.is_kept(other) &&
            stands_out(mesh, vertices, other,
                       [&](Index j) { return !mesh.is_kept(neighbour(mesh, other, j)); }) &&
            !NoSpikeRule(field, mesh, other).keeps(Triangle(mesh, vertices, other))) {
          found_of_chunk_[c].push_back(other);
        }
      }
    });
  });
  // Not before all threads have read which triangles are kept.
  for (const std::vector<Index>& spikes : found_of_chunk_) {
    for (const Index t : spikes) drop(kept, t);
  }
}

/// The half-edge of the border that follows `e`, one of a kept triangle whose twin's is not: turning at its
/// end through kept triangles. kNone where one of these may not be kept in the mesh of all points.
template <class Whole>
Mesh::Index next_on_border(const Mesh& mesh, const Whole& whole, Mesh::Index e) {
  e = Mesh::next(e);
  if (!whole.is_known_at(mesh.origin(e))) return kNone;
  while (true) {
    const Mesh::Index twin = mesh.twin(e);
    const Mesh::Index other = Mesh::triangle_of(twin);
    if (!mesh.is_kept(other)) return e;
    if (whole.is_hidden(other)) return kNone;
    e = Mesh::next(twin);
  }
}

/// Returns false if there are only small regions, which stay. walk_region() tells which are.
///
/// In the mesh of a part, that walk may not be allowed to go on. But a region of t triangles has at most t +
/// 2 half-edges on its border. So where least_region + 2 of these follow one another, the region is large
/// enough. They follow one another in the mesh of all points, too: at a tested vertex all triangles are those
/// of that mesh, and those that are passed are kept in it. A spike of it is on two dropped triangles. Where
/// one of these was met, the spike was dropped here, too; otherwise both are hidden, and one of them has a
/// corner at the vertex and is passed as well.
template <class Whole>
bool SizeFilter::drop_small_regions(const Mesh& mesh, const Whole& whole, std::size_t least_region,
                                    std::uint64_t* kept) {
  const std::size_t long_border = least_region + 2;
  SeenTriangles seen(mesh, seen_);
  changed_.clear();
  // Returns how many half-edges follow one another from `first` on, at most `most`.
  const auto walk_border = [&](Index first, std::size_t most, const auto& visit) {
    std::size_t length = 0;
    Index e = first;
    do {
      visit(Mesh::triangle_of(e));
      ++length;
      e = next_on_border(mesh, whole, e);
    } while (e != first && e != kNone && length < most);
    return length;
  };
  for_each_dropped(mesh, 0, mesh.word_count(), kept, [&](Index dropped) {
    for (Index k = 0; k < 3; ++k) {
      const Index e = mesh.twin(Mesh::kStride * dropped + k);
      const Index start = Mesh::triangle_of(e);
      if (!mesh.is_kept(start) || seen.contain(start)) continue;
      const bool is_long = !Whole::kIsAll && walk_border(e, long_border, [](Index) {}) == long_border;
      if (is_long || (walk_region(mesh, whole, e, least_region, seen) && Whole::kIsAll)) {
        walk_border(e, std::numeric_limits<std::size_t>::max(), [&](Index t) { seen.add(t); });
      }
    }
  });
  // Where all regions are small there is nothing that they are small beside.
  std::size_t count = 0;
  for (std::size_t w = 0; w < mesh.word_count(); ++w) {
    count += static_cast<std::size_t>(std::popcount(kept[w]));
  }
  if (changed_.size() == count) return false;
  for (const Index t : changed_) drop(kept, t);
  return true;
}

/// Walks through a region from half-edge `border` on until it is large enough, meets triangles that are known
/// to be of a large one, or ends. If it ends, puts it into changed_, and the triangles at which it cannot go
/// on into doubtful_, and returns false.
template <class Whole, class Seen>
bool SizeFilter::walk_region(const Mesh& mesh, const Whole& whole, Index border, std::size_t least_region,
                             Seen& seen) {
  seen.add(Mesh::triangle_of(border));
  group_.assign(1, border);  // the half-edges by which the walk came
  const std::size_t before = doubtful_.size();
  bool is_large = false;
  bool is_beside_hidden = false;
  for (std::size_t next = 0; next < group_.size() && !is_large; ++next) {
    const Index came_by = group_[next];
    for (Index e = Mesh::next(came_by); e != came_by; e = Mesh::next(e)) {
      const Index twin = mesh.twin(e);
      const Index other = Mesh::triangle_of(twin);
      if (!mesh.is_kept(other)) continue;
      const bool is_seen = seen.contain(other);
      const auto is_other = [other](Index half_edge) { return Mesh::triangle_of(half_edge) == other; };
      if (is_seen && std::any_of(group_.begin(), group_.end(), is_other)) continue;
      if (whole.is_hidden(other)) {
        is_beside_hidden = true;
      } else if (!whole.is_open(other)) {
        doubtful_.push_back(other);
      } else if (is_seen) {
        is_large = true;
      } else {
        seen.add(other);
        group_.push_back(twin);
      }
    }
    is_large |= group_.size() >= least_region;
  }
  if (is_large) {
    doubtful_.resize(before);
    return true;
  }
  // What is hidden would be connected to what is dropped.
  if (is_beside_hidden) doubt_ = Way::kReachesFar;
  for (const Index e : group_) changed_.push_back(Mesh::triangle_of(e));
  return false;
}

template <class Whole>
void SizeFilter::fill_small_holes(const Mesh& mesh, const Point* vertices, const Whole& whole,
                                  const SizeField& field, std::uint64_t* kept) {
  SeenTriangles seen(mesh, seen_);
  const auto enter = [&](Index t) {
    if (!mesh.is_kept(t) && !mesh.is_ghost(t) && seen.add(t)) group_.push_back(t);
  };
  const auto enter_neighbours = [&](Index t) {
    for (Index k = 0; k < 3; ++k) enter(neighbour(mesh, t, k));
  };
  group_.clear();  // first what is connected to the outside
  for_each_dropped(mesh, 0, mesh.word_count(), kept, [&](Index t) {
    if (mesh.is_ghost(t)) enter_neighbours(t);
  });
  for (std::size_t next = 0; next < group_.size();) enter_neighbours(group_[next++]);
  changed_.clear();
  const CircumradiusRule not_wide(field.wide_radius);
  for_each_dropped(mesh, 0, mesh.word_count(), kept, [&](Index start) {
    group_.clear();
    enter(start);
    if (group_.empty()) return;
    bool has_wide = field.wide_radius == 0;
    double squared_radius = 0;  // the greatest
    double squared_sizes = 0;   // of the kept triangles along its border
    std::size_t border = 0;
    for (std::size_t next = 0; next < group_.size();) {
      const Index t = group_[next++];
      // Only triangles that are too large count: one that was dropped as a spike or with a small region may
      // lie where some of the mesh was not built. Nor do those count whose circumradius rounding may have
      // made.
      const double too_close = kTooClose * field.wide_radius;
      if (Triangle(mesh, vertices, t).squared_shortest_edge() >= too_close * too_close &&
          whole.ask(OneSizeRule(field.limit4_at(mesh, t)), t) != Answer::kYes) {
        squared_radius = std::max(squared_radius, squared_circumradius(from_least_corner(mesh, vertices, t)));
        if (!has_wide) {
          const Answer answer = whole.ask(not_wide, t);
          has_wide = answer != Answer::kYes;
          if (answer == Answer::kRoundingDecides) doubt_ = Way::kRoundingDecides;
        }
      }
      for (Index j = 0; j < 3; ++j) {
        const Index other = neighbour(mesh, t, j);
        enter(other);
        if (!mesh.is_kept(other)) continue;
        const double size4 =
            field.size4 != nullptr ? field.size4[other] : Triangle(mesh, vertices, other).size4();
        squared_sizes += std::sqrt(size4);
        ++border;
      }
    }
    const double widest = squared_radius * static_cast<double>(border);
    const double least = field.wide_square * squared_sizes;
    // How the mesh was built changes a size by less than 2^-43 of itself (as in ask_size: its area by less
    // than 2^-49 of the square of its longest edge, which is at most 4 e^2, and the size's fourth power is at
    // least e^4 / 16). And it changes the order of the sum, which rounds each time by 2^-53 at most.
    const double rounding = 0x1p-42 + 0x1p-52 * static_cast<double>(border);
    if (has_wide && std::abs(widest - least) <= rounding * least) doubt_ = Way::kRoundingDecides;
    if (has_wide && widest >= least) return;
    changed_.insert(changed_.end(), group_.begin(), group_.end());
  });
  for (const Index t : changed_) keep(kept, t);
}

}  // namespace polylidar::detail
