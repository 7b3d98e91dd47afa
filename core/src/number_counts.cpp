#include "number_counts.hpp"

#include <algorithm>
#include <cmath>

#include "quantile.hpp"

namespace polylidar::detail {

void NumberCounts::clear() {
  counts_.clear();
  total_ = 0;
}

double NumberCounts::middle_of(std::size_t own) {
  constexpr std::size_t kHalf = std::size_t{1} << (kBits - 1);
  if (own < 2 * kHalf) return static_cast<double>(own);
  const auto shift = static_cast<int>(own / kHalf) - 1;
  const std::size_t first_bits = own - static_cast<std::size_t>(shift) * kHalf;
  return std::ldexp(static_cast<double>(first_bits) + 0.5, shift);
}

double NumberCounts::median() const {
  std::size_t own = 0;
  for (std::size_t below = counts_[0]; below <= rank_of(0.5, total_);) below += counts_[++own];
  return middle_of(own);
}

double NumberCounts::robust_deviation_of_logarithms(double middle) {
  distances_.clear();
  for (std::size_t own = 0; own < counts_.size(); ++own) {
    if (counts_[own] != 0) distances_.emplace_back(std::abs(std::log(middle_of(own) / middle)), counts_[own]);
  }
  std::sort(distances_.begin(), distances_.end());
  const std::size_t rank = rank_of(RobustDeviation::kQuantile, total_);
  auto at = distances_.begin();
  for (std::size_t below = at->second; below <= rank;) below += (++at)->second;
  return at->first / RobustDeviation::kOfNormal;
}

}  // namespace polylidar::detail
