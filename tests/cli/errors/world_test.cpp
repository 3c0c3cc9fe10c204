// FAULTS 5 to 7 and 13: a world that says what it cannot mean.
#include <gmock/gmock.h>

#include "program.hpp"

using namespace muster::test;

namespace {

TEST(Fault5, WhatIsMisspeltIsToldWithTheNearestName) {
  const ProgramFolder folder;
  folder.expect_refused(
      world_of(R"(<statoin name="b" at="0 0 1"/>)"),
      "world.xml:1:36: <statoin> is no element of a world; expected a plugin (with a dot in its name) or one of at, "
      "swap, record, material, wall, walls, door, floor, mesh, station, robot; did you mean \"station\"?");
  folder.expect_refused(
      world_of(R"(<station name="b" att="0 0 1"/>)"),
      "world.xml:1:54: <station> has no attribute \"att\"; expected one of name, at, yaw; did you mean \"at\"?");
  folder.expect_refused(
      world_of(R"(<station name="b"/>)"),
      "world.xml:1:36: <station> has no attribute \"at\", which it needs; expected 3 numbers from -1e+06 to 1e+06 m");
  folder.expect_refused(world_of(R"(<test.good siez="2"/>)"),
                        "world.xml:1:47: <test.good> has no attribute \"siez\"; expected one of name, every, library, "
                        "revision, size; did you "
                        "mean \"size\"?");
  folder.expect_refused(R"(<world nmae="w" until="1"/>)",
                        "world.xml:1:8: <world> has no attribute \"nmae\"; expected one of name, dt, until, seed; did "
                        "you mean \"name\"?");
  folder.expect_refused(R"(<wolrd until="1"/>)", "world.xml:1:1: the root element is <wolrd>; expected <world>");
}

TEST(Fault5, HabitsOfSdfAndRos) {
  const ProgramFolder folder;
  folder.expect_refused(
      world_of(R"(<node pkg="nav" type="waypoint" name="driver"/>)"),
      "world.xml:1:36: <node> is no element of a world; expected a plugin (with a dot in its name) or one of at, "
      "swap, record, material, wall, walls, door, floor, mesh, station, robot; a node is a plugin, such as "
      "<control.waypoint robot=\"...\"/>: muster plugins lists them");
  folder.expect_refused(world_of(R"(<robot name="r"><pose>3 2 0 0 0 1.5</pose></robot>)"),
                        "world.xml:1:58: the text \"3 2 0 0 0 1.5\" stands between elements; expected attributes: "
                        "<robot at=\"3 2 0\" heading=\"1.5\"/>");
  folder.expect_refused(world_of(R"(<station name="base">2 1 1.5</station>)"),
                        "world.xml:1:57: the text \"2 1 1.5\" stands between elements; expected it as an attribute: "
                        "<station at=\"2 1 1.5\"/>");
  folder.expect_refused(world_of(R"(<wall material="m">0 0 5 0</wall>)"),
                        "world.xml:1:55: the text \"0 0 5 0\" stands between elements; expected it as an attribute: "
                        "<wall from=\"0 0\" to=\"5 0\"/>");
  folder.expect_refused(
      world_of(R"(<station name="base">2 1</station>)"),
      "world.xml:1:57: the text \"2 1\" stands between elements; expected elements and comments only, "
      "and values as attributes: <station NAME=\"VALUE\"/>");
  folder.expect_refused(world_of(R"(<physics type="ode"><max_step_size>0.001</max_step_size></physics>)"),
                        "world.xml:1:36: <physics> is no element of a world; expected <physics.ode/>");
  folder.expect_refused(
      world_of(R"(<station name="rover" at="0 0 1"/><record table="/rover/traffics"/>)"),
      "world.xml:1:70: record: there is no table \"/rover/traffics\"; did you mean \"radio/rover/traffic\"? expected "
      "SET/ROW/QUANTITY, or SET/*/QUANTITY for all rows");
  folder.expect_refused(
      world_of(R"(<station name="rover" at="0 0 1"/><record table="radio/rover/traffic/frames"/>)"),
      "world.xml:1:70: record: there is no table \"radio/rover/traffic/frames\"; \"frames\" is taken for a column of "
      "it, and tables are named whole; expected \"radio/rover/traffic\"");
}

TEST(Fault5, APathThatStopsAtAnElement) {
  const ProgramFolder folder;
  folder.expect_refused(
      world_of(
          R"(<material name="m" loss="1"/><wall name="w" from="0 0" to="5 0" material="m"/><door name="d" wall="w" at="1" )"
          R"(width="1"/><radio.multiwall/><at t="0.5"><set path="door/d" value="open"/></at>)"),
      "world.xml:1:197: there is no parameter \"door/d\"; it has several: expected one of door/d/at, door/d/width, "
      "door/d/height, door/d/state");
}

TEST(Fault5, WallsInMillimetres) {
  const ProgramFolder folder;
  folder.expect_refused(
      world_of(R"(<material name="m" loss="1"/><wall name="w" from="0 0" to="12000 0" material="m"/>)"),
      "world.xml:1:65: wall \"w\" reaches to 12000 m, beyond the scene; expected coordinates within "
      "1000 m; are these millimetres?");
}

TEST(Fault5, WordsOfTheCommandLineToo) {
  const ProgramFolder folder;
  const auto misspelt = folder.muster({"chekc"});  // the list of verbs grows
  EXPECT_EQ(misspelt.exit, 2);
  EXPECT_THAT(misspelt.err, testing::StartsWith("muster: error: there is no verb \"chekc\"; did you mean \"check\"? "
                                                "expected one of run, check, "));
  expect_error(folder.muster({"check"}), 2,
               "muster check: world is required: the world's folder or file; see muster check --help");
}

void expect_numbers_refused(const std::vector<std::string>& environment) {
  const ProgramFolder folder;
  Surroundings around;
  around.environment = environment;
  const std::pair<const char*, const char*> cases[] = {
      {"1,5", R"("1,5" is not a number; a decimal point is written '.')"},
      {"nan", R"("nan" is not a number; it must be finite)"},
      {"inf", R"("inf" is not a number; it must be finite)"},
      {"1e400", R"("1e400" is out of range)"},
      {"1.5abc", R"("1.5abc" is not a number; "abc" follows the number)"},
      {"0x10", R"("0x10" is not a number; numbers are written in decimal: 16)"},
      {" ", R"(" " is not a number; it has spaces in it or around it)"},
      {"", R"("" is not a number; the text is empty)"}};
  for (const auto& [text, why] : cases) {
    SCOPED_TRACE(text);
    folder.write("world.xml", world_of("<test.good size=\"" + std::string(text) + "\"/>"));
    expect_error(folder.muster({"check", "world.xml", "--plugins", MUSTER_TOYS}, around), 2,
                 "world.xml:1:53: attribute \"size\": " + std::string(why) + "; expected a number from 0 to 10 m");
  }
  folder.write("world.xml", world_of(R"(<test.good every="-1"/>)"));
  expect_error(folder.muster({"check", "world.xml", "--plugins", MUSTER_TOYS}, around), 2,
               "world.xml:1:54: attribute \"every\": -1 is out of bounds; expected an integer from 1");
}

TEST(Fault6, NumbersAreStrict) { expect_numbers_refused({}); }
TEST(Fault6, NumbersAreStrictInGermany) { expect_numbers_refused({"LOCPATH=" MUSTER_LOCALES, "LC_ALL=de_DE.UTF-8"}); }

TEST(Fault7, DegreesInAFieldOfRadiansAreWarnedOf) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of(R"(<station name="b" at="0 0 1" yaw="90"/>)"));
  const auto outcome = folder.muster({"check", "world.xml"});
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_EQ(
      outcome.out,
      "warning: world.xml:1:70: attribute \"yaw\": 90 rad is more than a full turn; are these degrees? 90 degrees "
      "are 1.5708 rad\n"
      "w: 0 instances, 0 tables; no error, 1 warning\n");
}

TEST(Fault7, ImpossibleQuantitiesAreRefused) {
  const ProgramFolder folder;
  folder.expect_refused(
      world_of(R"(<material name="m" loss="-4"/>)"),
      "world.xml:1:61: attribute \"loss\": -4 is out of bounds; expected a number from 0 to 100 dB; without the "
      "minus? losses and deviations are positive: 4");
  folder.expect_refused(
      R"(<world dt="0" until="1"/>)",
      "world.xml:1:12: attribute \"dt\": 0 is out of bounds; expected the tick in seconds, from 1e-09");
  folder.expect_refused(R"(<world dt="2" until="1"/>)",
                        "world.xml:1:22: 1 s are less than a tick of 2 s; expected a longer time, or a smaller dt");
  folder.expect_refused(R"(<world dt="0.001" until="1e12"/>)",
                        "world.xml:1:26: 1e+12 s are 1e+15 ticks of 0.001 s; expected fewer than 1e+12");
}

TEST(Fault7, WallsWithoutLengthAndDoorsBeyondTheirsAreToldWithTheirLines) {
  const ProgramFolder folder;
  const std::string brick = "<material name=\"m\" loss=\"4\"/>\n";
  folder.expect_refused(world_of(brick + R"(<wall name="w1" from="1 2" to="1 2" material="m"/>)"),
                        "world.xml:2:1: wall \"w1\" has no length; expected ends at least 2^-12 m apart");
  const std::string wall = R"(<wall name="w1" from="0 0" to="3 4" material="m"/>)";
  folder.expect_refused(
      world_of(brick + "<door name=\"d1\" wall=\"w1\" at=\"4.2\"/>\n" + wall),
      "world.xml:2:31: door \"d1\" ends at 5.1 m (at 4.2 + width 0.9) of the wall \"w1\", which is 5 m long; expected "
      "at=\"4.1\" or less");
  folder.write("world.xml", world_of(brick + "<door wall=\"w1\" at=\"4.1\"/>\n" + wall));
  EXPECT_EQ(folder.muster({"check", "world.xml"}).exit, 0);
  folder.write("walls.csv",
               "name,x0[m],y0[m],x1[m],y1[m],height[m],thickness[m],material\nq,0,0,3,4,2,0.1,m\nr,3,4,3,4,2,0.1,m\n");
  folder.expect_refused(world_of(brick + R"(<walls file="walls.csv"/>)"),
                        "walls.csv:3:1: wall \"r\" has no length; expected ends at least 2^-12 m apart");
}

TEST(Fault7, TimesOutsideOfTheRunAreRefused) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of("<test.good/>"));
  const auto refused = [&](std::vector<std::string> words, const std::string& why) {
    words.insert(words.end(), {"--plugins", MUSTER_TOYS});
    expect_error(folder.muster(words), 2, why);
  };
  refused({"run", "world.xml", "--until", "-1"}, "--until: -1 s is before the start; expected a time from 0");
  const auto swap_at = [&](const std::string& at, const std::string& why) {
    refused({"swap", "world.xml", "--at", at, "--instance", "test.good", "--plugin", "test.good"}, why);
  };
  swap_at("-1", "--at: -1 s is before the start; expected a time from 0");
  swap_at("1", "--at: 1 s is at the end of the run or after it; expected less than 1 s");
  ASSERT_EQ(folder.muster({"run", "world.xml", "--save", "end.snap", "--plugins", MUSTER_TOYS}).exit, 0);
  refused(
      {"run", "world.xml", "--until", "0.5", "--restore", "end.snap"},
      "--restore: end.snap stands at 1 s, after the end of the run at 0.5 s; expected --until above 1: it is a time of "
      "the world, not a duration");
}

TEST(Restored, WhatTheFileSaysNowAndTheSnapshotDoesNotIsTold) {
  const ProgramFolder folder;
  const auto of = [&](const std::string& wall, const std::string& attributes = "dt=\"0.1\" until=\"2\"") {
    folder.write("world.xml", "<world " + attributes + "><material name=\"m\" loss=\"4\"/>\n<wall name=\"w1\" from=\"" +
                                  wall +
                                  "\" to=\"3 4\" material=\"m\"/><robot name=\"r\" at=\"0 0 0\"/><control.steady "
                                  "name=\"steer\" robot=\"r\" v=\"0.5\"/><physics.simbody/>"
                                  "<robots.drive/></world>");
  };
  of("1 1");
  ASSERT_EQ(folder.muster({"run", "world.xml", "--until", "1", "--save", "s.snap"}).exit, 0);
  EXPECT_EQ(folder.muster({"run", "world.xml", "--restore", "s.snap"}).err, "");
  of("1 2");
  const Outcome moved = folder.muster({"run", "world.xml", "--restore", "s.snap"});
  EXPECT_EQ(moved.exit, 0);
  EXPECT_EQ(moved.err,
            "muster: warning: --restore: the run goes on with what s.snap holds; changed in the world file since, and "
            "not taken: wall/w1/shape\n");
  // What is asked for on the command line is done.
  const auto digest = [&](const std::vector<std::string>& words) {
    std::vector<std::string> all = {"run", "world.xml", "--restore", "s.snap", "--json"};
    all.insert(all.end(), words.begin(), words.end());
    const std::string out = folder.muster(all).out;
    return out.substr(out.find("\"digest\""), 30);
  };
  EXPECT_NE(digest({"--set", "steer/v=0.1"}), digest({}));
  of("1 1", "dt=\"0.05\" until=\"2\"");
  expect_error(folder.muster({"run", "world.xml", "--restore", "s.snap"}), 2,
               "--restore: s.snap: the snapshot was saved at ticks of 0.1 s, and here they are of 0.05 s; expected "
               "dt=\"0.1\"");
}

TEST(Fault5, ARecordOfNoTableIsToldWhetherItIsWrittenOrNot) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of("<test.good/>\n<record table=\"robot/*/psoe\"/>"));
  for (const std::string verb : {"check", "run"}) {
    SCOPED_TRACE(verb);
    expect_error(folder.muster({verb, "world.xml", "--plugins", MUSTER_TOYS}), 2,
                 "world.xml:2:1: record: there is no table \"robot/*/psoe\"; expected instance/test.good/*/cell");
  }
}

TEST(Fault5, FoldersOfPluginsThatAreNotThereAreTold) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of("<test.good/>"));
  expect_error(folder.muster({"check", "world.xml", "--plugins", "toys"}), 2,
               "--plugins: \"toys\" is no folder; expected one");
  Surroundings around;
  around.environment = {"MUSTER_PLUGIN_PATH=" MUSTER_TOYS ":toys"};
  expect_error(folder.muster({"check", "world.xml"}, around), 2,
               "MUSTER_PLUGIN_PATH: \"toys\" is no folder; expected one");
}

TEST(Fault13, TwoOfOneNameAreRefusedWithBothPlaces) {
  const ProgramFolder folder;
  folder.expect_refused(world_of("\n<robot name=\"a\" at=\"0 0 0\"/>\n<robot name=\"a\" at=\"1 0 0\"/>"),
                        "world.xml:3:1: a second robot is called \"a\"; the first is at world.xml:2:1; expected "
                        "another name for one of them");
  folder.expect_refused(
      world_of("\n<test.good/>\n<test.good/>"),
      "world.xml:3:1: a second instance is called \"test.good\"; the first is at world.xml:2:1; give one of them a "
      "name=\"...\" of its own");
}

}  // namespace
