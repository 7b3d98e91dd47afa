#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "datasets/random.hpp"

namespace hullbench {
namespace {

using Words = std::vector<std::uint64_t>;

template <typename Generator>
Words first(Generator generator, std::size_t count) {
  Words words;
  for (std::size_t i = 0; i < count; ++i) words.push_back(generator.next());
  return words;
}

// All expected values here come from a short Python program that follows the published definitions with whole
// numbers of any size, written apart from this library.

TEST(SplitMix64, ReferenceValues) {
  EXPECT_EQ(first(SplitMix64(1234567), 5),
            (Words{6457827717110365317U, 3203168211198807973U, 9817491932198370423U, 4593380528125082431U,
                   16408922859458223821U}));
}

TEST(Random, ReferenceValuesFromState) {
  EXPECT_EQ(first(Random(std::array<std::uint64_t, 4>{1, 2, 3, 4}), 10),
            (Words{41943041U, 58720359U, 3588806011781223U, 3591011842654386U, 9228616714210784205U,
                   9973669472204895162U, 14011001112246962877U, 12406186145184390807U, 15849039046786891736U,
                   10450023813501588000U}));
}

TEST(Random, ReferenceValuesFromSeed) {
  EXPECT_EQ(first(Random(0), 4),
            (Words{5987356902031041503U, 7051070477665621255U, 6633766593972829180U, 211316841551650330U}));
  EXPECT_EQ(first(Random(42), 4), (Words{15021278609987233951U, 5881210131331364753U, 18149643915985481100U,
                                         12933668939759105464U}));
}

TEST(Random, StateOfZerosIsRefused) {
  EXPECT_THROW(Random(std::array<std::uint64_t, 4>{}), std::invalid_argument);
}

TEST(Random, UniformReferenceValues) {
  Random random(42);
  EXPECT_EQ(random.uniform(), 0x1.a0ec9a9e88ecdp-1);
  EXPECT_EQ(random.uniform(), 0x1.467905d15dbccp-2);
  EXPECT_EQ(random.uniform(), 0x1.f7c0f9f61849dp-1);
  EXPECT_EQ(random.uniform(), 0x1.66fb3ec019b06p-1);
}

TEST(Random, UniformStaysBelowOne) {
  // From this state the first output has all bits set: rotl(a + d, 23) + a with a = 0 and d = 2^64 - 1.
  Random random(std::array<std::uint64_t, 4>{0, 0, 0, ~std::uint64_t{0}});
  EXPECT_EQ(random.uniform(), 1 - 0x1p-53);
}

TEST(Random, BelowReferenceValues) {
  Random small(42);
  Words drawn;
  for (int i = 0; i < 12; ++i) drawn.push_back(small.below(10));
  EXPECT_EQ(drawn, (Words{1, 3, 0, 4, 1, 5, 8, 0, 5, 8, 4, 9}));
  // A bound just above 2^63 refuses nearly half of the outputs: without refusal the values would be others.
  Random large(42);
  drawn.clear();
  for (int i = 0; i < 4; ++i) drawn.push_back(large.below((std::uint64_t{1} << 63U) + 1));
  EXPECT_EQ(drawn,
            (Words{5797906573132458142U, 8926271879130705291U, 3710296902904329655U, 5414202205828049522U}));
}

TEST(Random, BelowOneIsZeroAndBelowZeroIsRefused) {
  Random random(1);
  EXPECT_EQ(random.below(1), 0U);
  EXPECT_THROW(random.below(0), std::invalid_argument);
}

TEST(Random, BetweenReachesFromLowToHigh) {
  Random random(42);
  EXPECT_EQ(random.between(-1, 3), -1 + 4 * 0x1.a0ec9a9e88ecdp-1);
  EXPECT_EQ(random.between(5, 5), 5);
}

TEST(Random, NormalReferenceValues) {
  Random random(42);
  for (const double expected : {0.9813983900724984, 1.3403256427520227, -0.9642205062941384,
                                0.1962265296745266, 0.20290854483035592, -2.2415265146996535}) {
    // The program worked with 40 digits; here the logarithm is off by two units in the last place at most,
    // and the five steps after it by half a unit each.
    EXPECT_DOUBLE_EQ(random.normal(), expected);
  }
}

TEST(Random, NormalHasTheMomentsAndTailsOfItsDistribution) {
  constexpr int kDraws = 1'000'000;
  Random random(7);
  double sum = 0;
  double squares = 0;
  double fourths = 0;
  int beyond_two = 0;
  int beyond_four = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double drawn = random.normal();
    sum += drawn;
    squares += drawn * drawn;
    fourths += drawn * drawn * drawn * drawn;
    if (drawn > 2) ++beyond_two;
    if (std::abs(drawn) > 4) ++beyond_four;
  }
  // Four standard errors of each: sqrt(1 / n), sqrt(2 / n), sqrt(96 / n), and sqrt(n p) with p = 0.02275 and
  // 6.334e-5.
  EXPECT_NEAR(sum / kDraws, 0, 0.004);
  EXPECT_NEAR(squares / kDraws, 1, 0.0057);
  EXPECT_NEAR(fourths / kDraws, 3, 0.04);
  EXPECT_NEAR(beyond_two, 22750, 600);
  EXPECT_NEAR(beyond_four, 63.3, 32);
}

TEST(DeriveSeed, ReferenceValues) {
  EXPECT_EQ(derive_seed(0, ""), 8794265229978523055U);
  EXPECT_EQ(derive_seed(1, "points/ca"), 4807600499834087042U);
  EXPECT_EQ(derive_seed(~std::uint64_t{0}, "holes/hi"), 5518316454542517968U);
}

}  // namespace
}  // namespace hullbench
