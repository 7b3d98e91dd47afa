#include "tool/points/labels.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

namespace polylidar::tool::point_files {
namespace {

/// Numbers by value, then other texts; of equal ones the bytes decide.
auto order_of(const std::string& label) {
  double value = 0;
  const auto [end, error] = std::from_chars(label.data(), label.data() + label.size(), value);
  const bool is_number = error == std::errc() && end == label.data() + label.size() && std::isfinite(value);
  return std::make_tuple(!is_number, is_number ? value : 0, std::string_view(label));
}

}  // namespace

std::uint32_t Labels::index_of(std::string_view label) {
  const auto found = numbers_.find(label);
  if (found != numbers_.end()) return found->second;
  const auto number = static_cast<std::uint32_t>(numbers_.size());
  numbers_.emplace(label, number);
  return number;
}

void Labels::finish(PointFile& file) const {
  std::vector<std::pair<std::string, std::uint32_t>> sorted(numbers_.begin(), numbers_.end());
  std::sort(sorted.begin(), sorted.end(),
            [](const auto& a, const auto& b) { return order_of(a.first) < order_of(b.first); });
  std::vector<std::uint32_t> place(sorted.size());
  file.labels.clear();
  for (auto& [label, number] : sorted) {
    place[number] = static_cast<std::uint32_t>(file.labels.size());
    file.labels.push_back(std::move(label));
  }
  for (std::uint32_t& group : file.groups) group = place[group];
}

}  // namespace polylidar::tool::point_files
