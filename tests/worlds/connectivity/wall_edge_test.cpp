// Where a wall makes the link jump across the threshold there is no place at which it is held.
#include "chain.hpp"

namespace {

using namespace muster;
using namespace muster::test;

struct Outcome {
  int crossings = 0;        // of the wall
  double last = 0;          // when it was crossed last [s]
  double x = 0, speed = 0;  // at the end
};

// 40 dB at 1 m in free space: -58 dBm before the wall at 8 m, -64 dBm behind it.
Outcome at_the_wall(const std::string& switching, const std::string& loss = "6") {
  Folder folder;
  Simulation run = world_of(folder,
                            "<material name='brick' loss='" + loss +
                                "'/><wall name='w' from='8 -5' to='8 5' material='brick'/>"
                                "<station name='base' at='0 0 0'/><robot name='leader' at='1 0 0'/>"
                                "<physics.planar through_walls='true'/><robots.drive/><robots.odometry/>"
                                "<radio.multiwall l0='40' n='2'/><network.ideal/><control.beacon radio='base'/>"
                                "<control.connectivity name='steer' robot='leader' roadmap='way.csv' parent='base' "
                                "role='leader' smoothing='2' switching='" +
                                switching + "'/>",
                            {{"way.csv", "x[m],y[m]\n0,0\n30,0\n"}}, "dt='0.05' until='400' seed='1'");
  Outcome result;
  bool was_behind = false;
  while (!run.done()) {
    run.step();
    const bool is_behind = row<Pose>(run, "robot/leader/pose").x > 8;
    if (is_behind != was_behind) ++result.crossings, result.last = run.time();
    was_behind = is_behind;
  }
  result.x = row<Pose>(run, "robot/leader/pose").x;
  result.speed = steering_of(run, "steer").speed;
  return result;
}

TEST(AtAWallsEdge, ASwitchingFunctionWithoutMemoryGoesToAndFro) {
  for (const char* switching : {"linear", "tanh", "relay"}) {
    const Outcome outcome = at_the_wall(switching);
    EXPECT_GT(outcome.crossings, 10) << switching;
    EXPECT_GT(outcome.last, 350) << switching;
  }
}

TEST(AtAWallsEdge, WithHysteresisTheRobotRestsBeforeTheWall) {
  const Outcome outcome = at_the_wall("hysteresis");
  EXPECT_EQ(outcome.crossings, 2);
  EXPECT_LT(outcome.last, 100);
  EXPECT_LT(outcome.x, 8);
  EXPECT_GT(outcome.x, 7);
  EXPECT_EQ(outcome.speed, 0);
}

// Behind this wall nothing is heard. A link that was lost left no mark, so that the robot went to and fro.
TEST(AtAWallsEdge, WithHysteresisTheRobotRestsBeforeAWallThatSilencesTheLink) {
  const Outcome outcome = at_the_wall("hysteresis", "60");
  EXPECT_EQ(outcome.crossings, 2);
  EXPECT_LT(outcome.last, 100);
  EXPECT_LT(outcome.x, 8);
  EXPECT_GT(outcome.x, 7);
  EXPECT_EQ(outcome.speed, 0);
}

}  // namespace
