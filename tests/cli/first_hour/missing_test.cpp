// Worlds that lack a part, or have one twice: the message names the part, as `check` and `run` both say it.
#include <gmock/gmock.h>

#include "tests/cli/errors/program.hpp"

using namespace muster::test;

namespace {

// The elements are in lines of their own, from line 2 on.
void expect_refused(const std::string& elements, const std::string& message) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of("\n" + elements + "\n"));
  for (const std::string verb : {"check", "run"}) {
    SCOPED_TRACE(verb);
    expect_error(folder.muster({verb, "world.xml"}), 2, message);
  }
}

const std::string rover = "<robot name=\"rover\" at=\"0 0 0\"/>\n";
const std::string base = "<station name=\"base\" at=\"5 0 1\"/>\n";
const std::string channel = "<radio.multiwall/>\n";
const std::string beacon = "<control.beacon radio=\"base\"/>\n";

TEST(FirstHour, ANetworkInWhichNobodySends) {
  expect_refused(base + channel + "<network.ideal/>",
                 "world.xml:4:1: network.ideal (network.ideal): reads \"outbox/*/message\", which nobody writes; "
                 "expected a plugin that does, such as <control.beacon radio=\"...\"/>");
}

// The receiver joined by itself: it has the place of what needs it.
TEST(FirstHour, ABeaconWithoutARadioModel) {
  expect_refused(base + "<network.ideal/>\n" + beacon,
                 "world.xml:3:1: radio.receiver (needed by network.ideal): reads \"link/*/level\", which nobody "
                 "writes; expected a plugin that does, such as <radio.multiwall/>");
  expect_refused(base + "<record table=\"link/*/rssi\"/>",
                 "world.xml:3:1: radio.receiver (needed by record): reads \"link/*/level\", which nobody writes; "
                 "expected a plugin that does, such as <radio.multiwall/>");
}

TEST(FirstHour, AStageBringsWhatItIsAStageOf) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of(base + channel + "<radio.rssi_steps/>"));
  const auto outcome = folder.muster({"check", "world.xml"});
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, testing::HasSubstr("nothing is wrong"));
  EXPECT_THAT(folder.muster({"graph", "world.xml"}).out, testing::HasSubstr("radio.receiver"));
}

TEST(FirstHour, AGoalThatNobodyGives) {
  expect_refused(rover + "<physics.planar/>\n<control.goal2d robot=\"rover\"/>",
                 "world.xml:4:1: control.goal2d (control.goal2d): reads \"robot/rover/goal2d\", which nobody writes; "
                 "expected a plugin that does, such as <control.mission robot=\"...\" mission=\"...\"/>");
}

TEST(FirstHour, TwoBackendsOfPhysics) {
  expect_refused(rover + "<physics.simbody/>\n<physics.planar/>",
                 "world.xml:4:1: physics.planar (physics.planar): writes \"robot/*/pose\"; so does world.xml:3:1: "
                 "physics.simbody (physics.simbody); expected one of the two: a world has one physics plugin, which "
                 "works for all");
}

// The steering of a car, beside a driver that needs none.
TEST(FirstHour, TheExecutorOfAProgramThatIsNotThere) {
  const std::string car = "<robot name=\"car\" model=\"f1tenth\" at=\"0 0 0\"/>\n<physics.simbody/>\n";
  const std::string steady = "<control.steady name=\"steer\" robot=\"car\" v=\"1\" w=\"0\"/>\n";
  const std::string other = "<control.car robot=\"car\" wheel_base=\"0.33\" max_steering=\"0.4\"/>\n";
  const std::string why =
      "; expected no control.car: it executes the \"robot/car/car_command\" of a program, which nobody writes here, "
      "and "
      "control.steady drives the robot by itself";
  expect_refused(car + steady + other,
                 "world.xml:5:1: control.car (control.car): writes \"robot/car/command\"; so does world.xml:4:1: steer "
                 "(control.steady)" +
                     why);
  expect_refused(car + other + steady,
                 "world.xml:5:1: steer (control.steady): writes \"robot/car/command\"; so does world.xml:4:1: "
                 "control.car (control.car)" +
                     why);
}

TEST(FirstHour, TwoNetworks) {
  expect_refused(base + channel + "<network.ideal/>\n<network.wifi/>\n" + beacon,
                 "world.xml:5:1: network.wifi (network.wifi): writes \"radio/*/traffic\"; so does world.xml:4:1: "
                 "network.ideal (network.ideal); expected one of the two: a world has one network plugin, which works "
                 "for all");
}

TEST(FirstHour, EightSlavesOfBluetooth) {
  std::string stations;
  for (int i = 0; i < 9; ++i)
    stations += "<station name=\"s" + std::to_string(i) + "\" at=\"" + std::to_string(i) + " 0 1\"/>";
  expect_refused(stations + "\n" + channel + "<network.bluetooth/>\n<control.beacon radio=\"s0\"/>",
                 "world.xml:4:1: network.bluetooth (network.bluetooth): 9 radios; a "
                 "piconet has one master and at most 7 slaves; expected 8 radios or fewer, or another network in its "
                 "place, such as <network.wifi/>; the radios are s0, s1, s2, s3, s4, s5, s6, s7, s8");
}

TEST(FirstHour, ATableByAnotherWord) {
  const auto expect_nearest = [](const std::string& table, const std::string& nearest) {
    const ProgramFolder folder;
    folder.write("world.xml", world_of("\n" + rover + "<physics.planar/>\n<control.steady robot=\"rover\" v=\"0\" " +
                                       "w=\"0\"/>\n<record table=\"" + table + "\"/>"));
    const auto outcome = folder.muster({"check", "world.xml"});
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_THAT(outcome.err, testing::StartsWith("muster: error: world.xml:5:1: record: there is no table \"" + table +
                                                 "\"; expected one of "));
    EXPECT_THAT(outcome.err, testing::EndsWith("; did you mean \"" + nearest + "\"?\n"));
  };
  expect_nearest("robot/rover/position", "robot/*/pose");
  expect_nearest("robot/*/velocity", "robot/*/twist");
  expect_nearest("robot/*/comand", "robot/*/command");
  expect_nearest("robot/*/odom", "robot/*/odometry");
}

TEST(FirstHour, AModelThatIsNotThereHasTheRobotsPlace) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of("\n<robot name=\"r\" model=\"scrab\" at=\"0 0 0\"/>\n<physics.planar/>"));
  const auto outcome = folder.muster({"check", "world.xml"});
  EXPECT_THAT(outcome.err, testing::StartsWith(
                               "muster: error: world.xml:2:24: attribute \"model\": there is no model \"scrab\"; did "
                               "you mean 'scarab'? expected one of crate, f1tenth, "));
}

}  // namespace
