// Which ring is a hole of which.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "adapters/ring_nesting.hpp"
#include "tests/hull_oracle.hpp"

namespace hullbench {
namespace {

using polylidar::MultiPolygon;
using polylidar::Ring;

Ring square(double low, double high) {
  return {{low, low}, {high, low}, {high, high}, {low, high}};
}

Ring clockwise(Ring ring) {
  std::ranges::reverse(ring);
  return ring;
}

TEST(RingNesting, OfNothingIsNothing) {
  EXPECT_EQ(nest_rings({}), MultiPolygon());
  EXPECT_EQ(nest_rings({{}, {}}), MultiPolygon());
}

// Squares in one another are by turns shell and hole, in whichever order and direction they come.
TEST(RingNesting, ARingInAHoleIsAShell) {
  const MultiPolygon expected = {{square(0, 9), {clockwise(square(1, 8))}},
                                 {square(2, 7), {clockwise(square(3, 6))}},
                                 {square(10, 11), {}}};
  std::vector<Ring> rings = {square(0, 9), square(1, 8), clockwise(square(2, 7)), clockwise(square(3, 6)),
                             square(10, 11)};
  for (int i = 0; i < 5; ++i) {
    std::rotate(rings.begin(), rings.begin() + 1, rings.end());
    EXPECT_EQ(polylidar::testing::canonical(nest_rings(rings)), polylidar::testing::canonical(expected));
  }
}

TEST(RingNesting, AShellKeepsAllItsHoles) {
  const MultiPolygon expected = {{square(0, 9), {clockwise(square(1, 2)), clockwise(square(3, 4))}}};
  EXPECT_EQ(polylidar::testing::canonical(nest_rings({square(3, 4), square(0, 9), square(1, 2)})),
            polylidar::testing::canonical(expected));
}

}  // namespace
}  // namespace hullbench
