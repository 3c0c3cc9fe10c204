// Clips, steps, units and isolated readings of a receiver, from made-up tables.
#include "diagnosis/radio/links/receiver_checks.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/diagnosis/scratch.hpp"

namespace muster::diagnosis {
namespace {

// `at_top` readings at -40 dBm, five at -41, `before` at -42 and -43, and 10 at each level down to -60. `both_ways`:
// each is measured in the other direction, too.
Dataset readings(const Scratch& scratch, int at_top, int before = 10, bool both_ways = false) {
  std::string text = "t[s],tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm]\n";
  int row = 0;
  const auto add = [&](int level, int count) {
    for (int k = 0; k < count; ++k, ++row) {
      const std::string t = std::to_string(row), x = std::to_string(row % 9 + 1),
                        end = ',' + std::to_string(level) + '\n';
      text += t + ",a,b,0,0," + x + ",2" + end;
      if (both_ways) text += t + ",b,a," + x + ",2,0,0" + end;
    }
  };
  for (int level = -60; level < -41; ++level) add(level, level < -43 ? 10 : before);
  add(-41, 5);
  add(-40, at_top);
  return read_dataset(scratch.write("data.csv", text));
}

TEST(ReceiverChecks, ReadingsThatPileUpAreAClip) {
  const Scratch scratch;
  const ReceiverChecks found = receiver_checks(readings(scratch, 40));
  EXPECT_DOUBLE_EQ(found.step, 1);
  ASSERT_TRUE(found.top);
  EXPECT_DOUBLE_EQ(found.top->level, -40);
  EXPECT_EQ(found.top->count, 40u);
  EXPECT_EQ(found.top->beside, 5u);
  EXPECT_EQ(found.top->row, 195u);
  EXPECT_LT(found.top->log_p, std::log(1e-6));
  EXPECT_FALSE(found.bottom);  // 10 at the lowest level, 10 beside it
}

// 26 moments are no pile, and neither are their 52 readings.
TEST(ReceiverChecks, BothDirectionsOfAMomentAreOneOfAPile) {
  const Scratch scratch;
  EXPECT_FALSE(receiver_checks(readings(scratch, 26, 10, true)).top);
  const ReceiverChecks found = receiver_checks(readings(scratch, 40, 10, true));
  ASSERT_TRUE(found.top);
  EXPECT_EQ(found.top->count, 40u);
}

// A mesh whose strongest link hardly changes: as many readings at the highest level, all of one link.
TEST(ReceiverChecks, APileOfOneLinkIsNoEnd) {
  const auto mesh = [](const Scratch& scratch, bool of_one_link) {
    std::string text = "t[s],tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm]\n";
    int row = 0;
    const auto add = [&](int level, int count, bool one) {
      for (int k = 0; k < count; ++k, ++row) {
        const std::string other = one ? "b" : std::string(1, static_cast<char>('b' + row % 7));
        text += std::to_string(row) + ",a," + other + ",0,0," + std::to_string(row % 9 + 1) + ",2," +
                std::to_string(level) + "\n";
      }
    };
    for (int level = -60; level < -40; ++level) add(level, level < -43 ? 12 : 5, false);
    add(-40, 60, of_one_link);
    return receiver_checks(read_dataset(scratch.write("data.csv", text))).top.has_value();
  };
  const Scratch scratch;
  EXPECT_TRUE(mesh(scratch, false));
  EXPECT_FALSE(mesh(scratch, true));
}

// A robot that turns in the shadow of a wall, without fading: one level both ways, at places half a metre apart.
TEST(ReceiverChecks, APileAtOnePlaceIsNoEnd) {
  const auto turns_within = [](const Scratch& scratch, double extent) {
    std::string text = "t[s],tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm]\n";
    const auto add = [&](int k, double x, int level) {
      const std::string at = std::to_string(x) + ",4", station = "0,0", time = std::to_string(0.5 * k);
      text += time + ",base,robot," + station + "," + at + "," + std::to_string(level) + "\n";
      text += time + ",robot,base," + at + "," + station + "," + std::to_string(level) + "\n";
    };
    for (int k = 0; k < 90; ++k) add(k, 0.2 * k, -60 - k / 6);
    for (int k = 90; k < 110; ++k) add(k, 20 + extent * (k % 2), -90);
    return receiver_checks(read_dataset(scratch.write("data.csv", text))).bottom.has_value();
  };
  const Scratch scratch;
  EXPECT_FALSE(turns_within(scratch, 0.5));
  EXPECT_TRUE(turns_within(scratch, 3));
}

// A robot crosses a trough of shadowing that two of three stations see; elsewhere the third link is at that level, too.
TEST(ReceiverChecks, APileInATroughIsOfOnePlace) {
  const auto readings_of = [](const Scratch& scratch, bool elsewhere) {
    std::string text = "t[s],tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm]\n";
    for (int k = 0; k < 60; ++k) {
      const double x = 0.25 * k;
      const int trough = x > 6 && x < 7.5 ? -96 : -70;
      const std::string time = std::to_string(k), at = std::to_string(x) + ",4,";
      text += time + ",robot,a," + at + "0,0," + std::to_string(trough) + "\n";
      text += time + ",b,robot,9,0," + at + std::to_string(trough) + "\n";
      text += time + ",c,robot,0,9," + at + std::to_string(elsewhere && k == 59 ? -96 : -60) + "\n";
    }
    return read_dataset(scratch.write("data.csv", text));
  };
  const Scratch scratch;
  const Dataset one = readings_of(scratch, false), two = readings_of(scratch, true);
  EXPECT_NEAR(extent_at_level(one, -96), 1, 1e-9);
  EXPECT_EQ(links_at_level(one, -96), 2u);
  EXPECT_NEAR(extent_at_level(two, -96), 14.75 - 6.25, 1e-9);
  EXPECT_EQ(links_at_level(two, -96), 3u);
}

TEST(ReceiverChecks, NoClipForAFrequentLevel) {
  const Scratch scratch;
  EXPECT_FALSE(receiver_checks(readings(scratch, 10)).top);  // no more than its neighbours
  EXPECT_FALSE(receiver_checks(readings(scratch, 14)).top);  // too few to decide
}

TEST(ReceiverChecks, ASmallPileIsComparedWithAllLevelsNearIt) {
  const Scratch scratch;
  EXPECT_FALSE(receiver_checks(readings(scratch, 27)).top);
  EXPECT_TRUE(receiver_checks(readings(scratch, 27, 3)).top);
}

ReceiverCheck check_called(const ReceiverChecks& receiver, const std::string& what) {
  for (const ReceiverCheck& c : receiver.checks)
    if (c.what.rfind(what, 0) == 0) return c;
  return {};
}

// 40 distinct readings with two decimals: their step is unknown, not zero.
std::string two_decimals(const std::string& sign) {
  std::string text = "t[s],tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm]\n";
  for (int row = 0; row < 40; ++row)
    text += std::to_string(row) + ",a,b,0,0,1,2," + sign + "0." + std::to_string(11 + row) + "\n";
  return text;
}

TEST(ReceiverChecks, NoStepFromTooFewReadings) {
  const Scratch scratch;
  EXPECT_EQ(check_called(receiver_checks(readings(scratch, 40)), "the step").found, "1 dB");
  EXPECT_EQ(check_called(receiver_checks(read_dataset(scratch.write("data.csv", two_decimals("-")))), "the step").found,
            "not known: 40 readings of 40 levels are too few to tell; three levels and four readings a level would do");
}

TEST(ReceiverChecks, LevelsAboveAMilliwattAreCounted) {
  const Scratch scratch;
  const auto check = [&](const std::string& more) {
    const auto file = scratch.write("data.csv", two_decimals("-") + more);
    return check_called(receiver_checks(read_dataset(file)), "levels above 0 dBm");
  };
  EXPECT_EQ(check("").found, "none in 40 rows");
  EXPECT_EQ(check("41,a,b,0,0,1,2,2.5\n").found, "1 of 41 readings");
  EXPECT_EQ(check("41,a,b,0,0,1,2,2.5\n").row, 41u);
}

TEST(ReceiverChecks, AMarkForNothingIsListed) {
  const Scratch scratch;
  const auto file = scratch.write("data.csv", two_decimals("-") + "41,a,b,0,0,1,2,-128\n");
  EXPECT_EQ(check_called(receiver_checks(read_dataset(file)), "marks for none").found,
            "1 at -128 dBm, taken as not received");
}

TEST(ReceiverChecks, AnIsolatedReadingIsReportedWithItsRow) {
  const Scratch scratch;
  const auto check = [&](const std::string& more) {
    const auto file = scratch.write("data.csv", two_decimals("-") + more);
    return check_called(receiver_checks(read_dataset(file)), "one to three readings 30 dB");
  };
  EXPECT_TRUE(check("41,a,b,0,0,1,2,-30\n").fine);  // 29.5 dB below the next
  const ReceiverCheck low = check("41,a,b,0,0,1,2,-90\n42,a,b,0,0,1,2,-95\n");
  EXPECT_FALSE(low.fine);
  EXPECT_EQ(low.found, "-95 dBm");
  EXPECT_EQ(low.row, 42u);
  EXPECT_EQ(check("41,a,b,0,0,1,2,29.9\n").row, 41u);
  std::string many;
  for (int row = 41; row < 45; ++row) many += std::to_string(row) + ",a,b,0,0,1,2,-90\n";
  EXPECT_TRUE(check(many).fine);  // four are a level of their own
}

TEST(ReceiverChecks, LevelsArePrintedWithoutRoundingErrors) {
  const Scratch scratch;
  std::string text = two_decimals("-") + "41,a,b,0,0,1,2,-0.1000000000000003\n";
  const ReceiverChecks found = receiver_checks(read_dataset(scratch.write("data.csv", text)));
  EXPECT_EQ(check_called(found, "readings that pile up at the highest").found, "1 at -0.1 dBm");
}

}  // namespace
}  // namespace muster::diagnosis
