// What a world file plans, at times and on conditions: numbers set, plugins exchanged, robots that join and leave.
#include "toy_world.hpp"

namespace muster {
namespace {

using testing::ElementsAre;
using Planned = ToyWorld;

// Adds 1 to each robot's pose in each tick of 0.5 s.
const std::string adder =
    "<toy.copy_physics name='mover' to='robot/*/pose' columns='" + pose + "' own='true' add='1'/>\n";

double x_of(const Simulation& run) { return cell(run, "robot/a/pose"); }

TEST_F(Planned, ANumberIsSetBeforeTheTickOfItsTime) {
  Simulation sim = run(two_robots + adder + "<at t='2'><set path='mover/add' value='3'/></at>\n");
  step(sim, 4);
  EXPECT_EQ(x_of(sim), 5);
  EXPECT_TRUE(messages(sim).empty());
  step(sim);
  EXPECT_EQ(x_of(sim), 8);
  EXPECT_THAT(messages(sim), ElementsAre("4 : set mover/add to 3"));
}

TEST_F(Planned, ARestoredRunGoesTheSameWay) {
  const std::string changes =
      "<at t='2'><set path='mover/add' value='3'/><leave robot='b'/></at>\n<at t='3'><set path='mover/add' "
      "value='0'/></at>\n";
  Simulation sim = run(two_robots + adder + changes);
  step(sim, 3);
  const Snapshot before = sim.snapshot();
  step(sim, 2);
  const Snapshot between = sim.snapshot();
  step(sim, 5);
  const uint64_t digest = sim.digest();
  for (const Snapshot& from : {before, between}) {
    sim.restore(from);
    step(sim, static_cast<int>(10 - from.tick));
    EXPECT_EQ(sim.digest(), digest) << from.tick;
    Simulation other = run(two_robots + adder + changes, 3);
    other.restore(from);
    step(other, static_cast<int>(10 - from.tick));
    EXPECT_EQ(other.digest(), digest) << from.tick;
  }
}

TEST_F(Planned, SwapsComeFirst) {
  Simulation sim = run(two_robots + adder +
                       "<at t='1'>\n<set path='mover/add' value='7'/>\n"
                       "<swap instance='mover'><toy.copy_physics to='robot/*/pose' columns='" +
                       pose + "' own='true' add='100'/></swap></at>\n");
  step(sim, 3);
  EXPECT_EQ(x_of(sim), 1 + 2 + 7);
}

TEST_F(Planned, ARobotLeaves) {
  Simulation sim = run(two_robots + adder + "<at t='1'><leave robot='a'/></at>\n");
  step(sim, 2);
  const Set& robots = *sim.board().find_set("robot");
  EXPECT_TRUE(robots.alive[0]);
  step(sim);
  EXPECT_FALSE(robots.alive[0]);
  EXPECT_TRUE(robots.alive[1]);
  EXPECT_THAT(messages(sim), ElementsAre("2 : robot \"a\" leaves", "2 : radio \"a\" leaves"));
  Simulation other = run(two_robots + adder + "<station name='s' at='0 0 0'/>\n<at t='1'><leave station='s'/></at>\n");
  step(other, 3);
  EXPECT_THAT(other.board().find_set("radio")->alive, ElementsAre(1, 1, 0));
}

TEST_F(Planned, ADoorOpensByItsWord) {
  Simulation sim =
      run("<material name='brick' loss='4'/>\n<wall name='w' from='0 0' to='4 0' material='brick'/>\n"
          "<door name='d' wall='w' at='1'/>\n"
          "<toy.copy_sense name='who_looks' from='door/*/state' columns='open' to='door/*/seen'/>\n" +
          two_robots + adder + "<at t='1'><set path='door/d/state' value='open'/></at>\n");
  EXPECT_EQ(sim.parameter("door/d/state").value, 0);
  step(sim, 3);
  EXPECT_EQ(sim.parameter("door/d/state").value, 1);
}

TEST_F(Planned, FaultsAreToldBeforeTheRun) {
  const auto error = [&](const std::string& change) {
    return error_of([&] { run(two_robots + adder + "<at t='2'>" + change + "</at>\n"); });
  };
  EXPECT_EQ(error("<set path='mover/ad' value='3'/>"),
            "world.xml:5:22: there is no parameter \"mover/ad\"; expected one of mover/as, mover/flags, "
            "mover/read_flags, mover/own, mover/add, mover/times; did you mean \"mover/as\"?");
  EXPECT_EQ(
      error_of([&] {
        run("<material name='brick' loss='4'/>\n<wall name='w' from='0 0' to='4 0' material='brick'/>\n"
            "<door name='d' wall='w' at='1'/>\n"
            "<toy.copy_sense name='who_looks' from='door/*/state' columns='open' to='door/*/seen'/>\n" +
            two_robots + adder + "<at t='1'><set path='door/d/open' value='true'/></at>\n");
      }),
      "world.xml:9:22: there is no parameter \"door/d/open\"; \"open\" is a value of \"door/d/state\"; expected that "
      "path, and the value open");
  EXPECT_EQ(error("<set path='mover/add' value='much'/>"),
            "world.xml:5:40: attribute \"value\": \"much\" is not a number; expected a number from -1e+06 to 1e+06 m");
  EXPECT_EQ(error("<leave robot='c'/>"), "world.xml:5:25: no robot is called \"c\"; expected one of a, b");
  EXPECT_EQ(error("<leave robot='mover'/>"),
            "world.xml:5:25: no robot is called \"mover\", which is an instance of toy.copy_physics (world.xml:4:1); "
            "expected one "
            "of a, b");
  EXPECT_EQ(error("<set path='mover/add'/>"),
            "world.xml:5:11: <set> has no attribute \"value\", which it needs; expected its new value");
  EXPECT_EQ(error("<stop/>"),
            "world.xml:5:11: <stop> is no element of <at>; expected a plugin (with a dot in its name) or one of set, "
            "leave, robot, station, swap, remove");
  EXPECT_EQ(error("<swap at='3' instance='mover' plugin='toy.copy_physics'/>"),
            "world.xml:5:17: <swap> has no attribute \"at\" inside <at>, whose time it has");
}

TEST_F(Planned, ASetOfWhatIsNoNumberIsToldWithTheSwapThatDoesIt) {
  const auto error = [&](const std::string& change, const std::string& when = "t='2'") {
    return error_of([&] { run(two_robots + adder + "<at " + when + ">" + change + "</at>\n"); });
  };
  const std::string fixed =
      "world.xml:5:22: \"mover/to\" is a text, and no parameter: numbers, flags and choices are; expected to=\"...\" "
      "in "
      "the world, at world.xml:4:1, or here <swap instance=\"mover\"><toy.copy_physics to=\"robot/*/x\" columns=\"" +
      pose + "\" own=\"true\" add=\"1\"/></swap>";
  EXPECT_EQ(error("<set path='mover/to' value='robot/*/x'/>"), fixed);
  EXPECT_THAT(error("<set path='mover/to' value='3'/>"), testing::HasSubstr("\"mover/to\" is a text"));
  EXPECT_THAT(
      error("<set path='mover/robot' value='b'/>"),
      testing::AllOf(testing::HasSubstr("is the name of a robot"), testing::HasSubstr(" robot=\"b\"/></swap>")));
  EXPECT_THAT(error("<set path='mover/to' value='x'/>", "when='robot/a/pose/x above 2'"),
              testing::HasSubstr("\"mover/to\" is a text"));
  EXPECT_EQ(error("<set path='robot/a/model' value='husky'/>"),
            "world.xml:5:22: \"robot/a/model\" is a text, and no parameter: single numbers, flags and choices are; "
            "expected model=\"...\" of <robot>, at world.xml:2:1");
  // What is advised is accepted.
  EXPECT_EQ(error("<swap instance=\"mover\"><toy.copy_physics to=\"robot/*/pose\" columns=\"" + pose +
                  "\" own=\"true\" add=\"2\"/></swap>"),
            "no error");
}

TEST_F(Planned, AStateThatIsSetIsToldWithAParameterOfThisWorld) {
  const std::string steering = "<toy.copy_control name='driver' to='robot/a/command' columns='v[m/s] w[rad/s]'/>\n";
  EXPECT_EQ(
      error_of([&] { run(two_robots + adder + steering + "<at t='2'><set path='robot/a/pose/x' value='5'/></at>\n"); }),
      "world.xml:6:22: \"robot/a/pose/x\" is a state, which plugins write, and no parameter; expected a "
      "parameter, such as driver/add; to put the robot elsewhere, in an <at>: <leave robot=\"a\"/>, <robot "
      "name=\"a_2\" model=\"...\" at=\"X Y Z\"/>, which joins there, and a controller with robot=\"a_2\"");
}

// In place of `adder`: moves one robot.
std::string that_moves(const std::string& robot, const std::string& name) {
  return "<toy.copy_physics name='" + name + "' to='robot/" + robot + "/pose' columns='" + pose +
         "' own='true' add='1'/>";
}

TEST_F(Planned, ALeaveThatDoesNothingIsTold) {
  Simulation sim = run(two_robots + adder + "<at t='1'><robot name='late' at='7 0 0'/><leave robot='a'/></at>\n" +
                       "<at t='0.5'><leave robot='late'/></at>\n<at t='3'><leave robot='a'/></at>\n");
  EXPECT_THAT(messages(sim), ElementsAre("0 : warning: " + (folder / "world.xml").string() +
                                             ":6:27: \"late\" is not there then, and <leave> does nothing",
                                         "0 : warning: " + (folder / "world.xml").string() +
                                             ":7:25: \"a\" is not there then, and <leave> does nothing"));
}

TEST_F(Planned, ARobotJoinsAtItsPlace) {
  Simulation sim = run(two_robots + adder + "<at t='1'><robot name='late' at='7 0 0'/></at>\n");
  const Set &robots = *sim.board().find_set("robot"), &radios = *sim.board().find_set("radio");
  step(sim, 2);
  EXPECT_THAT(robots.alive, ElementsAre(1, 1, 0));
  EXPECT_THAT(radios.alive, ElementsAre(1, 1, 0));
  step(sim);
  EXPECT_THAT(robots.alive, ElementsAre(1, 1, 1));
  EXPECT_THAT(radios.alive, ElementsAre(1, 1, 1));
  EXPECT_THAT(messages(sim), ElementsAre("2 : robot \"late\" joins", "2 : radio \"late\" joins"));
}

TEST_F(Planned, APluginComesAndGoes) {
  Simulation sim = run(two_robots + that_moves("a", "first") + "\n<at t='1'>" + that_moves("b", "second") +
                       "</at>\n<at t='2'><remove instance='second'/></at>\n");
  step(sim, 6);
  EXPECT_EQ(x_of(sim), 1 + 6);
  EXPECT_EQ(cell(sim, "robot/b/pose"), 2 + 2);
  EXPECT_THAT(messages(sim), ElementsAre("2 second: inserted toy.copy_physics/1", "4 second: removed"));
}

// Two write one row for as long as the first is not removed: of one time both happen together.
TEST_F(Planned, OfOneTimeAllPluginsChangeTogether) {
  Simulation sim = run(two_robots + that_moves("a", "first") + "\n<at t='1'>" + that_moves("a", "second") +
                       "</at>\n<at t='1'><remove instance='first'/></at>\n");
  step(sim, 6);
  EXPECT_EQ(x_of(sim), 1 + 6);
}

TEST_F(Planned, AConditionCountsWhereItBeginsToHold) {
  Simulation sim =
      run(two_robots + adder + "<at when='robot/a/pose/x above 2'><set path='mover/add' value='-1'/></at>\n" +
          "<at when='robot/*/pose/x below 1'><set path='mover/add' value='2'/></at>\n");
  std::vector<double> way;
  for (int i = 0; i < 9; ++i) step(sim), way.push_back(x_of(sim));
  EXPECT_THAT(way, ElementsAre(2, 3, 2, 1, 0, 2, 4, 3, 2));
  EXPECT_EQ(messages(sim)[0], "2 : it holds that robot/a/pose/x above 2");
  EXPECT_EQ(messages(sim)[1], "2 : set mover/add to -1");
}

TEST_F(Planned, WhatOneConditionDoesMayBeginAnother) {
  Simulation sim =
      run("<material name='brick' loss='4'/>\n<wall name='w' from='0 0' to='4 0' material='brick'/>\n"
          "<door name='d' wall='w' at='1' state='closed'/>\n"
          "<toy.copy_sense name='who_looks' from='door/*/state' columns='open' to='door/*/seen'/>\n" +
          two_robots + adder +
          "<at when='door/d/state/open is 1'><set path='mover/add' value='0'/></at>\n"
          "<at when='robot/a/pose/x above 2'><set path='door/d/state' value='open'/></at>\n");
  step(sim, 6);
  EXPECT_EQ(x_of(sim), 3);
  const auto said = messages(sim);  // two conditions and what they set, in one tick
  EXPECT_EQ(std::count_if(said.begin(), said.end(), [](const auto& m) { return m.starts_with("2 "); }), 4);
}

TEST_F(Planned, WhatHoldsFromTheStartIsTold) {
  Simulation sim = run(two_robots + adder + "<at when='robot/b/pose/x above 1'><leave robot='b'/></at>\n");
  step(sim, 3);
  EXPECT_EQ(sim.board().find_set("robot")->alive[1], 1);
  EXPECT_THAT(messages(sim), ElementsAre(testing::HasSubstr("it holds from the start that robot/b/pose/x above 1")));
}

// A plugin that goes takes its table with it: no condition is met by it any more.
TEST_F(Planned, ATableThatWentMeetsNoCondition) {
  Simulation sim = run(two_robots +
                       "<toy.copy_physics name='c' to='self/x' own='true' add='1'/>\n"
                       "<at t='1'><remove instance='c'/></at>\n<at when='instance/c/x/v above 5'><leave "
                       "robot='a'/></at>\n");
  step(sim, 20);
  EXPECT_EQ(sim.board().find_set("robot")->alive[0], 1);
}

TEST_F(Planned, ATimeThatANumberIsSetAfterItsPluginWentIsRefused) {
  EXPECT_EQ(error_of([&] {
              run(two_robots + adder +
                  "<at t='1'><remove instance='mover'/></at>\n<at t='2'><set path='mover/add' "
                  "value='2'/></at>\n");
            }),
            "world.xml:6:22: \"mover\" is removed by then, and has no parameters");
}

TEST_F(Planned, ConditionsAreRestored) {
  const std::string world = two_robots + that_moves("a", "mover") +
                            "<at when='robot/a/pose/x above 2'><set path='mover/add' value='-1'/><robot name='late' "
                            "at='0 0 0'/>" +
                            that_moves("late", "second") +
                            "</at>\n<at when='robot/a/pose/x is 0'><set path='mover/add' value='1'/><remove "
                            "instance='second'/><leave robot='late'/></at>\n";
  Simulation sim = run(world);
  std::vector<Snapshot> all;
  for (int i = 0; i < 20; ++i) all.push_back(sim.snapshot()), step(sim);
  const auto said = messages(sim);
  EXPECT_EQ(std::count_if(said.begin(), said.end(), [](const auto& m) { return m.ends_with("\"late\" joins"); }),
            4 * 2);
  const uint64_t digest = sim.digest();
  for (const Snapshot& from : all) {
    sim.restore(from);
    step(sim, static_cast<int>(20 - from.tick));
    EXPECT_EQ(sim.digest(), digest) << from.tick;
    Simulation other = run(world, 3);
    other.restore(from);
    step(other, static_cast<int>(20 - from.tick));
    EXPECT_EQ(other.digest(), digest) << from.tick;
  }
}

TEST_F(Planned, FaultsOfConditionsAndOfWhatTheyBring) {
  const auto error = [&](const std::string& planned) {
    return error_of([&] { run(two_robots + adder + planned + "\n"); });
  };
  const auto when = [&](const std::string& condition) {
    return error("<at when='" + condition + "'><leave robot='a'/></at>");
  };
  EXPECT_EQ(when("robot/a/pose/x over 3"),
            "world.xml:5:11: attribute \"when\": \"over\" compares no numbers; expected one of below, above, is");
  EXPECT_EQ(when("robot/a/pose/x above"),
            "world.xml:5:11: attribute \"when\": \"robot/a/pose/x above\" is no condition; expected a condition, "
            "TABLE/COLUMN below, above or is NUMBER, such as \"robot/leader/pose/x above 3\" or "
            "\"link/base/rover/rssi/rssi below -60\"");
  EXPECT_EQ(when("robot/a/pose/x above 3m"),
            "world.xml:5:11: attribute \"when\": \"3m\" is not a number; \"m\" follows the number: units are fixed "
            "and not written; expected a number to compare with");
  EXPECT_EQ(when("robot/a/pose/x above 3 km"),
            "world.xml:5:11: attribute \"when\": \"3 km\" is not a number; \"km\" follows the number: units are fixed "
            "and not written; expected a number to compare with");
  EXPECT_THAT(when("robot/a/pose/yaw above 3"), testing::HasSubstr("; the turn here is the quaternion qw, qx, qy, qz"));
  EXPECT_EQ(when("robot/a/pose/u above 3"),
            "world.xml:5:11: the table robot/*/pose has no column \"u\"; expected one of x, y, z, qw, qx, qy, qz");
  EXPECT_EQ(when("robot/c/pose/x above 3"), "world.xml:5:11: there is no robot \"c\"; expected one of a, b");
  EXPECT_EQ(when("pose/x is 3"),
            "world.xml:5:11: \"pose/x\" is no number of a table; expected one such as robot/leader/pose/x, "
            "or <at t=\"SECONDS\"> for a time");
  EXPECT_EQ(error("<at t='1' when='robot/a/pose/x above 3'/>"),
            "world.xml:5:11: <at> has t=\"...\" and when=\"...\"; expected one of them");
  EXPECT_EQ(error("<at/>"),
            "world.xml:5:1: <at> has no attribute \"t\", which it needs; expected a time in seconds, from 0, or "
            "when=\"...\", a condition");
  EXPECT_EQ(
      error("<at t='1'><wall name='w' from='0 0' to='1 0' material='m'/></at>"),
      "world.xml:5:11: <wall> stands inside <at>, but rows of \"wall\" do not join a run; expected it in <world>; what "
      "opens and closes on the way is a <door> in it, by <set path=\"door/NAME/state\" value=\"closed\"/>");
  EXPECT_EQ(error("<at t='1'><robot name='a' at='0 0 0'/></at>"),
            "world.xml:5:11: a second robot is called \"a\"; the first is at world.xml:2:1; expected another name for "
            "one of them");
  EXPECT_EQ(error("<at t='1'>" + that_moves("a", "mover") + "</at>"),
            "world.xml:5:11: a second instance is called \"mover\"; the first is at world.xml:4:1"
            "; give one of them a name=\"...\" of its own");
  EXPECT_EQ(error("<at t='1'><remove instance='moves'/></at>"),
            "world.xml:5:29: no instance is called \"moves\"; expected mover; did you mean \"mover\"?");
  EXPECT_EQ(error("<at t='1'><remove instance='mover'/></at><at t='2'><remove instance='mover'/></at>"),
            "world.xml:5:70: no instance is called \"mover\" then; it has been removed, or comes later");
  // Two that write one row are told before the run, too.
  EXPECT_THAT(error("<at t='1'>" + that_moves("a", "second") + "</at>"), testing::HasSubstr("robot/a/pose"));
}

}  // namespace
}  // namespace muster
