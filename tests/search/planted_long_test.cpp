// The promise in full: at lambda 60 named in 95 of 100 worlds, and at most 2 false names in 100 clean ones, for fields
// of three shapes.
#include <gtest/gtest.h>

#include "tests/search/planted.hpp"

namespace muster::synthetic {
namespace {

class PlantedLong : public testing::TestWithParam<const char*> {};

TEST_P(PlantedLong, AtLambda60IsNamedIn95Of100Worlds) {
  const Tally tally = planted(GetParam(), 60, 10000, 100, 6000, Shape::exponential);
  RecordProperty("found", tally.found);
  RecordProperty("taken_for_another_shape", tally.kin);
  RecordProperty("in_pieces", tally.pieces);
  RecordProperty("wrong", tally.wrong);
  EXPECT_GE(tally.found + tally.kin, 95) << tally.misses;
}

INSTANTIATE_TEST_SUITE_P(Causes, PlantedLong, testing::Values("tx_offset", "antenna_rx", "step", "unmapped_wall"),
                         [](const auto& cause) { return std::string(cause.param); });

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
