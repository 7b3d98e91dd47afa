// The median and the spread of many whole numbers.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace polylidar::detail {

/// How often each number occurs, of numbers above 0. Numbers of 256 and more that differ by less than 0.8 %
/// may count as one.
class NumberCounts {
 public:
  void clear();
  void add(std::uint32_t number) {
    const std::size_t own = class_of(number);
    if (own >= counts_.size()) counts_.resize(own + 1, 0);
    ++counts_[own];
    ++total_;
  }
  std::size_t total() const { return total_; }
  /// Needs at least one number, as the next does.
  double median() const;
  /// Of the logarithms from that of `middle`.
  double robust_deviation_of_logarithms(double middle);

 private:
  static constexpr unsigned kBits = 8;  ///< of a number, from its first on, that decide its class
  static std::size_t class_of(std::uint32_t number) {
    const auto width = static_cast<unsigned>(std::bit_width(number));
    const unsigned shift = width > kBits ? width - kBits : 0;
    return (std::size_t{shift} << (kBits - 1)) + (number >> shift);
  }
  static double middle_of(std::size_t own);

  std::vector<std::uint32_t> counts_;  ///< class -> how many numbers
  std::size_t total_ = 0;
  std::vector<std::pair<double, std::uint32_t>> distances_;  ///< of classes, with their counts
};

}  // namespace polylidar::detail
