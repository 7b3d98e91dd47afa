// Quantiles are those of the sorted numbers, bit by bit, however they are found.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/src/quantile.hpp"
#include "tests/point_sets.hpp"

namespace polylidar::detail {
namespace {

using testing::Random;

// A number from anywhere: of any sign, size and number of repeats.
double any_number(Random& random) {
  switch (random.below(6)) {
    case 0:
      return 0;
    case 1:
      return static_cast<double>(random.below(5)) - 2;
    case 2:
      return std::ldexp(random.between(-1, 1), static_cast<int>(random.below(2000)) - 1000);
    case 3:
      return random.below(2) == 0 ? HUGE_VAL : -HUGE_VAL;
    case 4:
      return 1 + std::numeric_limits<double>::epsilon() * static_cast<double>(random.below(9));
    default:
      return random.between(-1, 1);
  }
}

TEST(Quantile, IsThatOfTheSortedNumbers) {
  const std::vector<std::pair<const char*, std::function<double(Random&)>>> kinds = {
      {"any", any_number},
      {"uniform", [](Random& random) { return random.unit(); }},
      {"steep", [](Random& random) { return std::exp(40 * random.unit()); }},
      {"close", [](Random& random) { return 1 + 1e-12 * random.unit(); }},
      {"few values", [](Random& random) { return static_cast<double>(random.below(3)); }},
      {"signs", [](Random& random) { return random.between(-1, 1); }}};
  for (const auto& [name, draw] : kinds) {
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
      SCOPED_TRACE(::testing::Message() << name << ", seed " << seed);
      Random random(seed);
      std::vector<double> values(1 + random.below(seed % 4 == 0 ? 2000 : 130));
      for (double& value : values) value = draw(random);
      std::vector<double> sorted = values;
      std::sort(sorted.begin(), sorted.end());
      for (const double quantile : {0.0, 0.5, 0.6, 0.9, 1.0, random.unit()}) {
        const auto rank = std::min(sorted.size() - 1,
                                   static_cast<std::size_t>(quantile * static_cast<double>(sorted.size())));
        EXPECT_EQ(quantile_of(values, quantile), sorted[rank]) << quantile;
      }
      const std::size_t rank = random.below(sorted.size());
      const std::optional<double> found = Ranking(values).at(rank);
      EXPECT_EQ(found.value_or(sorted[rank]), sorted[rank]);
      std::sort(values.begin(), values.end());
      EXPECT_EQ(values, sorted) << "no number was lost";
    }
  }
}

TEST(Quantile, OfManyNumbersInOneCellIsLeftToASort) {
  std::vector<double> values(100, 1.0);
  values.front() = HUGE_VAL;
  EXPECT_EQ(Ranking(values).at(50), std::nullopt);
  EXPECT_EQ(Ranking(values).at(99), HUGE_VAL);
  EXPECT_EQ(quantile_of(values, 0.5), 1.0);
}

TEST(Quantile, OrdersNumbersAsTheyAre) {
  const std::vector<double> ascending = {-HUGE_VAL, -1e300, -1, -1e-310, 0, 1e-310, 1, 1e300, HUGE_VAL};
  const std::vector<double> descending(ascending.rbegin(), ascending.rend());
  for (std::size_t i = 0; i < ascending.size(); ++i) EXPECT_EQ(Ranking(descending).at(i), ascending[i]);
}

}  // namespace
}  // namespace polylidar::detail
