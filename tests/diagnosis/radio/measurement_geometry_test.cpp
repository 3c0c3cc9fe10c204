// Ways, headings and moving ends of the measurements.
#include "diagnosis/radio/links/measurement_geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/radio/causes/place_moves.hpp"
#include "diagnosis/radio/links/moving_end.hpp"
#include "tests/diagnosis/scratch.hpp"
#include "tests/diagnosis/worlds.hpp"

namespace muster::diagnosis {
namespace {

MeasurementGeometry driven_with(const std::function<double(int)>& yaw) {
  const Scratch scratch;
  const auto world = scratch.write("world.xml",
                                   "<world name=\"w\" dt=\"1\" until=\"1\" seed=\"1\">\n"
                                   "  <station name=\"s\" at=\"0 0 0.5\"/>\n  <radio.multiwall/>\n</world>\n");
  std::string table = "t[s],tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rx_yaw[rad],rssi[dBm]\n";
  for (int k = 0; k < 40; ++k)
    table += std::to_string(k) + ",s,r,0,0," + std::to_string(30 - 0.5 * k) + ",5," + std::to_string(yaw(k)) + ",-" +
             std::to_string(60 + k % 3) + "\n";
  const auto file = scratch.write("readings.csv", table);
  return measurement_geometry(LinkModel(world, file, plugins), read_dataset(file));
}

// A robot that drives west has headings at both ends of their range.
TEST(MeasurementGeometry, AHeadingPastHalfATurnIsNoTurn) {
  const MeasurementGeometry west = driven_with([](int k) { return k % 2 == 0 ? 3.13 : -3.13; });
  EXPECT_FALSE(west.receivers_turn);
  EXPECT_EQ(std::count(west.turns.begin(), west.turns.end(), true), 0);
  const MeasurementGeometry turns = driven_with([](int k) { return std::remainder(0.2 * k, 2 * M_PI); });
  EXPECT_TRUE(turns.receivers_turn);
  EXPECT_EQ(std::count(turns.turns.begin(), turns.turns.end(), true), 1);
}

// Pieces of a way of 0.8 m: the middle of one is driven through as its ends are, unless the robot may have driven
// round.
TEST(MeasurementGeometry, AWayIsDrivenBetweenItsReadings) {
  MeasurementGeometry survey;
  for (int k = 0; k < 10; ++k) survey.ways.push_back({0.8 * k, 2, 0.8 * (k + 1), 2});
  for (double x = 0.2; x < 8; x += 0.2) {
    EXPECT_TRUE(driven_through(survey, x, 2.35, 0.6)) << x;
    EXPECT_FALSE(driven_through(survey, x, 2.45, 0.6)) << x;
  }
  EXPECT_FALSE(driven_through(survey, 0.4, 2, 0.5));
  EXPECT_TRUE(driven_through(survey, 0.8, 2, 0.5));
}

// A robot that sends, and says where its receivers look: its own heading is unknown.
TEST(MovingEnds, HaveNoHeadingOfTheOtherEnd) {
  LinkReadings r;
  r.tx = {0, 0};
  r.rx = {1, 1};
  r.tx_at.resize(3, 2);
  r.tx_at << 0, 4, 0, 0, 0, 0;
  r.rx_at.resize(3, 2);
  r.rx_at << 2, 2, 2, 2, 0, 0;
  r.rx_yaw = {0.7, 0.7};
  const MovingEnds ends = moving_ends(r);
  EXPECT_FALSE(ends.headings_known());
  EXPECT_TRUE(std::isnan(ends.heading[0]) && std::isnan(ends.bearing[0]));
  r.tx_yaw = {0.2, -0.2};
  const MovingEnds known = moving_ends(r);
  EXPECT_TRUE(known.headings_known());
  EXPECT_EQ(known.heading, Eigen::Vector2d(0.2, -0.2));
  EXPECT_EQ(known.climb, 0);
  r.tx_at(2, 1) = 1.5;
  EXPECT_EQ(moving_ends(r).climb, 1.5);
  EXPECT_EQ(moving_ends(r).z, Eigen::Vector2d(0, 1.5));
  r.tx_yaw[1] = std::nan("");
  EXPECT_EQ(moving_ends(r).known_headings(), 0.5);
  EXPECT_TRUE(moving_ends(r).headings_known());
  EXPECT_NEAR(known.bearing[0], M_PI / 4 - 0.2, 1e-12);  // from the robot to the receiver
  EXPECT_NEAR(known.bearing[1], 3 * M_PI / 4 + 0.2, 1e-12);
}

}  // namespace
}  // namespace muster::diagnosis
