// What a world file plans for times of the run: numbers that are set, plugins exchanged, robots that leave.
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
  EXPECT_EQ(error("<set path='mover/add' value='much'/>"),
            "world.xml:5:40: attribute \"value\": \"much\" is not a number; expected a number from -1e+06 to 1e+06 m");
  EXPECT_EQ(error("<leave robot='c'/>"), "world.xml:5:25: no robot is called \"c\"; expected one of a, b");
  EXPECT_EQ(error("<set path='mover/add'/>"),
            "world.xml:5:11: <set> has no attribute \"value\", which it needs; expected its new value");
  EXPECT_EQ(error("<stop/>"), "world.xml:5:11: <stop> is no element of <at>; expected one of set, swap, leave");
  EXPECT_EQ(error("<swap at='3' instance='mover' plugin='toy.copy_physics'/>"),
            "world.xml:5:17: <swap> has no attribute \"at\" inside <at>, whose time it has");
}

}  // namespace
}  // namespace muster
