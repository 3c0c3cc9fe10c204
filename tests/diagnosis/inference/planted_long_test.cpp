// A hundred worlds for each cause and for fields of three shapes. Goals: 95 named at lambda 60, and at most 2 false
// names in 100 clean worlds. Rates below a goal must not fall further.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "tests/diagnosis/inference/planted.hpp"

namespace muster::synthetic {
namespace {

class PlantedLong : public testing::TestWithParam<Rate> {};

TEST_P(PlantedLong, AtLambda60IsNamedAsOftenAsMeasured) {
  const Tally tally = planted(GetParam().cause, 60, 10000, 100, 6000, Shape::exponential);
  RecordProperty("found", tally.found);
  RecordProperty("taken_for_another_shape", tally.kin);
  RecordProperty("in_pieces", tally.pieces);
  RecordProperty("wrong", tally.wrong);
  std::printf("%s: %d of 100 named, %d by another shape; the goal is 95\n", GetParam().cause, tally.found, tally.kin);
  EXPECT_GE(tally.found + tally.kin, least_successes(100, std::min(0.95, GetParam().kind))) << tally.misses;
}

INSTANTIATE_TEST_SUITE_P(Causes, PlantedLong, testing::ValuesIn(rates),
                         [](const auto& rate) { return std::string(rate.param.cause); });

class CleanLong : public testing::TestWithParam<Shape> {};

TEST_P(CleanLong, AtMostTwoFalseNamesIn100Worlds) {
  const Tally tally = planted("", 0, 20000, 100, 6000, GetParam());
  RecordProperty("wrong", tally.wrong);
  RecordProperty("unexplained", tally.unexplained);
  EXPECT_LE(tally.wrong, 2) << tally.misses;
  EXPECT_LE(tally.unexplained, 2) << tally.misses;
}

INSTANTIATE_TEST_SUITE_P(Fields, CleanLong, testing::Values(Shape::exponential, Shape::gaussian, Shape::two_scale));

}  // namespace
}  // namespace muster::synthetic
