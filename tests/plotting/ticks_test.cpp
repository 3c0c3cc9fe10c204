#include "plotting/ticks.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

namespace muster::plotting {
namespace {

// 10,000 ranges over 24 decades, around zero and far from it.
std::vector<Range> many_ranges() {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<Range> ranges;
  while (ranges.size() < 10000) {
    const double size = std::pow(10, 12 * unit(random));
    const double offset = std::pow(10, 3 * unit(random)) * unit(random);
    const double low = size * (offset + unit(random)), high = low + size * (0.05 + std::abs(unit(random)));
    ranges.push_back({low, high});
  }
  return ranges;
}

// The mantissa of the step is 1, 2, 2.5 or 5, and each tick is a multiple of it.
bool round(const std::vector<Tick>& ticks) {
  const double step = ticks[1].value - ticks[0].value;
  const double mantissa = step / std::pow(10, std::floor(std::log10(step * 1.0000001)));
  const auto near = [](double a, double b) { return std::abs(a - b) < 1e-4 * b; };
  if (!near(mantissa, 1) && !near(mantissa, 2) && !near(mantissa, 2.5) && !near(mantissa, 5)) return false;
  for (const Tick& tick : ticks) {
    const double multiple = tick.value / step;
    if (std::abs(multiple - std::round(multiple)) > 1e-4) return false;
  }
  return true;
}

TEST(Ticks, AreFourToNineRoundAndInsideForAnyRange) {
  for (const Range& range : many_ranges()) {
    const auto ticks = ticks_within(range);
    ASSERT_GE(ticks.size(), 4u) << range.low << " " << range.high;
    ASSERT_LE(ticks.size(), 9u) << range.low << " " << range.high;
    ASSERT_TRUE(round(ticks)) << range.low << " " << range.high;
    const double rounding = 1e-8 * (range.span() + std::abs(range.low));
    ASSERT_GE(ticks.front().value, range.low - rounding);
    ASSERT_LE(ticks.back().value, range.high + rounding);
  }
}

TEST(Ticks, LeaveNoRoomForAnotherTickAtTheEnds) {
  for (const Range& range : many_ranges()) {
    const auto ticks = ticks_within(range);
    const double step = ticks[1].value - ticks[0].value;
    ASSERT_GT(ticks.front().value - step, range.low - 1.001 * step);
    ASSERT_LT(ticks.front().value - step, range.low);
    ASSERT_GT(ticks.back().value + step, range.high);
  }
}

TEST(Ticks, AreAtMostAsManyAsAskedFor) {
  for (const Range& range : many_ranges()) {
    for (int most = 2; most < 9; ++most) ASSERT_LE(ticks_within(range, most).size(), static_cast<std::size_t>(most));
  }
}

TEST(Ticks, BearTheNumbersThatPeopleWouldWrite) {
  const auto labels = [](Range range) {
    std::vector<std::string> result;
    for (const Tick& tick : ticks_within(range)) result.push_back(tick.label);
    return result;
  };
  EXPECT_THAT(labels({-80, -40}), testing::ElementsAre("−80", "−70", "−60", "−50", "−40"));
  EXPECT_THAT(labels({0, 1}), testing::ElementsAre("0.0", "0.2", "0.4", "0.6", "0.8", "1.0"));
  EXPECT_THAT(labels({-0.2, 0.3}), testing::ElementsAre("−0.2", "−0.1", "0.0", "0.1", "0.2", "0.3"));
  EXPECT_THAT(labels({0, 50000}),
              testing::ElementsAre("0", "10\u2009000", "20\u2009000", "30\u2009000", "40\u2009000", "50\u2009000"));
}

TEST(Ticks, ZeroAmongPowersOfTenIsShort) {
  EXPECT_EQ(ticks_within({0, 4e-6}, 9).front().label, "0");
  EXPECT_EQ(ticks_within({0, 4e-6}, 9).back().label, "4×10⁻⁶");
  EXPECT_EQ(ticks_within({0, 0.004}, 9).front().label, "0.000");
}

TEST(Ticks, AreExactDecimals) {
  const auto ticks = ticks_within({0, 0.5});
  EXPECT_EQ(ticks[3].value, 0.3);  // and not 0.30000000000000004
}

TEST(Ticks, NumbersAreRoundedAndNeverMinusZero) {
  EXPECT_EQ(number_label(-0.01, 1), "0.0");
  EXPECT_EQ(number_label(-54.4, 0), "−54");
  EXPECT_EQ(number_label(2e6, 0), "2×10⁶");
  EXPECT_EQ(number_label(1e7, 0), "10⁷");
  EXPECT_EQ(number_label(-2.5e-7, 0), "−2.5×10⁻⁷");
  EXPECT_EQ(number_label(1e15, 0), "10¹⁵");
}

TEST(LogTicks, AreRoundAndInside) {
  std::vector<double> values;
  for (const Tick& tick : log_ticks_within({0.9, 60})) values.push_back(tick.value);
  EXPECT_THAT(values, testing::ElementsAre(1, 2, 5, 10, 20, 50));
  values.clear();
  for (const Tick& tick : log_ticks_within({1e-3, 1e3})) values.push_back(tick.value);
  EXPECT_THAT(values, testing::ElementsAre(1e-3, 1e-2, 1e-1, 1, 10, 100, 1000));
  for (int decades = 1; decades < 300; ++decades) {
    const auto ticks = log_ticks_within({1, std::pow(10, decades)});
    EXPECT_GE(ticks.size(), 3u);
    EXPECT_LE(ticks.size(), 9u);
  }
}

TEST(AxisRange, HoldsTheDataAndWastesLittle) {
  for (const Range& data : many_ranges()) {
    const Range range = axis_range(data);
    ASSERT_LE(range.low, data.low);
    ASSERT_GE(range.high, data.high);
    ASSERT_LE(range.span(), 1.21 * data.span());
  }
}

TEST(AxisRange, GivesASingleValueRoom) {
  for (const double value : {0.0, -60.0, 1e-12, 1e12, 5e-324, -1e300}) {
    const Range range = axis_range({value, value});
    EXPECT_LT(range.low, value);
    EXPECT_GT(range.high, value);
    EXPECT_GE(ticks_within(range).size(), 4u);
  }
}

TEST(AxisRange, StartsAtZeroWhereTheDataDo) { EXPECT_EQ(axis_range({0, 8100}).low, 0); }

TEST(AxisRange, OnALogAxisHoldsTheDataAndStaysPositive) {
  for (const Range& data : {Range{1.5, 43}, {1e-9, 1e9}, {7, 7}, {1, 1.01}}) {
    const Range range = log_axis_range(data);
    EXPECT_GT(range.low, 0);
    EXPECT_LE(range.low, data.low);
    EXPECT_GE(range.high, data.high);
    EXPECT_LT(range.low, range.high);
  }
}

TEST(RoundLength, IsTheLongestRoundOneWithinTheLimit) {
  EXPECT_EQ(round_length(3).label, "2");
  EXPECT_EQ(round_length(5).value, 5);
  EXPECT_EQ(round_length(1000).value, 1000);
  EXPECT_EQ(round_length(0.19).label, "0.1");
  EXPECT_EQ(round_length(0.3).value, 0.2);
}

TEST(Scale, MapsEndsToEnds) {
  const Scale linear({-80, -40}, 300, 100);
  EXPECT_DOUBLE_EQ(linear(-80), 300);
  EXPECT_DOUBLE_EQ(linear(-60), 200);
  EXPECT_DOUBLE_EQ(linear(-40), 100);
  EXPECT_DOUBLE_EQ(linear.pixels(), 5);
}

TEST(Scale, GivesEachDecadeTheSameRoomOnALogAxis) {
  const Scale log({1, 1000}, 0, 300, true);
  EXPECT_NEAR(log(10), 100, 1e-9);
  EXPECT_NEAR(log(100), 200, 1e-9);
  EXPECT_TRUE(std::isnan(log(0)));
  EXPECT_TRUE(std::isnan(log(-3)));
}

TEST(Scale, HasNoPlaceForWhatIsNotANumber) {
  const Scale scale({0, 1}, 0, 100);
  EXPECT_TRUE(std::isnan(scale(NAN)));
  EXPECT_TRUE(std::isnan(scale(INFINITY)));
}

}  // namespace
}  // namespace muster::plotting
