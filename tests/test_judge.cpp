// What is faster, slower or undecided.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "benchmarks/statistics/judge.hpp"

namespace hullbench::statistics {
namespace {

TEST(Judge, TheWholeIntervalDecides) {
  EXPECT_EQ(side_of({0.8, 0.9}, 1), Side::kBelow);
  EXPECT_EQ(side_of({1.1, 1.2}, 1), Side::kAbove);
  EXPECT_EQ(side_of({0.9, 1.1}, 1), Side::kUndecided);
}

TEST(Judge, AnIntervalMayEndAtTheLimit) {
  EXPECT_EQ(side_of({0.8, 1}, 1), Side::kBelow);
  EXPECT_EQ(side_of({1, 1.2}, 1), Side::kAbove);
  EXPECT_EQ(side_of({1, 1}, 1), Side::kBelow);
}

TEST(Judge, WithFewTimesOnlyTenTimesAsLongIsLonger) {
  const std::vector<std::int64_t> few = {100, 120};
  EXPECT_EQ(side_of_times(few, std::vector<std::int64_t>{1200}), Side::kBelow);
  EXPECT_EQ(side_of_times(few, std::vector<std::int64_t>{1199}), Side::kUndecided);
  EXPECT_EQ(side_of_times(few, std::vector<std::int64_t>{10}), Side::kAbove);
  EXPECT_EQ(side_of_times(few, std::vector<std::int64_t>{11}), Side::kUndecided);
  const std::vector<std::int64_t> many = {100, 101, 102, 103};
  EXPECT_EQ(side_of_times(many, std::vector<std::int64_t>{110, 111, 112, 113}), Side::kBelow);
  EXPECT_EQ(side_of_times(many, many), Side::kUndecided);
}

TEST(Judge, OfTimesAnIntervalThatEndsAtOneIsUndecided) {
  const std::vector<std::int64_t> times = {100, 101, 102, 103};
  // 103 on both sides: the largest ratio that is not rejected is 1, with p = 4 / 70.
  EXPECT_EQ(side_of_times(times, std::vector<std::int64_t>{103, 110, 111, 112}), Side::kUndecided);
  EXPECT_EQ(side_of_times(std::vector<std::int64_t>{103, 110, 111, 112}, times), Side::kUndecided);
}

TEST(Judge, ManyQuestionsAskForMoreEvidence) {
  const Evidence clear = {{1.1, 1.2}, 0.02};
  const Evidence nothing = {{0.9, 1.1}, 0.5};
  EXPECT_EQ(judge(std::vector{clear}, 1, 0.05).front().side, Side::kAbove);
  const std::vector<Judgement> three = judge(std::vector{clear, nothing, nothing}, 1, 0.05);
  EXPECT_EQ(three.front().side, Side::kUndecided);
  EXPECT_DOUBLE_EQ(three.front().p_value, 0.06);
  EXPECT_EQ(three.back().side, Side::kUndecided);
}

TEST(Judge, WithoutATestTheIntervalSaysItAll) {
  EXPECT_EQ(judge(std::vector{Evidence{{0.5, 0.6}}}, 1, 0.05).front().side, Side::kBelow);
  EXPECT_TRUE(judge({}, 1, 0.05).empty());
}

}  // namespace
}  // namespace hullbench::statistics
