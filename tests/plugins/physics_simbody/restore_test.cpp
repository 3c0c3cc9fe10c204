// A run is a function of the given state: copies, remade engines and other robots beside it change no bit.
#include <cstring>

#include "scarabs.hpp"

namespace muster::simbody {
namespace {

Command wild(double t) { return command(0.4 + 0.5 * std::sin(2 * t), 2 * std::sin(3 * t)); }

// Slippery, so that steps go through the search that begins at the remembered impulses.
description::Robot slippery() {
  description::Robot robot = scarab();
  robot.drive->friction = 0.03;
  return robot;
}

TEST(Restore, RemadeEngineGivesTheSameBits) {
  const description::Robot robot = slippery();
  for (Integrator integrator : {Integrator::midpoint, Integrator::rk3}) {
    Fleet straight({rolling(0, 0, 0.3, 0.4, 0), rolling(5, 1, 2, 0.4, 0)}, robot, integrator, 0.002);
    Fleet remade = Fleet({rolling(0, 0, 0.3, 0.4, 0), rolling(5, 1, 2, 0.4, 0)}, robot, integrator, 0.002);
    for (int k = 0; k < 60; ++k) {
      const Command c = wild(k * 0.01);
      straight.tick(0.01, {c, c});
      if (k % 7 == 3) remade.remake();
      remade.tick(0.01, {c, c});
    }
    for (std::size_t i = 0; i < 2; ++i) expect_same_bits(straight.states[i], remade.states[i]);
  }
}

TEST(Restore, MemoryMattersWhenWheelsSlip) {
  const description::Robot robot = slippery();
  Fleet with({rolling(0, 0, 0, 0.4, 0)}, robot), without({rolling(0, 0, 0, 0.4, 0)}, robot);
  for (int k = 0; k < 60; ++k) {
    const Command c = wild(k * 0.01);
    with.tick(0.01, {c});
    without.tick(0.01, {c});
    without.states[0].memory = Memory();
  }
  EXPECT_NE(with.states[0].pose, without.states[0].pose);  // otherwise the test above tests nothing
}

TEST(Restore, ANeighbourChangesNothing) {
  const RobotState start = rolling(0, 0, 0.3, 0.4, 0);
  Fleet alone({start}), beside({rolling(9, 9, 1, 0.1, 0), start, rolling(5, 5, 2, 0.2, 0)});
  for (int k = 0; k < 50; ++k) {
    const Command c = wild(k * 0.01);
    alone.tick(0.01, {c});
    beside.tick(0.01, {command(0.1, 1), c, command(-0.2, 0)});
  }
  expect_same_bits(alone.states[0], beside.states[1]);
}

// An engine's input is not changed before its first step, not even a quaternion that is not quite of unit length.
TEST(Restore, StateStaysAsHandedIn) {
  RobotState odd = rolling(1.1, 2.2, 0.3, 0.4, 0.1);
  odd.pose[3] *= 1 + 1e-12;
  odd.pose[2] = -3.3e-5;
  Fleet run({odd});
  run.remake();
  expect_same_bits(run.states[0], odd);
}

TEST(Restore, SplitTicksGiveTheSameBits) {
  Fleet one({rolling(0, 0, 0, 0.4, 0.2)}), two({rolling(0, 0, 0, 0.4, 0.2)});
  one.tick(0.5, {command(0.4, 0.2)});
  two.tick(0.25, {command(0.4, 0.2)});
  two.tick(0.25, {command(0.4, 0.2)});
  expect_same_bits(one.states[0], two.states[0]);
}

}  // namespace
}  // namespace muster::simbody
