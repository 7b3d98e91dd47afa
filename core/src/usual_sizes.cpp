#include "usual_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "quantile.hpp"

namespace polylidar::detail {

void UsualSizes::reset(std::size_t blocks, std::size_t chunks) {
  usual4_.assign(blocks, kUnknown);
  borders_of_chunk_.resize(chunks);
  for (std::vector<Border>& borders : borders_of_chunk_) borders.clear();
}

/// Calls visit(block, neighbour) for each side of each border that is short in the block's own scale, by
/// measured4_: beyond lies another part, or nothing is known of the block.
template <class Visit>
void UsualSizes::for_each_neighbour(double reach, const Visit& visit) const {
  const double reach4 = fourth_power(reach);
  for (const std::vector<Border>& borders : borders_of_chunk_) {
    for (const Border& border : borders) {
      if (border.length4 <= reach4 * measured4_[border.block]) visit(border.block, border.neighbour);
      if (border.length4 <= reach4 * measured4_[border.neighbour]) visit(border.neighbour, border.block);
    }
  }
}

void UsualSizes::smooth(const AutomaticConstants& constants) {
  if (usual4_.size() < constants.smoothed_from) return;
  constexpr double kFine = 0x1p32;  // whole numbers, so that a sum does not depend on the order
  measured4_ = usual4_;
  logs_.resize(usual4_.size());
  std::transform(usual4_.begin(), usual4_.end(), logs_.begin(),
                 [](double usual4) { return std::log(usual4) / 4; });
  neighbour_sums_.assign(usual4_.size(), {});
  for_each_neighbour(constants.reach, [&](std::uint32_t block, std::uint32_t neighbour) {
    if (!std::isfinite(logs_[neighbour])) return;
    neighbour_sums_[block].sum += std::llround(kFine * logs_[neighbour]);
    ++neighbour_sums_[block].count;
  });
  scratch_.clear();
  for (std::size_t b = 0; b < usual4_.size(); ++b) {
    const auto [sum, count] = neighbour_sums_[b];
    const bool is_alone = !std::isfinite(logs_[b]) || count == 0;
    constexpr double kSides = 2;  // of a border
    const double share = static_cast<double>(count) / (static_cast<double>(count) + kSides);
    const double difference =
        is_alone ? 0 : static_cast<double>(sum) / (kFine * static_cast<double>(count)) - logs_[b];
    logs_[b] = share * difference;  // to the mean of the block and its neighbours
    if (!is_alone) scratch_.push_back(std::sqrt(share) * difference);  // as a block's own deviation
  }
  if (scratch_.empty()) return;
  const double rough = robust_deviation(scratch_, 0);
  if (rough <= constants.noise) return;
  const double kept = (constants.noise / rough) * (constants.noise / rough);
  for (std::size_t b = 0; b < usual4_.size(); ++b) usual4_[b] *= std::exp(4 * (1 - kept) * logs_[b]);
}

double UsualSizes::level_above(double size4) {
  scratch_.clear();
  std::copy_if(usual4_.begin(), usual4_.end(), std::back_inserter(scratch_),
               [&](double usual4) { return usual4 <= size4; });
  if (scratch_.empty()) return kUnknown;
  const double most4 = quantile_of(scratch_, 0.5);
  for (double& usual4 : usual4_) {
    if (usual4 < kUnknown) usual4 = std::min(usual4, most4);
  }
  return most4;
}

void UsualSizes::bound_growth(std::size_t blocks, const AutomaticConstants& constants) {
  measured4_ = usual4_;
  const double factor4 = fourth_power(1 + constants.growth / std::sqrt(static_cast<double>(blocks)));
  bool is_changed = true;
  while (is_changed) {
    smallest_.assign(usual4_.size(), {});
    for_each_neighbour(constants.reach, [&](std::uint32_t block, std::uint32_t neighbour) {
      Smallest& smallest = smallest_[block];
      if (neighbour == smallest.neighbour) return;
      if (usual4_[neighbour] < smallest.first4) {
        smallest = {neighbour, usual4_[neighbour], smallest.first4};
      } else {
        smallest.second4 = std::min(smallest.second4, usual4_[neighbour]);
      }
    });
    is_changed = false;
    for (std::size_t b = 0; b < usual4_.size(); ++b) {
      const Smallest& smallest = smallest_[b];
      const double most4 = factor4 * (smallest.second4 < kUnknown ? smallest.second4 : smallest.first4);
      if (usual4_[b] <= most4) continue;
      usual4_[b] = most4;
      is_changed = true;
    }
  }
}

void UsualSizes::take_medians_of_neighbours() {
  measured4_ = usual4_;
  std::vector<std::vector<double>> known(usual4_.size());  // block -> its own, then those round it
  const auto add = [&](std::uint32_t block, std::uint32_t neighbour) {
    if (measured4_[neighbour] != kUnknown) known[block].push_back(measured4_[neighbour]);
  };
  for (std::uint32_t b = 0; b < usual4_.size(); ++b) add(b, b);
  for (const std::vector<Border>& borders : borders_of_chunk_) {
    for (const Border& border : borders) {
      add(border.block, border.neighbour);
      add(border.neighbour, border.block);
    }
  }
  for (std::size_t b = 0; b < usual4_.size(); ++b) {
    if (!known[b].empty()) usual4_[b] = quantile_of(known[b], 0.5);
  }
}

void UsualSizes::shrink_to_median(double noise) {
  scratch_.clear();
  for (const double usual4 : usual4_) {
    if (usual4 != kUnknown) scratch_.push_back(std::log(usual4) / 4);
  }
  if (scratch_.empty()) return;
  const double median = quantile_of(scratch_, 0.5);
  const double spread = robust_deviation(scratch_, median);
  const double kept = spread > noise ? std::sqrt(1 - (noise / spread) * (noise / spread)) : 0;
  for (double& usual4 : usual4_) {
    const double log = usual4 == kUnknown ? median : std::log(usual4) / 4;
    usual4 = std::exp(4 * (median + kept * (log - median)));
  }
}

double UsualSizes::raise_least(double share) {
  scratch_ = usual4_;
  const double least4 = quantile_of(scratch_, share);
  for (double& usual4 : usual4_) usual4 = std::max(usual4, least4);
  return least4;
}

}  // namespace polylidar::detail
