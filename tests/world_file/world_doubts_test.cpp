// What a world's elements say of one another: each doubt with its place, and none of what is sound.
#include "world_text.hpp"

namespace muster {
namespace {

class WorldDoubts : public WorldText {
 protected:
  std::string doubts(const World& world) const {
    std::string all;
    for (const auto& warning : world.warnings) all += warning.place.text() + ": " + warning.message + '\n';
    return temporary.inside(all);
  }
  std::string doubts_with(const std::string& elements) const { return doubts(read_with(elements)); }
};

const std::string wall = "<material name='m' loss='3'/><wall name='a' from='0 0' to='4 0' material='m'/>\n";

TEST_F(WorldDoubts, AWallThatStandsTwice) {
  EXPECT_EQ(doubts_with(wall + "<wall name='b' from='4 0' to='0 0' material='m'/>"),
            "world.xml:3:1: wall \"b\" has the ends of wall \"a\" (world.xml:2:30), so that links pay for both; "
            "expected one of the two\n");
  EXPECT_EQ(doubts_with(wall + "<wall name='b' from='4 0' to='0 1' material='m'/>"), "");
  EXPECT_EQ(doubts_with(wall + "<wall name='b' from='0 0' to='4 0' base='2.7' material='m'/>"), "");
}

TEST_F(WorldDoubts, HeightsThatDoNotFit) {
  EXPECT_EQ(doubts_with(wall + "<door wall='a' at='1' height='3'/>"),
            "world.xml:3:31: attribute \"height\": the door is 3 m high in a wall of 2.7 m; expected at most that\n");
  EXPECT_EQ(doubts_with(wall + "<door wall='a' at='1' height='2'/>"), "");
  EXPECT_EQ(doubts_with(wall + "<station at='0 1 120'/>"),
            "world.xml:3:14: attribute \"at\": 120 m up, beside walls of 2.7 m; is this centimetres?\n");
  EXPECT_EQ(doubts_with(wall + "<station at='0 1 30'/>"), "");
  EXPECT_EQ(doubts_with("<robot at='0 0 0' antenna='0 0 -0.3'/>"),
            "world.xml:2:28: attribute \"antenna\": it is 0.3 m below the ground\n");
  EXPECT_EQ(doubts_with("<robot at='0 0 1' antenna='0 0 -0.3'/>"), "");
  EXPECT_EQ(error_with("<material name='m' loss='3'/><floor corners='0 0 1 0 1 1 0 1' z='2700' material='m'/>"),
            "world.xml:2:66: attribute \"z\": 2700 m is beyond the scene; expected a height within 1000 m; is this "
            "millimetres?");
}

TEST_F(WorldDoubts, WhatStandsBelowTheGround) {
  const std::string ned = " m below the ground (z = 0); is z down here, as in PX4 (NED)? expected metres up: ";
  EXPECT_EQ(doubts_with(wall + "<station name='s' at='2 1 -1.5'/>"),
            "world.xml:3:23: attribute \"at\": station \"s\" is 1.5" + ned + "at=\"2 1 1.5\"\n");
  EXPECT_EQ(doubts_with(wall + "<at t='1'><station at='2 1 -1.5'/></at>"),
            "world.xml:3:24: attribute \"at\": station is 1.5" + ned + "at=\"2 1 1.5\"\n");
  EXPECT_EQ(doubts_with(wall + "<floor corners='0 0 1 0 1 1 0 1' z='-2.7' material='m'/>"),
            "world.xml:3:37: attribute \"z\": floor is 2.7" + ned + "z=\"2.7\"\n");
  EXPECT_EQ(doubts_with("<material name='m' loss='3'/><wall name='a' from='0 0' to='4 0' base='-2.7' material='m'/>"),
            "world.xml:2:30: wall \"a\" stands from -2.7 to 0 m, as all walls do, below the ground (z = 0); is z down "
            "here, as in PX4 (NED)? expected metres up: base=\"0\"\n");
  // A cellar, the slab under a floor, and a valley are sound.
  const std::string cellar = "<wall name='c' from='0 0' to='4 0' base='-3' height='3' material='m'/>";
  EXPECT_EQ(
      doubts_with(wall + cellar + "<station at='2 1 -1.5'/><floor corners='0 0 1 0 1 1 0 1' z='-3' material='m'/>"),
      "");
  EXPECT_THAT(doubts_with(wall + cellar + "<station at='2 1 -4'/>"), testing::HasSubstr("station is 4" + ned));
  EXPECT_EQ(doubts_with(wall + "<floor corners='0 0 1 0 1 1 0 1' z='-0.2' material='m'/><station at='2 1 0'/>"), "");
  EXPECT_EQ(doubts_with(wall + "<mesh file='valley.stl' kind='sheet' material='m'/><station at='2 1 -1.5'/>"), "");
}

TEST_F(WorldDoubts, TicksInWhichNobodyCanSteer) {
  const auto dt = [&](const std::string& attribute, const std::string& plugin) {
    return doubts(read("<world dt='" + attribute + "' until='100'>" + plugin + "</world>"));
  };
  EXPECT_EQ(dt("20", "<control.steady robot='a'/>"),
            "world.xml:1:12: attribute \"dt\": robots are steered once in 20 s; expected some 0.01 to 0.1 s; are these "
            "milliseconds?\n");
  EXPECT_EQ(dt("20", "<control.beacon radio='a'/>"), "");
  EXPECT_EQ(dt("1", "<control.steady robot='a'/>"), "");
}

}  // namespace
}  // namespace muster
