// Expected readings: of links that pass closely by the end of a wall, and of radios whose heading no reading states.
#include "diagnosis/radio/links/link_model.hpp"

#include <gtest/gtest.h>

#include "tests/diagnosis/scratch.hpp"
#include "tests/diagnosis/worlds.hpp"

namespace muster::diagnosis {
namespace {

TEST(LinkModel, ListsLinksThatPassCloseToTheEndOfAWall) {
  const Scratch scratch;
  const auto world =
      scratch.write("world.xml",
                    "<world name=\"w\" dt=\"1\" until=\"1\" seed=\"1\">\n  <material name=\"brick\" loss=\"7.5\"/>\n"
                    "  <wall name=\"w\" from=\"5 0\" to=\"5 10\" height=\"3\" material=\"brick\"/>\n"
                    "  <station name=\"a\" at=\"0 0 0.5\"/>\n  <radio.multiwall/>\n</world>\n");
  std::string table = "tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm]\n";
  for (const char* y : {"5", "0.003", "0.03", "-0.003", "-0.03"})
    table += std::string("a,b,0,") + y + ",10," + y + ",-60\nb,a,10," + y + ",0," + y + ",-60\n";
  LinkModel model(world, scratch.write("readings.csv", table), plugins);
  const Eigen::VectorXd before = model.expected();
  EXPECT_NEAR(before[8] - before[0], 7.5, 1e-12);
  Eigen::VectorXd wanted(10);
  wanted << 0, 0, 7.5, 7.5, 0, 0, 7.5, 7.5, 0, 0;
  EXPECT_TRUE(model.changes_nearby(0.005).isApprox(wanted, 1e-9)) << model.changes_nearby(0.005).transpose();
  EXPECT_EQ(model.expected(), before);  // links keep their places
}

// A receiver a centimetre before a wall may as well stand behind it.
TEST(LinkModel, ListsLinksThatEndCloseToAWall) {
  const Scratch scratch;
  const auto world =
      scratch.write("world.xml",
                    "<world name=\"w\" dt=\"1\" until=\"1\" seed=\"1\">\n  <material name=\"brick\" loss=\"7.5\"/>\n"
                    "  <wall name=\"w\" from=\"5 -9\" to=\"5 9\" height=\"3\" material=\"brick\"/>\n"
                    "  <station name=\"a\" at=\"0 0 0.5\"/>\n  <radio.multiwall/>\n</world>\n");
  std::string table = "tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm]\n";
  for (const char* x : {"4.9", "4.99", "5.01", "5.1"}) table += std::string("a,b,0,0,") + x + ",0,-60\n";
  LinkModel model(world, scratch.write("readings.csv", table), plugins);
  const Eigen::Vector4d wanted(0, 7.5, 7.5, 0);
  EXPECT_TRUE(model.changes_nearby(0.02).isApprox(wanted, 1e-9)) << model.changes_nearby(0.02).transpose();
}

// A table without headings leaves a station at that which the world gives it: its sector looks north.
TEST(LinkModel, TakesTheHeadingOfAStationFromTheWorld) {
  const Scratch scratch;
  const auto world =
      scratch.write("world.xml",
                    "<world name=\"w\" dt=\"1\" until=\"1\" seed=\"1\">\n"
                    "  <station name=\"a\" at=\"0 0 1\" yaw=\"1.5707963\"/>\n  <radio.multiwall/>\n"
                    "  <effect.sector_antenna radio=\"a\" front_to_back=\"20\" edge=\"0.8\"/>\n</world>\n");
  const std::string places = "a,b,0,0,0,10", to_the_east = "a,b,0,0,10,0";
  const auto level = [&](const std::string& heading, const std::string& column) {
    LinkModel model(world,
                    scratch.write("readings.csv", "tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m]" + column + ",rssi[dBm]\n" +
                                                      places + heading + ",-60\n" + to_the_east + heading + ",-60\n"),
                    plugins);
    return Eigen::Vector2d(model.expected());
  };
  const Eigen::Vector2d of_the_world = level("", ""), of_the_table = level(",0", ",tx_yaw[rad]");
  EXPECT_NEAR(of_the_world[0] - of_the_world[1], 20, 1e-6);
  EXPECT_NEAR(of_the_table[1] - of_the_table[0], 20, 1e-6);
}

}  // namespace
}  // namespace muster::diagnosis
