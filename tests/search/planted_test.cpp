// A few worlds a cause, with bounds that chance alone crosses once in a thousand runs.
#include "tests/search/planted.hpp"

#include <gtest/gtest.h>

#include <cstdio>

namespace muster::synthetic {
namespace {

// Rates at lambda 60, measured on 60 other worlds each; `kind` counts a place of the other shape (a wall called an
// obstacle) as found.
struct Rate {
  const char* cause;
  double found, kind;
};

class Planted : public testing::TestWithParam<Rate> {};

TEST_P(Planted, AtLambda60IsNamed) {
  const Tally tally = planted(GetParam().cause, 60, 500, 12, 4000, Shape::exponential);
  RecordProperty("found", tally.found);
  RecordProperty("taken_for_another_shape", tally.kin);
  RecordProperty("in_pieces", tally.pieces);
  std::printf("%s: %d of %d named, %d taken for another shape, %d in pieces, %d with a wrong name\n", GetParam().cause,
              tally.found, tally.worlds, tally.kin, tally.pieces, tally.wrong);
  EXPECT_GE(tally.found, least_successes(12, GetParam().found)) << tally.misses;
  EXPECT_GE(tally.found + tally.kin, least_successes(12, GetParam().kind)) << tally.misses;
  EXPECT_LE(tally.pieces, 12 - least_successes(12, 0.97)) << tally.misses;
  EXPECT_LE(tally.wrong, 12 - least_successes(12, 0.97)) << tally.misses;
}

INSTANTIATE_TEST_SUITE_P(Causes, Planted,
                         testing::Values(Rate{"tx_offset", 0.72, 0.72}, Rate{"rx_offset", 0.98, 0.98},
                                         Rate{"antenna_rx", 0.97, 0.97}, Rate{"step", 0.83, 0.83},
                                         Rate{"unmapped_wall", 0.91, 0.97}),
                         [](const auto& rate) { return std::string(rate.param.cause); });

TEST(Clean, WorldsStaySilent) {
  const Tally tally = planted("", 0, 700, 30, 3000, Shape::exponential);
  EXPECT_LE(tally.wrong, 30 - least_successes(30, 0.98)) << tally.misses;
  EXPECT_LE(tally.unexplained, 30 - least_successes(30, 0.98)) << tally.misses;
}

}  // namespace
}  // namespace muster::synthetic
