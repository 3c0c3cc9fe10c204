// Measured readings as links: the terms of the channel are evaluated at the measured geometry by the same code.
#include "world_of.hpp"

namespace muster {
namespace {

const std::string plan =
    "<material name=\"brick\" loss=\"7.5\"/>"
    "<wall name=\"w\" from=\"5 -20\" to=\"5 20\" height=\"3\" material=\"brick\"/>\n";
const std::string channel = "<radio.multiwall/><radio.fading/><radio.receiver sensitivity=\"-250\"/>\n";

TEST(Data, ReadingsAreEvaluatedAsLivingLinksAre) {
  const Folder folder;
  Simulation living = world_of(folder, plan + station("a", "1 2 0.5") + station("b", "9 3.3 1.25") + channel);
  living.step();
  folder.put("measured.csv",
             "t[s],tx,rx,tx_x[m],tx_y[m],tx_z[m],tx_yaw[rad],rx_x[m],rx_y[m],rx_z[m],rx_yaw[rad],rssi[dBm],phone\n"
             "0.5,b,a,0,0,0,0,7,0,0,0,-61,x\n"
             "0.7,a,b,1,2,0.5,1.5,9,3.3,1.25,0,,y\n");
  Simulation measured =
      world_of(folder, plan + station("a", "0 0 0") + "<data.links file=\"measured.csv\"/>" + channel);
  measured.step();
  for (const char* table : {"link/*/level@radio.multiwall.distance", "link/*/level@radio.multiwall.walls",
                            "link/*/level@radio.fading.shadowing", "link/*/fading", "link/*/rssi"}) {
    ASSERT_EQ(measured.table(table).rows(), 2u);
    EXPECT_TRUE(same_bits(measured.table(table).at(1, 0), by_pair(living, table).at({"a", "b"}))) << table;
  }
  const TableView radios = measured.table("endpoint/*/radio");
  EXPECT_EQ(radios.at(0, 1), 0.5);
  EXPECT_EQ(radios.at(3, 1), 0.7);
  EXPECT_EQ(measured.board().find_set("radio")->names, (std::vector<std::string>{"a", "b"}));
}

TEST(Data, WithoutHeightReadingsAreAtTheHeightOfTheMount) {
  const Folder folder;
  folder.put("measured.csv", "tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm]\nbase,robot,0,0,3,4,-50\n");
  Simulation world = world_of(folder, station("base", "7 7 12") + "<data.links file=\"measured.csv\"/>" + channel);
  run(world, 3);
  EXPECT_EQ(world.table("endpoint/*/pose").at(0, 2), 12);
  EXPECT_EQ(world.table("endpoint/*/pose").at(1, 2), 0);
  EXPECT_EQ(world.table("endpoint/*/radio").at(0, 1), world.time());
  EXPECT_NEAR(world.table("link/*/level@radio.multiwall.distance").at(0, 0), -40 - 20 * std::log10(13.0), 1e-12);
}

TEST(Data, LinksMovedAsideKeepTheirLengthsAndBearings) {
  const Folder folder;
  folder.put("measured.csv", "tx,rx,tx_x[m],tx_y[m],tx_yaw[rad],rx_x[m],rx_y[m]\na,b,1,1,0.5,4,5\nb,a,2,2,0,2,2\n");
  Simulation world = world_of(folder, "<data.links file=\"measured.csv\" aside=\"0.5\"/>" + channel);
  world.step();
  const TableView pose = world.table("endpoint/*/pose");
  const double from[] = {1 - 0.4, 1 + 0.3}, to[] = {4 - 0.4, 5 + 0.3};  // to the left of (3, 4)
  for (std::size_t axis : {0, 1}) {
    EXPECT_NEAR(pose.at(0, axis), from[axis], 1e-12);
    EXPECT_NEAR(pose.at(1, axis), to[axis], 1e-12);
    EXPECT_EQ(pose.at(2, axis), 2);  // ends in one place have no left
  }
  EXPECT_DOUBLE_EQ(pose.at(0, 3), std::cos(0.25));
}

TEST(Data, LinksMovedAlongKeepTheirLengthsAndBearings) {
  const Folder folder;
  folder.put("measured.csv", "tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m]\na,b,1,1,4,5\nb,a,2,2,2,2\n");
  Simulation world = world_of(folder, "<data.links file=\"measured.csv\" along=\"-0.5\"/>" + channel);
  world.step();
  const TableView pose = world.table("endpoint/*/pose");
  const double from[] = {1 - 0.3, 1 - 0.4}, to[] = {4 - 0.3, 5 - 0.4};
  for (std::size_t axis : {0, 1}) {
    EXPECT_NEAR(pose.at(0, axis), from[axis], 1e-12);
    EXPECT_NEAR(pose.at(1, axis), to[axis], 1e-12);
    EXPECT_EQ(pose.at(2, axis), 2);  // ends in one place have no way
  }
}

TEST(Data, ReadingsOfOnePairHaveFadingOfTheirOwn) {
  const Folder folder;
  folder.put("measured.csv",
             "t[s],tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m]\n0,a,b,0,0,3,4\n1,a,b,0,0,3,4\n1,b,a,3,4,0,0\n");
  Simulation world = world_of(folder,
                              "<data.links file=\"measured.csv\"/><radio.multiwall/>"
                              "<radio.fading per_reading=\"true\"/><radio.receiver sensitivity=\"-250\"/>");
  world.step();
  const TableView gain = world.table("link/*/fading");
  EXPECT_NE(gain.at(0, 0), gain.at(1, 0));
  EXPECT_EQ(gain.at(1, 0), gain.at(2, 0));
  const double first = gain.at(0, 0);
  world.step();
  EXPECT_EQ(world.table("link/*/fading").at(0, 0), first);  // the reading's time, not the tick's
}

}  // namespace
}  // namespace muster
