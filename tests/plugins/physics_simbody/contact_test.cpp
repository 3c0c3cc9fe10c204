// Robots that touch walls and each other, against closed forms and conservation laws.
#include "benchmarks/crowds.hpp"
#include "motion.hpp"
#include "scarabs.hpp"

namespace muster::simbody {
namespace {

constexpr double front = 0.1;    // of a Scarab's body before its axle [m]
constexpr double radius = 0.05;  // of a wheel [m]
constexpr double coarse = 0.01;  // [s]

description::Robot changed(const std::function<void(description::DifferentialDrive&)>& change) {
  description::Robot robot = scarab();
  change(*robot.drive);
  return robot;
}
description::Robot on_ice() {
  return changed([](auto& drive) { drive.friction = 0; });
}

RobotState moving(double x, double y, double heading, double vx, double vy) {
  RobotState s = at_rest(x, y, heading);
  s.twist = {vx, vy, 0, 0, 0, 0};
  return s;
}

// The impulse on a robot's body in its last step, from all stored impulses.
Eigen::Vector3d impulse_on(const RobotState& s) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const KeptImpulse& kept : s.memory.kept) {
    if (kept.id != 0) sum += Eigen::Vector3d(kept.impulse[0], kept.impulse[1], kept.impulse[2]);
  }
  return sum;
}

TEST(Contact, WeakMotorsStallAtAWallAndPushWithTheirTorque) {
  const double torque = 0.2;
  const description::Robot weak = changed([&](auto& drive) { drive.max_torque = torque; });
  for (double h : {0.001, coarse}) {
    Fleet run({at_rest(0, 0, 0)}, weak, Integrator::midpoint, h);
    run.among({wall(0.4, -1, 0.4, 1, 0.1)}, 0.3);
    for (int k = 0; k < 400; ++k) run.tick(coarse, {command(0.3, 0)});
    const RobotState& s = run.states[0];
    EXPECT_NEAR(s.pose[0], 0.35 - front, 1e-4);
    EXPECT_NEAR(s.pose[1], 0, 1e-4);
    for (double rate : s.twist) EXPECT_NEAR(rate, 0, 1e-4);
    EXPECT_NEAR(s.rate[0], 0, 1e-3);
    EXPECT_NEAR(-impulse_on(s).x() / h, 2 * torque / radius, 0.05);  // action and reaction [N]
  }
}

TEST(Contact, StrongMotorsSpinTheirWheelsAtAWall) {
  const description::Robot smooth = changed([](auto& drive) { drive.friction = 0.2; });
  Fleet run({at_rest(0, 0, 0)}, smooth, Integrator::midpoint, coarse);
  run.among({wall(0.4, -1, 0.4, 1, 0.1)}, 0.3);
  for (int k = 0; k < 400; ++k) run.tick(coarse, {command(0.3, 0)});
  EXPECT_NEAR(run.states[0].pose[0], 0.35 - front, 1e-4);
  EXPECT_NEAR(run.states[0].rate[0] * radius, 0.3, 1e-3);
}

// Thrown against a wall with friction mu: the impulse m vn stops the normal speed, and reduces the tangential one by mu
// vn.
TEST(Contact, ImpactIsPlasticAndFrictionTakesItsShare) {
  const description::Robot sled = on_ice();
  for (double mu : {0.0, 0.1, 0.3}) {
    Fleet run({moving(0, 0, 0, 0.4, 0.5)}, sled, Integrator::midpoint, 0.002);
    run.among({wall(0.4, -5, 0.4, 5, 0.1)}, mu);
    for (int k = 0; k < 100; ++k) run.tick(coarse, {command(0, 0)});
    const RobotState& s = run.states[0];
    EXPECT_NEAR(s.twist[0], 0, 4e-3) << mu;                                 // no bounce
    EXPECT_NEAR(s.twist[1], 0.5 - mu * 0.4, 1e-3 + 0.02 * mu * 0.4) << mu;  // friction lifts a wheel a little
    EXPECT_NEAR(s.pose[0], 0.35 - front, 2e-3) << mu;
  }
}

// Of all robots, which have equal mass: for each kilogram of one [m/s].
Eigen::Vector3d momentum(const Fleet& run) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const RobotState& s : run.states)
    sum += velocity_of(s) + rates_of(s).cross(matrix_of(s) * whole_mass(scarab()).centre);
  return sum;
}

TEST(Contact, HeadOnMomentumIsKeptAndShared) {
  const description::Robot sled = on_ice();
  Fleet run({moving(0, 0, 0, 0.5, 0), moving(0.6, 0, M_PI, -0.1, 0)}, sled, Integrator::midpoint, coarse);
  for (int k = 0; k < 120; ++k) {
    run.tick(coarse, {command(0, 0), command(0, 0)});
    ASSERT_NEAR(momentum(run).x(), 0.4, 1e-12) << k;
  }
  EXPECT_NEAR(run.states[0].twist[0], 0.2, 1e-3);
  EXPECT_NEAR(run.states[1].twist[0], 0.2, 1e-3);
  EXPECT_NEAR(run.states[1].pose[0] - run.states[0].pose[0], 2 * front, 1e-3);
}

// The mass centres lie behind the frames whose velocities the step solves for: they are carried from step to step.
TEST(Contact, ObliqueImpactWithFrictionKeepsMomentum) {
  const description::Robot sled = on_ice();
  for (const double h : {coarse, 0.001}) {
    Fleet run({moving(0, 0, 0.3, 0.5, 0.1), moving(0.5, 0.11, 2, -0.3, 0)}, sled, Integrator::midpoint, h);
    bool turned = false;
    for (int k = 0; k < 100; ++k) {
      run.tick(coarse, {command(0, 0), command(0, 0)});
      ASSERT_LT((momentum(run).head<2>() - Eigen::Vector2d(0.2, 0.1)).norm(), 1e-12) << h << ' ' << k;
      turned = turned || std::abs(run.states[0].twist[5]) > 0.1;
    }
    EXPECT_TRUE(turned);
  }
}

TEST(Contact, RobotsThatTouchAtRestStayThere) {
  Fleet run({at_rest(0, 0, 0), at_rest(2 * front, 0, M_PI), at_rest(0, 0.24, 0)}, scarab(), Integrator::midpoint,
            coarse);
  run.among({wall(-0.15, -1, -0.15, 1, 0.1)}, 0.3);
  for (int k = 0; k < 1000; ++k) {
    run.tick(coarse, std::vector<Command>(3, command(0, 0)));
    for (const RobotState& s : run.states) {
      // They settle first; then the search leaves 1e-5 m/s, 1e-4 rad/s, now and then.
      for (int c = 0; k >= 50 && c < 6; ++c) ASSERT_NEAR(s.twist[c], 0, c < 3 ? 2e-5 : 2e-4) << k << ' ' << c;
    }
  }
  EXPECT_NEAR(run.states[0].pose[0], 0, 1e-5);
  EXPECT_NEAR(run.states[1].pose[0], 2 * front, 1e-5);
  for (const RobotState& s : run.states) EXPECT_NEAR(s.pose[2], 0, 1e-4);
}

// At 5 m/s a robot would tunnel through a thin wall within one step, and through a robot within three.
TEST(Contact, FastRobotsPassThroughNothing) {
  const description::Robot sled = on_ice();
  Fleet run({moving(0, 0, 0, 5, 0), moving(0, 1, 0, 5, 0), at_rest(0.6, 1, 0)}, sled, Integrator::midpoint, coarse);
  run.among({wall(1, -3, 1, 3, 0.02)}, 0.3);
  Trouble seen;
  for (int k = 0; k < 60; ++k) {
    run.tick(coarse, std::vector<Command>(3, command(0, 0)));
    seen.see(run.states, slabs(run.walls(), {}), coarse);
    ASSERT_LT(run.states[0].pose[0], 1 - front);
    ASSERT_LT(run.states[1].pose[0], run.states[2].pose[0] - front);
    ASSERT_LT(run.states[2].pose[0], 1 - front);
  }
  EXPECT_GT(run.states[2].pose[0], 0.7);  // it was hit
  EXPECT_LT(seen.deepest, 0.005);
}

TEST(Contact, StepIsDividedWhereAFastRobotIsNearOthers) {
  const description::Robot sled = on_ice();
  Fleet run({moving(0, 0, 0, 1.5, 0), moving(0, 5, 0, 1.5, 0), moving(0, 9, 0, 0.1, 0)}, sled, Integrator::midpoint,
            coarse);
  run.among({wall(0.2, -1, 0.2, 1, 0.1), wall(0.2, 8, 0.2, 10, 0.1)}, 0.3);
  run.tick(coarse, std::vector<Command>(3, command(0, 0)));
  EXPECT_EQ(run.states[0].memory.previous_step, coarse / 2);
  EXPECT_EQ(run.states[1].memory.previous_step, coarse);  // fast, but alone
  EXPECT_EQ(run.states[2].memory.previous_step, coarse);
}

// A body that seems deeper in another than possible is stepped in shorter steps, with only its contacts.
TEST(Contact, StepIsHalvedWhereBodiesBeganTooDeep) {
  constexpr double at_wall = 0.05;  // [m] the body ends 10 cm before the axle, the wall begins at 15 cm
  Fleet run({at_rest(at_wall + 1e-3, 0, 0), at_rest(at_wall + 2e-4, 0.3, 0)}, scarab(), Integrator::midpoint, coarse);
  run.among({wall(0.2, -1, 0.2, 1, 0.1)}, 0.3);
  run.tick(coarse, std::vector<Command>(2, command(0, 0)));
  EXPECT_EQ(run.states[0].memory.previous_step, coarse / 4);
  EXPECT_EQ(run.states[1].memory.previous_step, coarse);
  EXPECT_GT(run.states[0].pose[0], at_wall);  // on its way out, no farther
  EXPECT_LT(run.states[0].pose[0], at_wall + 0.8e-3);
}

// Half a step ahead, a corner that passes another by 8 mm in a step is not at its place of contact.
TEST(Contact, StepIsHalvedWhereCornersPassEachOther) {
  const description::Robot sled = on_ice();
  Fleet run({moving(0.0935, 0, 0, 0.8, 0), moving(0.0935, 5, 0, 0.8, 0)}, sled, Integrator::midpoint, coarse);
  run.among({wall(0.2, 0.1175, 0.2, 1, 0.1), wall(0.2, 5.15, 0.2, 6, 0.1)}, 0.3);
  run.tick(coarse, std::vector<Command>(2, command(0, 0)));
  EXPECT_EQ(run.states[0].memory.previous_step, coarse / 2);
  EXPECT_EQ(run.states[1].memory.previous_step, coarse);  // past a wall's end 3 cm off
}

TEST(Contact, TippedRobotLiesOnItsSide) {
  RobotState tipped = at_rest(0, 0, 0);
  tipped.pose = {0, 0, 0.2, std::cos(0.9), std::sin(0.9), 0, 0};  // rolled by 103 degrees
  Fleet run({tipped}, scarab(), Integrator::midpoint, 0.002);
  Trouble seen;
  for (int k = 0; k < 400; ++k) run.tick(coarse, {command(0, 0)});
  const RobotState& s = run.states[0];
  for (double rate : s.twist) EXPECT_NEAR(rate, 0, 1e-3);
  const Eigen::Matrix3d turned = Eigen::Quaterniond(s.pose[3], s.pose[4], s.pose[5], s.pose[6]).toRotationMatrix();
  EXPECT_LT(turned(2, 2), 0.2);
  // No part of its body is below the ground.
  const RobotModel model(scarab());
  EXPECT_GT(s.pose[2] + model.lowest_corner(turned.row(2)), -1e-3);
}

TEST(Contact, FarWallsAndRobotsChangeNoBit) {
  const auto wild = [](double t) { return command(0.4 + 0.5 * std::sin(2 * t), 2 * std::sin(3 * t)); };
  Fleet alone({rolling(0, 0, 0.3, 0.4, 0)}), beside({rolling(0, 0, 0.3, 0.4, 0), at_rest(4, 4, 0), at_rest(4.3, 4, 0)});
  beside.among({wall(-3, -3, -3, 3, 0.1), wall(3.8, 3, 3.8, 5, 0.1)}, 0.5);
  for (int k = 0; k < 100; ++k) {
    const Command c = wild(k * coarse);
    alone.tick(coarse, {c});
    beside.tick(coarse, {c, command(0.3, 0), command(-0.3, 0)});
  }
  expect_same_bits(alone.states[0], beside.states[0]);
}

Fleet jam(int count) {
  const double middle = 0.5 * spacing * (std::ceil(std::sqrt(count)) - 1);
  return Fleet(square(count, [&](int, double x, double y) { return std::atan2(middle - y, middle - x) + 0.1; }),
               scarab(), Integrator::midpoint, coarse);
}
std::vector<Command> inward(int count, int k) {
  return std::vector<Command>(count, command(0.4 * std::min(1.0, k / 50.0), 0.2));
}

TEST(Contact, JamHolds) {
  constexpr int count = 16;
  Fleet run = jam(count);
  Trouble seen;
  for (int k = 0; k < 300; ++k) {
    run.tick(coarse, inward(count, k));
    seen.see(run.states, slabs(run.walls(), {}), coarse);
  }
  EXPECT_LT(seen.deepest, 1e-3);
  EXPECT_LT(seen.rise, 0.3);
  int touching = 0;
  for (const RobotState& s : run.states) touching += s.memory.kept[0].id != 0;
  EXPECT_GT(touching, count / 3);
}

TEST(Contact, RemadeEngineGivesTheSameBitsInAJam) {
  constexpr int count = 9;
  Fleet straight = jam(count), remade = jam(count), forgetful = jam(count);
  for (int k = 0; k < 250; ++k) {
    straight.tick(coarse, inward(count, k));
    if (k % 7 == 3) remade.remake();
    remade.tick(coarse, inward(count, k));
    for (RobotState& s : forgetful.states) s.memory.kept = {};
    forgetful.tick(coarse, inward(count, k));
  }
  for (int i = 0; i < count; ++i) expect_same_bits(straight.states[i], remade.states[i]);
  EXPECT_NE(straight.states[0].pose, forgetful.states[0].pose);  // otherwise the memory would be no state
}

// The order in the world file changes rounding, the choice between two faces, and, where friction's bounds are still
// iterated, the end of the search: a jam that pushes for half a second differs by less than 1 mm.
TEST(Contact, OrderOfRobotsDoesNotMatter) {
  constexpr int count = 9;
  constexpr double both_err = 2 * 1e-5 * 80 * coarse;  // [m] by the residual velocity of a search
  for (double friction : {0.0, 0.3}) {
    Fleet run = jam(count), other = jam(count);
    run.among({}, friction);
    other.among({}, friction);
    std::reverse(other.states.begin(), other.states.end());
    int touching = 0;
    for (int k = 0; k < 80; ++k) {
      run.tick(coarse, inward(count, k));
      other.tick(coarse, inward(count, k));
      for (const RobotState& s : run.states) touching += s.memory.kept[0].id != 0;
    }
    for (int i = 0; i < count; ++i) {
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(run.states[i].pose[c], other.states[count - 1 - i].pose[c], friction > 0 ? 1e-3 : both_err) << i;
    }
    EXPECT_GT(touching, 10);
  }
}

TEST(Contact, CrowdNeitherOverlapsNorJumps) {
  constexpr int count = 25;
  for (uint64_t seed : {1, 2, 3}) {
    Fleet run(square(count, [&](int i, double, double) { return 6.28 * Stream(seed).uniform(1000 + i); }), scarab(),
              Integrator::midpoint, coarse);
    run.among(arena(count), 0.3);
    const RandomArcs arcs(seed);
    Trouble seen;
    int touching = 0;
    for (int k = 0; k < 400; ++k) {
      std::vector<Command> commands;
      for (int i = 0; i < count; ++i) commands.push_back(arcs.between(i, k * coarse, (k + 1) * coarse));
      run.tick(coarse, commands);
      seen.see(run.states, slabs(run.walls(), {}), coarse);
      for (const RobotState& s : run.states) touching += s.memory.kept[0].id != 0;
    }
    EXPECT_LT(seen.deepest, 1e-3) << seed;
    EXPECT_LT(seen.rise, 0.3) << seed;
    EXPECT_GT(touching, 500) << seed;  // it is a crowd
  }
}

}  // namespace
}  // namespace muster::simbody
