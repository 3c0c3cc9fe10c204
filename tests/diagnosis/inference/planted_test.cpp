// A few worlds for each cause, with bounds of one false failure in a thousand runs.
#include "tests/diagnosis/inference/planted.hpp"

#include <gtest/gtest.h>

#include <cstdio>

namespace muster::synthetic {
namespace {

class Planted : public testing::TestWithParam<Rate> {};

TEST_P(Planted, AtLambda60IsNamed) {
  constexpr int worlds = 24;
  const Tally tally = planted(GetParam().cause, 60, 500, worlds, 4000, Shape::exponential);
  RecordProperty("found", tally.found);
  RecordProperty("taken_for_another_shape", tally.kin);
  RecordProperty("in_pieces", tally.pieces);
  std::printf("%s: %d of %d named, %d taken for another shape, %d in pieces, %d with a wrong name\n", GetParam().cause,
              tally.found, tally.worlds, tally.kin, tally.pieces, tally.wrong);
  EXPECT_GE(tally.found, least_successes(worlds, GetParam().found)) << tally.misses;
  EXPECT_GE(tally.found + tally.kin, least_successes(worlds, GetParam().kind)) << tally.misses;
  EXPECT_LE(tally.pieces, worlds - least_successes(worlds, 0.97)) << tally.misses;
  EXPECT_LE(tally.wrong, worlds - least_successes(worlds, 0.97)) << tally.misses;
}

INSTANTIATE_TEST_SUITE_P(Causes, Planted, testing::ValuesIn(rates),
                         [](const auto& rate) { return std::string(rate.param.cause); });

// A transmitter's offset is equal at all places: a field of unknown size absorbs it.
TEST(StatedField, RevealsAnOffset) {
  constexpr int worlds = 24;
  const auto named = [&](Field field) {
    return planted("tx_offset", 60, 500, worlds, 4000, Shape::exponential, field).found;
  };
  const int stated = named(Field::stated), unstated = named(Field::unstated);
  std::printf("tx_offset: %d of %d named, %d where the field is not stated\n", stated, worlds, unstated);
  EXPECT_GE(stated, unstated + 4);
}

TEST(CleanWorlds, NoFalseNames) {
  const Tally tally = planted("", 0, 700, 30, 3000, Shape::exponential);
  EXPECT_LE(tally.wrong, 30 - least_successes(30, 0.98)) << tally.misses;
  EXPECT_LE(tally.unexplained, 30 - least_successes(30, 0.98)) << tally.misses;
}

}  // namespace
}  // namespace muster::synthetic
