// Maps and budgets against the closed form of a world with two walls and a door.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/cli/errors/program.hpp"
#include "text/text_table.hpp"

namespace muster::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

// A wall of 6 dB at x = 2, one of 3 dB at x = 4 with a door on the axis. Nothing below -70 dBm is received.
const std::string walls =
    "<material name=\"brick\" loss=\"6\"/> <material name=\"wood\" loss=\"3\"/>"
    "<wall name=\"outer\" from=\"4 -5\" to=\"4 5\" material=\"wood\"/>"
    "<wall name=\"inner\" from=\"2 -5\" to=\"2 5\" material=\"brick\"/>";
const std::string radios =
    "<station name=\"a\" at=\"0 0 1\"/> <station name=\"b\" at=\"6 0 1\"/> <station name=\"far\" at=\"900 0 1\"/>"
    "<radio.links range=\"800\"/> <radio.multiwall tx_power=\"-2\" l0=\"40\" n=\"2\"/>"
    "<radio.receiver sensitivity=\"-70\"/>";

double level(double distance, double loss) { return -42 - 20 * std::log10(distance) - loss; }

json probed(const ProgramFolder& folder, std::vector<std::string> words) {
  words.insert(words.begin(), {"probe", "world.xml"});
  words.push_back("--json");
  const Outcome outcome = folder.muster(words);
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  return json::parse(outcome.out);
}

double value_of(const json& budget, const std::string& quantity) {
  for (const auto& line : budget["lines"])
    if (line["quantity"] == quantity) return line["value"].get<double>();
  ADD_FAILURE() << "no " << quantity;
  return 0;
}

TEST(Budget, NamesWallsInTheOrderInWhichTheyAreMetAndSumsTheTerms) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of(walls + radios));
  const json there = probed(folder, {"a", "b"});
  std::vector<std::string> names;
  for (const auto& wall : there["walls"]) names.push_back(wall["wall"]);
  EXPECT_THAT(names, ElementsAre("inner", "outer"));
  EXPECT_NEAR(there["walls"][0]["at_m"].get<double>(), 2, 1e-9);
  EXPECT_EQ(there["walls"][0]["loss_db"], 6);
  EXPECT_NEAR(there["walls"][0]["incidence_rad"].get<double>(), 0, 1e-9);
  EXPECT_NEAR(value_of(there, "level@distance"), level(6, 0), 1e-9);
  EXPECT_NEAR(value_of(there, "level@walls"), -9, 1e-9);
  EXPECT_NEAR(value_of(there, "level"), level(6, 9), 1e-9);
  EXPECT_THAT(there["outcome"].get<std::string>(), HasSubstr("received at -66.56 dBm"));
  const json back = probed(folder, {"b", "a"});
  EXPECT_EQ(back["walls"][0]["wall"], "outer");
  EXPECT_EQ(value_of(back, "level"), value_of(there, "level"));
}

TEST(Budget, NamesFloorsAmongWallsAndSumsThem) {
  const ProgramFolder folder;
  const std::string floor =
      "<floor name=\"first\" corners=\"0 -5 6 -5 6 5 0 5\" z=\"2\" material=\"brick\"/>"
      "<station name=\"above\" at=\"6 0 3\"/>";
  folder.write("world.xml", world_of(walls + floor + radios));
  const json budget = probed(folder, {"a", "above"});
  std::vector<std::string> names;
  for (const auto& each : budget["walls"]) names.push_back(each.value(each.contains("floor") ? "floor" : "wall", ""));
  EXPECT_THAT(names, ElementsAre("inner", "first", "outer"));
  const double length = std::sqrt(40);
  EXPECT_NEAR(budget["walls"][1]["at_m"].get<double>(), length / 2, 1e-9);
  EXPECT_NEAR(std::cos(budget["walls"][1]["incidence_rad"].get<double>()), 2 / length, 1e-9);
  EXPECT_NEAR(value_of(budget, "level@walls"), -15, 1e-9);
  EXPECT_NEAR(value_of(budget, "level"), level(length, 15), 1e-9);
  EXPECT_THAT(folder.muster({"probe", "world.xml", "a", "above"}).out, HasSubstr("floor first (brick, 6.00 dB)"));
  EXPECT_EQ(probed(folder, {"a", "b"})["walls"].size(), 2u);  // below it
}

TEST(Budget, AClosedDoorStandsInItsWallAndAnOpenOneDoesNot) {
  const ProgramFolder folder;
  for (const std::string state : {"open", "closed"}) {
    folder.write("world.xml", world_of(walls + "<door name=\"d\" wall=\"outer\" at=\"4\" width=\"2\" state=\"" + state +
                                       "\"/>" + radios));
    const json budget = probed(folder, {"a", "b"});
    EXPECT_EQ(budget["walls"].size(), state == "open" ? 1u : 2u);
    if (state == "closed") {
      EXPECT_EQ(budget["walls"][1]["door"], "d");
    }
  }
}

TEST(Budget, SaysWhyNothingIsReceived) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of(walls + radios));
  EXPECT_EQ(probed(folder, {"a", "far"})["outcome"], "no link: radio.links lists none beyond 800 m");
  folder.write("world.xml", world_of(walls + "<station name=\"deaf\" at=\"60 0 1\"/>" + radios));
  EXPECT_EQ(probed(folder, {"a", "deaf"})["outcome"],
            "nothing is received: radio.receiver lets nothing so weak through");
}

TEST(Budget, RefusesRadiosThatAreNotThere) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of(walls + radios));
  expect_error(folder.muster({"probe", "world.xml", "a", "fat"}), 2,
               "no radio of world.xml is called \"fat\"; expected one of a, b, far; did you mean \"far\"?");
  expect_error(folder.muster({"probe", "world.xml", "a", "a"}), 2,
               "a radio does not hear itself; expected two radios, not \"a\"");
  folder.write("silent.xml", world_of(walls));
  expect_error(folder.muster({"probe", "silent.xml", "a", "b"}), 2,
               "silent.xml: the world has no radio channel; expected one, such as <radio.multiwall/>");
}

TEST(RssiMap, IsTheChannelAtTheMiddleOfEachCell) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of(walls + radios));
  const Outcome outcome = folder.muster({"map", "world.xml", "--from", "a", "--area", "0.5", "-2", "8.5", "2",
                                         "--cells", "16", "--out", "map", "--json"});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_EQ(json::parse(outcome.out)["cells"], json({16, 8}));
  const TextTable table = TextTable::read(folder.path() / "map/map.csv");
  ASSERT_EQ(table.rows(), 16u * 8u);
  const auto x = table.reals(table.require("x", "m")), y = table.reals(table.require("y", "m")),
             rssi = table.reals(table.require("a", "dBm"));
  for (std::size_t i = 0; i < x.size(); ++i)
    EXPECT_NEAR(rssi[i], level(std::hypot(x[i], y[i]), (x[i] > 2 ? 6 : 0) + (x[i] > 4 ? 3 : 0)), 1e-9);
  const std::string image = folder.read("map/map_a.png");
  EXPECT_EQ(image.substr(1, 3), "PNG");
  EXPECT_THAT(folder.read("map/map_a.svg"), HasSubstr("RSSI expected on average"));
}

TEST(RssiMap, WhatIsNotReceivedIsEmpty) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of(walls + radios));
  const Outcome outcome = folder.muster(
      {"map", "world.xml", "--from", "a", "--area", "1", "-1", "101", "1", "--cells", "50", "--drawn", "--out", "map"});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  const TextTable table = TextTable::read(folder.path() / "map/map.csv");
  const auto x = table.reals(table.require("x", "m")), rssi = table.reals(table.require("a", "dBm"), {.empty = true});
  for (std::size_t i = 0; i < x.size(); ++i)
    EXPECT_EQ(std::isnan(rssi[i]), level(x[i], (x[i] > 2 ? 6 : 0) + (x[i] > 4 ? 3 : 0)) < -70) << x[i];
}

// Two columns of one name are refused by whoever reads the table.
TEST(RssiMap, OfARadioCalledAsAPlaceIsHasAColumnOfItsOwn) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of("<station name=\"x\" at=\"0 0 1\"/><radio.multiwall/>"));
  const Outcome outcome = folder.muster({"map", "world.xml", "--cells", "4", "--out", "map"});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  const TextTable table = TextTable::read(folder.path() / "map/map.csv");
  EXPECT_LT(table.reals(table.require("rssi_x", "dBm"))[0], 0);
}

// It was said to be received with 0 to 1 dBm.
TEST(RssiMap, OfARadioThatIsNowhereReceivedHasNoRange) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of(walls + radios));
  std::vector<std::string> words = {"map", "world.xml", "--from",  "a",  "--area",  "700",   "-1",
                                    "720", "1",         "--cells", "10", "--drawn", "--out", "map"};
  EXPECT_THAT(folder.muster(words).out, HasSubstr("  a                nothing received\n"));
  words.push_back("--json");
  const Outcome outcome = folder.muster(words);
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_EQ(json::parse(outcome.out)["radios"]["a"], json({{"lowest_dbm", nullptr}, {"highest_dbm", nullptr}}));
}

// A station that joins later sends nothing before.
TEST(RssiMap, IsOfTheStationsThatAreThere) {
  const ProgramFolder folder;
  folder.write("world.xml", "<world name=\"w\" dt=\"0.1\" until=\"5\">" + walls + radios +
                                "<at t=\"3\"><station name=\"late\" at=\"1 1 1\"/></at></world>");
  for (const auto& [at, number] : {std::pair("0", 3u), std::pair("4", 4u)}) {
    const Outcome outcome = folder.muster({"map", "world.xml", "--at", at, "--cells", "8", "--out", "map", "--json"});
    ASSERT_EQ(outcome.exit, 0) << outcome.err;
    EXPECT_EQ(json::parse(outcome.out)["radios"].size(), number) << at;
  }
}

TEST(RssiMap, RefusesWhatIsNoRadioAndNoArea) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of(walls + radios));
  expect_error(folder.muster({"map", "world.xml", "--from", "fat", "--out", "map"}), 2,
               "--from: no radio is called \"fat\"; expected one of a, b, far; did you mean \"far\"?");
  expect_error(
      folder.muster({"map", "world.xml", "--area", "1", "2", "1", "3", "--out", "map"}), 2,
      "--area: 1 2 1 3: X0 and X1 are both 1; expected X0 Y0 X1 Y1, two corners, X0 < X1 and Y0 < Y1; did you mean "
      "--area 1 1 2 3? (from its order X0 X1 Y0 Y1)");
}

// Levels below -80 dBm were cut off.
TEST(RunPictures, TheAxisOfRssiReachesTheWeakestLevel) {
  const ProgramFolder folder;
  folder.write("world.xml",
               world_of("<station name=\"a\" at=\"0 0 1\"/><station name=\"b\" at=\"900 0 1\"/>"
                        "<radio.multiwall tx_power=\"0\" l0=\"40\" n=\"2\"/><radio.receiver sensitivity=\"-120\"/>"
                        "<network.ideal/><control.beacon radio=\"a\"/><observe.chain chain=\"a b\"/>"));
  const Outcome outcome = folder.muster({"run", "world.xml", "--out", "out"});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_THAT(folder.read("out/rssi.svg"), HasSubstr("\u2212100"));  // it is -99.1 dBm
}

}  // namespace
}  // namespace muster::test
