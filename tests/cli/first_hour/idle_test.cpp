// Attributes, plugins and way points that can have no effect: `check` and `run` tell them, and are silent beside them.
#include <gmock/gmock.h>

#include "tests/cli/errors/program.hpp"

using namespace muster::test;
using testing::HasSubstr;

namespace {

const std::string base = "<station name=\"base\" at=\"5 0 1\"/>", rover = "<robot name=\"rover\" at=\"0 0 0\"/>",
                  second = "<robot name=\"second\" at=\"0 3 0\"/>",
                  wall =
                      "<material name=\"brick\" loss=\"8\"/><wall name=\"north\" from=\"-5 1\" to=\"5 1\" "
                      "material=\"brick\"/>";
const std::string radio = base + rover + "<physics.simbody/><network.ideal/><control.beacon radio=\"base\"/>\n";

// What `check` prints of a world whose elements are in lines from 2 on, but its last line; a run says it as well.
std::string told(const std::string& elements, const ProgramFolder& folder = ProgramFolder()) {
  folder.write("world.xml", world_of("\n" + elements + "\n"));
  const auto outcome = folder.muster({"check", "world.xml"});
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  std::string result = outcome.out.substr(0, outcome.out.rfind("w: "));
  const Outcome run = folder.muster({"run", "world.xml"});
  for (std::size_t from = 0, to = 0; (to = result.find('\n', from)) != result.npos; from = to + 1)
    EXPECT_THAT(run.out + run.err, HasSubstr(result.substr(from, to - from)));
  return result;
}

TEST(Idle, AnAntennaIsNone) {
  const std::string channel = base + rover + "<physics.simbody/><radio.multiwall/>\n", network = "<network.ideal/>";
  const std::string beacon = "<control.beacon radio=\"base\"/>";
  EXPECT_EQ(told(channel + network + beacon + "<radio.antenna radio=\"base\"/>"), "");
  EXPECT_EQ(told(channel + network + beacon + "<radio.antenna pattern=\"cosine\" beamwidth=\"0.5\"/>"), "");
  EXPECT_EQ(told(channel + network + beacon + "<radio.antenna name=\"a\" radio=\"base\"/><radio.antenna name=\"b\"/>"),
            "");
  EXPECT_EQ(told(channel + "<radio.antenna radio=\"base\"/><record table=\"link/*/level\"/>"), "");
  EXPECT_EQ(told(channel + "<network.lrwpan/>" + beacon + "<radio.antenna radio=\"base\"/>"), "");
  EXPECT_THAT(told(channel + network + beacon + "<radio.pan id=\"1\" radios=\"base\"/>"), HasSubstr("does not read"));
}

TEST(Idle, AttributesThatAnotherSwitchesOff) {
  const auto of = [](const std::string& element, const std::string& more = "<radio.multiwall/>") {
    const std::string text = told(radio + more + "\n" + element), begin = "warning: world.xml:4:";
    return text.empty() ? text : text.substr(text.find(' ', begin.size()) + 1);
  };
  EXPECT_EQ(of("<radio.fading fading=\"false\" rician_k=\"6\"/>"),
            "attribute \"rician_k\": has no effect without fading=\"true\"; expected fading=\"true\" beside it, or no "
            "rician_k\n");
  EXPECT_EQ(of("<radio.fading rician_k=\"6\"/>"), "");
  EXPECT_EQ(of("<radio.fading shadowing=\"0\" decorrelation=\"3\"/>"),
            "attribute \"decorrelation\": has no effect without shadowing above 0; expected shadowing above 0 beside "
            "it, or no decorrelation\n");
  EXPECT_EQ(of("<radio.fading decorrelation=\"3\"/>"), "");
  EXPECT_EQ(of("<radio.multiwall model=\"perfect\" n=\"3\"/>", ""),
            "attribute \"n\": has no effect without model=\"multi_wall\" or \"log_distance\"; expected "
            "model=\"multi_wall\" or \"log_distance\" beside it, or no n\n");
  EXPECT_EQ(of("<radio.multiwall model=\"log_distance\" n=\"3\"/>", ""), "");
  EXPECT_EQ(of("<radio.antenna beamwidth=\"0.5\"/>"),
            "attribute \"beamwidth\": has no effect without pattern=\"cosine\" or \"sector\"; expected "
            "pattern=\"cosine\" or \"sector\" beside it, or no beamwidth\n");
  EXPECT_THAT(
      of("<radio.jammer radio=\"base\" period=\"0.1\"/>"),
      HasSubstr("attribute \"period\": has no effect without duty below 1; expected duty below 1 beside it, or no "
                "period\n"));
}

TEST(Idle, AttributesOfANetworkThatAnotherSwitchesOff) {
  const std::string channel = base + rover + "<physics.simbody/><radio.multiwall/><control.beacon radio=\"base\"/>\n";
  EXPECT_EQ(told(channel + "<network.lrwpan acknowledge=\"false\" retries=\"5\"/>"),
            "warning: world.xml:3:46: attribute \"retries\": has no effect without acknowledge=\"true\"; expected "
            "acknowledge=\"true\" beside it, or no retries\n");
  EXPECT_EQ(told(channel + "<network.lrwpan coordinator=\"base\"/>"),
            "warning: world.xml:3:30: attribute \"coordinator\": has no effect without beacon_order below 15; expected "
            "beacon_order below 15 beside it, or no coordinator\n");
  EXPECT_EQ(told(channel + "<network.lrwpan coordinator=\"base\" beacon_order=\"6\"/>"), "");
}

TEST(Idle, WavesAndBodiesWithoutWhatTheyAreOf) {
  EXPECT_EQ(told(radio + "<radio.multiwall/><radio.images/>"),
            "warning: world.xml:3:19: radio.images is of walls that reflect, and the world has none, so that it has no "
            "effect; expected a <wall>, or no <radio.images>\n");
  EXPECT_EQ(told(wall + radio + "<radio.multiwall/><radio.images/>"), "");
  EXPECT_EQ(told(radio + "<radio.multiwall/><radio.bodies/>"),
            "warning: world.xml:3:19: radio.bodies is of robots between two others, and the world has two radios, so "
            "that it has no effect; expected a third radio or robot, or no <radio.bodies>\n");
  EXPECT_EQ(told(second + radio + "<radio.multiwall/><radio.bodies/>"), "");
  EXPECT_EQ(told(wall + radio + "<radio.multiwall model=\"log_distance\"/>"),
            "note: world.xml:3:1: model=\"log_distance\" counts no walls, so that the world's (1) cost links nothing; "
            "model=\"multi_wall\" counts them\n");
}

TEST(Idle, SensorsWithoutWhatTheyMeasure) {
  const std::string alone = rover + "<physics.simbody/>\n";
  EXPECT_EQ(told(alone + "<sensors.range/>"),
            "warning: world.xml:3:1: sensors.range measures to stations, and the world has none, so that "
            "range/*/message stays empty; expected a <station>\n");
  EXPECT_EQ(told(second + alone + "<sensors.range to=\"robots\"/>"), "");
  EXPECT_EQ(told(base + alone + "<sensors.range/>"), "");
  EXPECT_EQ(told(alone + "<sensors.laser noise=\"10\"/>"),
            "warning: world.xml:3:1: attribute \"noise\": 10 m is more than the laser's "
            "range of 4 m; are these millimetres? 10 mm are 0.01 m\n");
  EXPECT_EQ(told(alone + "<sensors.laser noise=\"0.01\"/>"), "");
  EXPECT_THAT(told(alone + "<sensors.gps robot=\"rover\"/>"),
              testing::StartsWith("note: world.xml:3:1: sensors.gps has neither latitude nor longitude"));
  EXPECT_EQ(told(alone + "<sensors.gps latitude=\"48\" longitude=\"11\"/>"), "");
}

TEST(Idle, WhatBeginsAfterTheEnd) {
  EXPECT_EQ(
      told(radio + "<radio.multiwall/><effect.step at=\"60\" size=\"-5\"/>"),
      "warning: world.xml:3:36: attribute \"at\": 60 s, and the run ends at 1 s, so that <effect.step> never acts; "
      "expected a time below 1 s, or a longer run (until)\n");
  EXPECT_EQ(told(base + "<radio.multiwall/><effect.step at=\"60\" size=\"-5\"/>"), "") << "a world of measured data";
  EXPECT_EQ(told(radio + "<radio.multiwall/><effect.step at=\"0.5\" size=\"-5\"/>"), "");
}

TEST(Idle, ASecondRecordOfATable) {
  const std::string one = "<record table=\"robot/rover/pose\"/>",
                    other = "<record table=\"robot/rover/pose\" every=\"5\"/>";
  EXPECT_EQ(
      told(rover + "<physics.simbody/>\n" + one + "\n" + other),
      "warning: world.xml:4:1: <record> of \"robot/rover/pose\" stands twice, and the first (world.xml:3:1) alone "
      "is written, every 1 tick; expected one of the two\n");
  EXPECT_EQ(told(rover + "<physics.simbody/>\n" + one + "\n<record table=\"robot/rover/twist\"/>"), "");
}

TEST(Idle, WayPointsThatAreNoWay) {
  const auto way = [](const std::string& points, const std::string& physics = "simbody", const std::string& more = "") {
    const ProgramFolder folder;
    folder.write("way.csv", "x[m],y[m]\n" + points);
    return told(
        wall + rover + "<physics." + physics + "/>\n<control.waypoint robot=\"rover\" path=\"way.csv\"" + more + "/>",
        folder);
  };
  EXPECT_EQ(way("6000,-2000\n6000,-3000\n"),
            "warning: way.csv:2:1: a way point 6325 m away, where no robot comes in the run of 1 s; are these "
            "millimetres?\n");
  EXPECT_EQ(
      way("0,-1\n0,-2\n", "simbody", " tolerance=\"5\""),
      "warning: world.xml:3:59: attribute \"tolerance\": 5 m is more than the way to each way point, at most 2 m, "
      "so that all count as reached at the start; is this centimetres? 5 cm are 0.05 m\n");
  EXPECT_EQ(
      way("0,-1\n0,2\n"),
      "warning: way.csv:3:1: the way to this way point leads through wall \"north\" (world.xml:2:34), which stops "
      "the robot; expected way points around it, or <control.navigate>, which finds a way\n");
  EXPECT_EQ(
      way("47.3977,-8.5456\n47.3978,-8.5455\n47.3979,-8.5452\n"),
      "warning: way.csv:2:1: all 3 way points lie within 0.001 m, and 48 m from the start; are these latitude and "
      "longitude? expected metres of the plan: 0.00001 degrees of latitude are 1.1 m to the north\n");
  EXPECT_THAT(way("0,2\n", "planar through_walls=\"true\""), testing::Not(HasSubstr("way point")));
  EXPECT_EQ(way("0,-1\n7,-1\n7,2\n"), "");
}

TEST(Idle, AConditionWithoutAColumn) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of(radio + "<radio.multiwall/>\n<at when=\"link/base/rover/rssi below -60\">"
                                             "<set path=\"radio.multiwall/n\" value=\"3\"/></at>"));
  expect_error(folder.muster({"check", "world.xml"}), 2,
               "world.xml:3:11: \"link/base/rover/rssi\" names a table and no column of it; expected "
               "\"link/base/rover/rssi/rssi\"");
}

TEST(Idle, AWordForAllInThePlaceOfARow) {
  const ProgramFolder folder;
  const auto refused = [&](const std::string& to) {
    folder.write("world.xml", world_of(base + rover + "<physics.simbody/><radio.multiwall/><network.ideal/>\n" +
                                       "<control.beacon radio=\"base\" to=\"" + to + "\"/>"));
    return folder.muster({"check", "world.xml"}).err;
  };
  const std::string begin = "muster: error: world.xml:2:34: no radio is called ",
                    known = "; expected one of base, rover";
  EXPECT_EQ(refused("all"),
            begin + "\"all\"" + known + "; for that, leave \"to\" out (whom it speaks to; by default all)\n");
  EXPECT_THAT(refused("qqqqqqqq"), testing::Not(HasSubstr("leave")));
}

TEST(Idle, OfTwoShadowingsTheOneBesideFadingIsTakenOut) {
  const std::string warning = told(radio + "<radio.multiwall/><radio.fading/><radio.gudmundson shadowing=\"4\"/>");
  EXPECT_THAT(warning,
              HasSubstr("both add shadowing to link/*/level, which then counts twice; expected shadowing=\"0\" "
                        "of radio.fading, or no radio.gudmundson\n"));
}

TEST(Idle, ARoadmapOfARadiusInMillimetres) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of(wall + rover));
  const auto given = [&](const std::string& radius) {
    return folder.muster({"roadmap", "world.xml", "--out", "r.csv", "--radius", radius});
  };
  expect_error(given("152"), 2,
               "--radius: 152 m, with which no robot of the world has room where it stands; is this in millimetres? "
               "expected --radius 0.152");
  EXPECT_THAT(given("0.152").out, testing::StartsWith("w: "));
}

TEST(Idle, BlanksAroundAnEqualsSign) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of(radio + "<radio.multiwall/>"));
  expect_error(folder.muster({"run", "world.xml", "--set", "radio.multiwall/n = 2.4"}), 2,
               "--set \"radio.multiwall/n = 2.4\" has blanks around '='; expected --set radio.multiwall/n=2.4");
  EXPECT_THAT(folder.muster({"map", "world.xml", "--out", "m", "--cells", "0.1"}).err,
              HasSubstr("expected an integer from 2 to 2000: cells along the longer side"));
}

}  // namespace
