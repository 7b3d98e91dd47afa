#include "benchmarks/hull/automatic_alpha.hpp"

#include <algorithm>

namespace hullbench {

double automatic_alpha(std::vector<double> edge_lengths) {
  constexpr double kEdges = 1.8;
  if (edge_lengths.empty()) return 0;
  const auto middle = edge_lengths.begin() + static_cast<std::ptrdiff_t>(edge_lengths.size() / 2);
  std::nth_element(edge_lengths.begin(), middle, edge_lengths.end());
  return kEdges * *middle;
}

}  // namespace hullbench
