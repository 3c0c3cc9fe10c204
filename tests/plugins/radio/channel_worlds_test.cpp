// The channel in running worlds: reciprocity, independence of order, walls and doors, expectations, the receiver's
// floor.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "world_of.hpp"

namespace muster {
namespace {

const std::string plan =
    "<material name=\"brick\" loss=\"7.5\"/><material name=\"wood\" loss=\"2.25\"/>\n"
    "<wall name=\"w\" from=\"5 -20\" to=\"5 20\" height=\"3\" material=\"brick\"/>\n"
    "<door name=\"d\" wall=\"w\" at=\"19\" width=\"2\" height=\"2\" material=\"wood\" state=\"closed\"/>\n";
const std::string quiet = "<radio.receiver sensitivity=\"-250\"/>\n";

const std::vector<std::string> links_of_level = {"link/*/level",  "link/*/level@radio.multiwall.distance",
                                                 "link/*/fading", "link/*/level@radio.multiwall.walls",
                                                 "link/*/rssi",   "link/*/level@radio.fading.shadowing"};

std::string stations() {
  return station("a", "0 0 1") + station("b", "10 0.5 1") + station("c", "12 7 2.5") + station("d", "-3.3 8.1 0.2") +
         station("e", "9.7 -6 6");
}

// Row 30 of the requirements, as are the laws of shadowing and fading.
TEST(Channel, IsTheSameBothWaysBitForBit) {
  for (const char* fading : {"<radio.fading rician_k=\"3\"/>", "<radio.fading per_reading=\"true\"/>"}) {
    const Folder folder;
    Simulation world = world_of(folder, plan + stations() + "<radio.multiwall/>" + fading + quiet);
    run(world, 2);
    for (const auto& table : links_of_level) {
      const auto values = by_pair(world, table);
      ASSERT_EQ(values.size(), 20u);
      for (const auto& [pair, value] : values) {
        EXPECT_TRUE(same_bits(value, values.at({pair.second, pair.first}))) << table;
      }
    }
  }
}

TEST(Channel, DoesNotDependOnTheOrderOfRows) {
  const std::string turned = station("d", "-3.3 8.1 0.2") + station("e", "9.7 -6 6") + station("b", "10 0.5 1") +
                             station("a", "0 0 1") + station("c", "12 7 2.5");
  for (const char* fading : {"<radio.fading rician_k=\"3\"/>", "<radio.fading per_reading=\"true\"/>"}) {
    const Folder folder;
    Simulation one = world_of(folder, plan + stations() + "<radio.multiwall/>" + fading + quiet);
    Simulation other = world_of(folder, quiet + fading + "<radio.multiwall/>" + plan + turned, 2);
    run(one, 3);
    run(other, 3);
    for (const auto& table : links_of_level) {
      if (table == "link/*/level" || table == "link/*/rssi") continue;  // sums in the world file's order
      expect_same_bits(by_pair(one, table), by_pair(other, table));
    }
  }
}

TEST(Channel, IsDistanceAndWallsInClosedForm) {
  const Folder folder;
  Simulation world =
      world_of(folder, plan + station("a", "0 0 1") + station("b", "10 0 1") + station("under", "10 9 1") +
                           station("over", "10 0 9") +
                           "<radio.multiwall tx_power=\"3\" l0=\"40\" n=\"2.5\"/><test.porter at=\"2\"/>" + quiet);
  const auto far = [](double d) { return 3 - 40 - 25 * std::log10(d); };
  world.step();
  auto rssi = by_pair(world, "link/*/rssi");
  EXPECT_NEAR((rssi[{"a", "b"}]), far(10) - 2.25, 1e-12);                 // the closed door
  EXPECT_NEAR((rssi[{"a", "under"}]), far(std::sqrt(181)) - 7.5, 1e-12);  // the wall
  EXPECT_NEAR((rssi[{"a", "over"}]), far(std::sqrt(164)), 1e-12);         // at x = 5 it is 5 m high: over the wall
  world.step();
  rssi = by_pair(world, "link/*/rssi");
  EXPECT_NEAR((rssi[{"a", "b"}]), far(10), 1e-12);
  EXPECT_NEAR((rssi[{"a", "under"}]), far(std::sqrt(181)) - 7.5, 1e-12);
}

TEST(Channel, FollowsItsParametersAndNothingElse) {
  const Folder folder;
  const std::string rest = plan + stations() + quiet;
  Simulation world = world_of(folder, rest + "<radio.multiwall/>");
  world.step();
  world.set_parameter("radio.multiwall/n", 3.5);
  world.set_parameter("material/brick/loss", 4.125);
  world.step();
  world.evaluate(MUSTER_RADIO, false);
  const auto moved = by_pair(world, "link/*/rssi");
  Simulation fresh = world_of(folder, rest + "<radio.multiwall n=\"3.5\"/>");
  fresh.set_parameter("material/brick/loss", 4.125);
  run(fresh, 2);
  expect_same_bits(moved, by_pair(fresh, "link/*/rssi"));
}

TEST(Channel, ExpectationsAreMeansOfDecibelsWithoutShadowingOrFloor) {
  const Folder folder;
  Simulation world =
      world_of(folder, plan + stations() + "<radio.multiwall/><radio.fading/><radio.receiver sensitivity=\"-60\"/>");
  world.step();
  const auto drawn = by_pair(world, "link/*/rssi");
  world.evaluate(MUSTER_RADIO, true);
  const auto distance = by_pair(world, "link/*/level@radio.multiwall.distance");
  const auto walls = by_pair(world, "link/*/level@radio.multiwall.walls");
  for (const auto& [pair, rssi] : by_pair(world, "link/*/rssi")) {
    EXPECT_NEAR(rssi, distance.at(pair) + walls.at(pair) - 2.50682, 1e-5);
  }
  world.evaluate(MUSTER_RADIO, false);
  expect_same_bits(by_pair(world, "link/*/rssi"), drawn);
}

TEST(Channel, WithoutFadingTheGainIsOne) {
  const Folder folder;
  Simulation world =
      world_of(folder, stations() + "<radio.multiwall/><radio.fading fading=\"false\" shadowing=\"0\"/>" + quiet);
  for (const bool expected : {false, true}) {
    world.evaluate(MUSTER_RADIO, expected);
    for (const auto& [pair, gain] : by_pair(world, "link/*/fading")) EXPECT_EQ(gain, 1);
    expect_same_bits(by_pair(world, "link/*/rssi"), by_pair(world, "link/*/level@radio.multiwall.distance"));
  }
}

TEST(Channel, ReceivesNothingBelowTheSensitivity) {
  const Folder folder;
  Simulation world = world_of(folder, stations() + "<radio.multiwall/><radio.receiver sensitivity=\"-60\"/>");
  world.step();
  const auto level = by_pair(world, "link/*/level");
  int heard = 0;
  for (const auto& [pair, rssi] : by_pair(world, "link/*/rssi")) {
    EXPECT_EQ(std::isnan(rssi), level.at(pair) < -60);
    heard += !std::isnan(rssi);
  }
  EXPECT_GT(heard, 0);
  EXPECT_LT(heard, 20);
}

// Row 24 of the requirements: the steps and the ends of a mode's rssi.
TEST(Channel, Row24ReportsRssiInStepsBetweenItsEnds) {
  const Folder folder;
  const std::string plain = stations() + "<radio.multiwall/><radio.fading/><radio.receiver sensitivity=\"-68\"/>";
  const std::string steps = "<radio.rssi_steps step=\"2\" least=\"-66\" most=\"-58\"/>";
  Simulation exact = world_of(folder, plain), world = world_of(folder, plain + steps);
  run(exact, 3), run(world, 3);
  std::set<double> seen;
  for (const auto& [pair, rssi] : by_pair(world, "link/*/rssi")) {
    const double before = by_pair(exact, "link/*/rssi").at(pair);
    EXPECT_EQ(std::isnan(rssi), std::isnan(before));
    if (std::isnan(rssi)) continue;
    EXPECT_EQ(std::fmod(rssi, 2), 0);
    EXPECT_LE(std::abs(rssi - std::clamp(before, -66.0, -58.0)), 1);
    seen.insert(rssi);
  }
  EXPECT_GE(seen.size(), 3u);
  EXPECT_EQ(*seen.begin(), -66);
  EXPECT_EQ(*seen.rbegin(), -58);
}

TEST(Channel, RefusesStepsWithoutRange) {
  const Folder folder;
  try {
    world_of(folder, stations() + "<radio.multiwall/>" + quiet + "<radio.rssi_steps least=\"3\" most=\"2\"/>");
    FAIL() << "not refused";
  } catch (const Error& refused) {
    EXPECT_THAT(
        refused.what(),
        testing::EndsWith("attribute \"least\": least=\"3\" is above most=\"2\"; expected least to be at most most"));
  }
}

TEST(Channel, OfAPlaceIsTheSameOnReturn) {
  const Folder folder;
  Simulation world =
      world_of(folder, plan + "<robot name=\"r\" at=\"1 0 0.2\"/><robot name=\"s\" at=\"1 1 0.2\"/><test.mover/>" +
                           station("base", "8 3 1") + "<radio.multiwall/><radio.fading rician_k=\"6\"/>" + quiet);
  std::vector<std::map<Pair, double>> rssi{{}};
  for (int i = 1; i <= 40; ++i) {
    world.step();
    rssi.push_back(by_pair(world, "link/*/rssi"));
  }
  for (std::size_t i = 1; i < 20; ++i) {
    expect_same_bits(rssi[i], rssi[20 - i == 0 ? 40 : i + 20]);  // a round later
    expect_same_bits(rssi[i], rssi[40 - i]);                     // on the way back
  }
  EXPECT_FALSE(same_bits((rssi[1][{"r", "base"}]), (rssi[2][{"r", "base"}])));
}

TEST(Channel, KeepsNothingThatItCannotComputeAgain) {
  const Folder folder;
  const std::string elements =
      plan + "<robot name=\"r\" at=\"1 0 0.2\"/><test.mover/>" + stations() + "<test.porter at=\"9\"/>" +
      "<radio.multiwall/><radio.fading rician_k=\"6\"/><network.ideal/><test.sender from=\"a\"/>";
  Simulation one = world_of(folder, elements), other = world_of(folder, elements, 3);
  const Snapshot start = other.snapshot();
  run(other, 25);
  other.restore(start);
  for (int i = 0; i < 20; ++i) {
    one.step();
    other.step();
    if (i == 6 || i == 13) {
      for (const auto& instance : other.instances()) other.remake(std::string(instance->name()));
    }
    ASSERT_EQ(one.digest(), other.digest()) << "tick " << one.tick();
  }
}

TEST(Links, ReachOnlyLivingRadiosWithinRange) {
  const Folder folder;
  Simulation world =
      world_of(folder, station("a", "0 0 0") + station("b", "3 4 0") + station("c", "3 4 0.1") +
                           "<radio.links range=\"5\"/><radio.multiwall/><test.leaver radio=\"b\" at=\"3\"/>" + quiet);
  world.step();
  const auto level = by_pair(world, "link/*/level");
  EXPECT_EQ(level.size(), 4u);  // a - b, b - c
  EXPECT_TRUE(level.count({"a", "b"}) && level.count({"c", "b"}));
  run(world, 3);
  EXPECT_TRUE(by_pair(world, "link/*/level").empty());
  EXPECT_EQ(world.table("endpoint/*/radio").rows(), 2u);
}

}  // namespace
}  // namespace muster
