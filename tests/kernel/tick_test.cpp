// A tick is whole or not at all.
#include "toy_world.hpp"

namespace muster {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Ticks = ToyWorld;

// Something of every kind that a tick publishes before its last phase.
const std::string busy = two_robots + "<toy.copy_physics name='mover' to='robot/*/pose' columns='" + pose +
                         "' own='true' add='1'/>\n"
                         "<toy.copy_physics name='rest' to='robot/*/v' flags='2' own='true' add='1' every='2'/>\n"
                         "<toy.copy_physics name='row' to='robot/b/v' own='true' add='1'/>\n"
                         "<toy.list name='l'/>\n"
                         "<toy.copy_radio name='p' as='add' to='link/*/level' columns='level[dBm]' add='-40'/>\n"
                         "<toy.copy_sense name='s' as='modify' to='robot/*/v' times='2'/>\n"
                         "<toy.send_control name='send' robot='a' to='outbox/{robot}/message'/>\n"
                         "<toy.listen_network name='hear'/>\n"
                         "<toy.draw name='draw'/>\n"
                         "<toy.kinds name='kinds'/>\n"
                         "<toy.join name='j' at='6' leave='9'/>\n"
                         "<toy.copy_sense name='own' to='self/state' own='true' add='0.25'/>\n";

TEST_F(Ticks, ATickThatFailsInItsLastPhaseIsTakenBackWhole) {
  for (const int at : {2, 3, 6, 7, 9, 10}) {
    Simulation sim = run(busy + "<toy.fault name='f' fault='throws' tick='" + std::to_string(at) + "'/>\n");
    Simulation other = run(busy + "<toy.fault name='f' fault='none'/>\n");
    step(sim, at - 1), step(other, at - 1);
    const uint64_t before = sim.digest();
    const std::size_t events = sim.events().size();
    ASSERT_EQ(before, other.digest());
    for (int tries = 0; tries < 3; ++tries) {
      EXPECT_THAT(error_of([&] { sim.step(); }), HasSubstr("f (toy.fault): step failed at tick " + std::to_string(at)));
      EXPECT_EQ(sim.digest(), before) << at;
      EXPECT_EQ(sim.tick(), static_cast<uint64_t>(at - 1));
      EXPECT_EQ(sim.events().size(), events);
    }
    sim.swap("f", instance("toy.fault", "", {{"fault", "none"}}));
    step(sim, 5), step(other, 5);
    EXPECT_EQ(sim.digest(), other.digest()) << at;  // as if nothing had happened
  }
}

TEST_F(Ticks, ATableIsPublishedOnceATick) {
  Simulation sim = run(busy);
  step(sim, 3);
  EXPECT_EQ(sim.table("robot/*/pose").table->now().tick, 3u);
  EXPECT_EQ(sim.table("robot/*/v").table->now().tick, 3u);
}

TEST_F(Ticks, TimeIsTickTimesDt) {
  Simulation sim{world(two_robots, "dt=\"0.1\" until=\"1000\""), standard(), options()};
  step(sim, 3);
  EXPECT_EQ(sim.time(), 3 * 0.1);
  EXPECT_EQ(sim.world().ticks, 10000u);
}

TEST_F(Ticks, EvaluateRunsOnePhaseAndTimeStands) {
  Simulation sim =
      run(two_robots +
          "<toy.draw name='draw' mean='5'/>\n<toy.copy_physics name='count' to='self/n' own='true' add='1'/>\n");
  step(sim, 4);
  const double drawn = cell(sim, "robot/a/reading");
  EXPECT_NE(drawn, 5);
  sim.evaluate(MUSTER_SENSE, true);
  EXPECT_EQ(cell(sim, "robot/a/reading"), 5);
  sim.set_parameter("draw/mean", -1);
  sim.evaluate(MUSTER_SENSE, true);
  EXPECT_EQ(cell(sim, "robot/a/reading"), -1);
  sim.set_parameter("draw/mean", 5);
  sim.evaluate(MUSTER_SENSE, false);
  EXPECT_TRUE(same_bits(cell(sim, "robot/a/reading"), drawn));
  EXPECT_EQ(cell(sim, "instance/count/n"), 4);
  EXPECT_EQ(sim.tick(), 4u);
}

TEST_F(Ticks, EvaluateAgainStepsWhatChangedAndWhatReadsThat) {
  Simulation sim =
      run(two_robots +
          "<toy.draw name='draw' mean='5'/>\n<toy.copy_sense name='alone' to='self/n' own='true' add='1'/>\n"
          "<toy.copy_sense name='after' from='robot/*/reading' columns='reading[m]' to='self/n' own='true'/>\n");
  step(sim, 1);
  sim.evaluate(MUSTER_SENSE, true);
  const double alone = cell(sim, "instance/alone/n"), after = cell(sim, "instance/after/n");
  sim.evaluate(MUSTER_SENSE, true);
  EXPECT_EQ(cell(sim, "instance/alone/n"), alone);
  EXPECT_EQ(cell(sim, "instance/after/n"), after);
  sim.set_parameter("draw/mean", 7);
  sim.evaluate(MUSTER_SENSE, true);
  EXPECT_EQ(cell(sim, "instance/alone/n"), alone);
  EXPECT_EQ(cell(sim, "instance/after/n"), after + 7);
  sim.evaluate(MUSTER_SENSE, false);  // drawn, not expected: all again
  EXPECT_EQ(cell(sim, "instance/alone/n"), alone + 1);
  step(sim, 1);
  sim.evaluate(MUSTER_SENSE, false);
  EXPECT_EQ(cell(sim, "instance/alone/n"), alone + 3);
}

TEST_F(Ticks, EvaluateReachesInstancesThatAreNotDue) {
  Simulation sim = run(two_robots + "<toy.draw name='draw' mean='5' every='8'/>\n");
  step(sim, 3);
  sim.evaluate(MUSTER_SENSE, true);
  EXPECT_EQ(cell(sim, "robot/a/reading"), 5);
}

TEST_F(Ticks, APluginInPlainC) {
  Simulation sim = run(two_robots + "<toy.plain name='cells' rate='0.2'/>\n");
  step(sim, 6);
  double left = 1;
  for (int i = 0; i < 6; ++i) left *= 1 - 0.2 * 0.5;
  EXPECT_THAT(column(sim, "robot/*/battery"), ElementsAre(left, left));
  EXPECT_THAT(messages(sim), ElementsAre("5 cells: five ticks old"));
  EXPECT_EQ(error_of_world("<toy.plain name='cells' rate='2'/>\n"),
            "world.xml:2:31: attribute \"rate\": 2 is out of bounds; expected a number from 0 to 1 1/s");
}

}  // namespace
}  // namespace muster
