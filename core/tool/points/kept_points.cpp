#include "tool/points/kept_points.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tool/points/huge_pages.hpp"

namespace polylidar::tool::point_files {

LatticePoint Lattice::nearest(const Point& p) const {
  const auto whole = [](double number) {
    constexpr double kMost = 0x7FFFFFFF;
    return static_cast<std::int32_t>(std::nearbyint(std::fmax(std::fmin(number, kMost), -kMost - 1)));
  };
  return {whole((p.x - offset.x) / scale.x), whole((p.y - offset.y) / scale.y)};
}

bool KeptPoints::begin(std::uint64_t count, const Lattice& lattice) {
  points_.reset();
  count_ = 0;
  is_whole_ = false;
  if (count > most_bytes_ / sizeof(LatticePoint)) return false;
  lattice_ = lattice;
  const auto room = static_cast<std::size_t>(count);
  points_ = std::make_unique_for_overwrite<LatticePoint[]>(room);
  ask_for_huge_pages(points_.get(), room * sizeof(LatticePoint));
  return true;
}

void KeptPoints::hand_on(const TakePoints& take, std::size_t block_size) const {
  std::vector<Point> block(std::min(block_size, count_));
  for (std::size_t begin = 0; begin < count_; begin += block_size) {
    const std::size_t size = std::min(block_size, count_ - begin);
    const Lattice lattice = lattice_;
    const LatticePoint* const points = points_.get() + begin;
    for (std::size_t i = 0; i < size; ++i) block[i] = lattice.at(points[i]);
    take(std::span(block).first(size));
  }
}

}  // namespace polylidar::tool::point_files
