#include "benchmarks/tune/search.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace hullbench::tune {
namespace {

class Search {
 public:
  Search(const SearchAxis& axis, const std::function<Trial(double)>& evaluate)
      : axis_(axis), evaluate_(evaluate) {}

  std::vector<SearchPoint> run() {
    const std::vector<double> positions = grid(axis_, kSweepPoints);
    int timeouts = 0;
    for (const double position : positions) {
      const Trial trial = evaluate_(position);
      points_.push_back({position, trial.error, true});
      timeouts = trial.timed_out ? timeouts + 1 : 0;
      if (timeouts == kMostTimeouts) break;
    }
    const auto best =
        std::ranges::min_element(points_, [](const auto& a, const auto& b) { return a.error < b.error; });
    if (best == points_.end() || is_infinitely_bad(best->error)) return points_;
    const auto place = static_cast<std::size_t>(best - points_.begin());
    refine(std::log2(positions[place == 0 ? 0 : place - 1]),
           std::log2(positions[std::min(place + 1, positions.size() - 1)]));
    return points_;
  }

 private:
  /// Golden-section search between two logarithms of positions.
  void refine(double low, double high) {
    constexpr double kShare = 1 / std::numbers::phi;
    double left = high - kShare * (high - low);
    double right = low + kShare * (high - low);
    double left_error = refined(left);
    double right_error = refined(right);
    for (int used = 2; used < kRefinements; ++used) {
      if (left_error <= right_error) {
        high = right;
        right = left;
        right_error = left_error;
        left = high - kShare * (high - low);
        left_error = refined(left);
      } else {
        low = left;
        left = right;
        left_error = right_error;
        right = low + kShare * (high - low);
        right_error = refined(right);
      }
    }
  }

  /// The error at the position with that logarithm; a count's positions fall together, and are asked for
  /// once.
  double refined(double logarithm) {
    const double exact = std::exp2(logarithm);
    const double position = axis_.unit == "count" ? std::round(exact) : exact;
    const auto known =
        std::ranges::find_if(points_, [&](const SearchPoint& point) { return point.position == position; });
    if (known != points_.end()) return known->error;
    points_.push_back({position, evaluate_(position).error, false});
    return points_.back().error;
  }

  const SearchAxis& axis_;
  const std::function<Trial(double)>& evaluate_;
  std::vector<SearchPoint> points_;
};

}  // namespace

std::vector<SearchPoint> search(const SearchAxis& axis, const std::function<Trial(double)>& evaluate) {
  return Search(axis, evaluate).run();
}

}  // namespace hullbench::tune
