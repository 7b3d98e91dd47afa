// How steady a run's times are.
#include <gtest/gtest.h>

#include "benchmarks/report/noise.hpp"

namespace hullbench {
namespace {

record::RunRecord run_with(std::vector<std::int64_t> times) {
  record::RunRecord run;
  run.time_ns = std::move(times);
  return run;
}

TEST(Noise, IsTheMedianOfTheRowsSpreads) {
  // Spreads 10 / 100, 0 and 5 / 50; two repetitions tell nothing.
  const auto noise = report::measure_noise({run_with({90, 100, 110}), run_with({7, 7, 7, 9, 7}),
                                            run_with({50, 45, 55, 1000, 0}), run_with({1, 1000})});
  ASSERT_TRUE(noise);
  EXPECT_EQ(noise->rows, 3U);
  EXPECT_DOUBLE_EQ(noise->median_spread, 0.1);
  EXPECT_DOUBLE_EQ(noise->ninth_decile, 0.1);
  EXPECT_TRUE(noise->is_noisy());
}

TEST(Noise, OfASteadyMachineIsNotNoisy) {
  const auto noise = report::measure_noise({run_with({990, 1000, 1010}), run_with({1000, 1000, 1300})});
  ASSERT_TRUE(noise);
  EXPECT_DOUBLE_EQ(noise->median_spread, 0.005);
  EXPECT_DOUBLE_EQ(noise->ninth_decile, 0.009);
  EXPECT_FALSE(noise->is_noisy());
}

TEST(Noise, WithoutRepetitionsIsNotKnown) {
  EXPECT_FALSE(report::measure_noise({}));
  EXPECT_FALSE(report::measure_noise({run_with({}), run_with({5}), run_with({0, 0, 0})}));
}

}  // namespace
}  // namespace hullbench
