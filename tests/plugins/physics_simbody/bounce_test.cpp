// Robots that bounce, against closed forms and conservation laws.
#include <optional>

#include "benchmarks/crowds.hpp"
#include "motion.hpp"
#include "scarabs.hpp"

namespace muster::simbody {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double front = 0.1;  // of a Scarab's body before its axle [m]

description::Robot elastic(const std::string& model, double restitution) {
  description::Robot robot =
      description::read_robot(MUSTER_SOURCE_DIR "/plugins/robots/models/" + model + ".urdf", description::Meshes::skip);
  robot.restitution = restitution;
  return robot;
}
description::Robot elastic_sled(double restitution) {
  description::Robot robot = elastic("scarab", restitution);
  robot.drive->friction = 0;
  return robot;
}

RobotState moving(double x, double y, double heading, double vx, double vy) {
  RobotState s = at_rest(x, y, heading);
  s.twist = {vx, vy, 0, 0, 0, 0};
  return s;
}

// Successive highest points, dropped flat from `height` above its rest position, in steps of h.
std::vector<double> apexes(const description::Robot& robot, double ground, double height, double h, std::size_t count) {
  RobotState start = at_rest(0, 0, 0.3);
  start.pose[2] = ground + height;
  Fleet run({start}, robot, Integrator::midpoint, h);
  std::vector<double> result;
  double before = start.pose[2];
  bool rises = false;
  for (int k = 0; k < 4 / h && result.size() < count; ++k) {
    run.tick(h, {Command{}});
    const double now = run.states[0].pose[2];
    if (rises && now < before) result.push_back(before - ground);
    rises = now > before;
    before = now;
  }
  return result;
}

TEST(Bounce, RisesBySquareOfRestitution) {
  for (const double e : {0.5, 0.9, 1.0}) {
    for (const double h : {0.001, 0.01}) {
      const double seen_by_steps = gravity * h * h / 8;
      for (const auto& heights :
           {apexes(elastic("scarab", e), 0, 1, h, 3), apexes(elastic("hummingbird", e), 0.06, 1, h, 3)}) {
        ASSERT_EQ(heights.size(), 3u) << e << ' ' << h;
        for (int n = 0; n < 3; ++n)
          EXPECT_NEAR(heights[n], std::pow(e, 2 * (n + 1)), seen_by_steps + 1e-5) << e << ' ' << h;
      }
    }
  }
}

// Kinetic and potential energy in free flight, where velocities are those of the instant.
std::optional<double> energy(const description::Robot& robot, const RobotState& s) {
  if (s.memory.previous_step > 0) return std::nullopt;
  const auto whole = whole_mass(robot);
  const Vector3d arm = matrix_of(s) * whole.centre, own = matrix_of(s).transpose() * rates_of(s);
  return 0.5 * whole.mass * (velocity_of(s) + rates_of(s).cross(arm)).squaredNorm() +
         0.5 * own.dot(whole.inertia * own) + whole.mass * gravity * (s.pose[2] + arm.z());
}

description::Robot elastic_box(double restitution) {
  description::Robot robot = elastic("hummingbird", restitution);
  for (std::size_t rotor = 1; rotor < robot.links.size(); ++rotor) robot.links[rotor].shapes.clear();
  return robot;
}

// Thrown so that it lands on a corner: its successive energies in the air.
std::vector<double> energies_of_tumbling(const description::Robot& robot, double friction, int seed) {
  RobotState start = at_rest(0, 0, 0);
  const Quaterniond q(Eigen::AngleAxisd(0.3 + seed, Vector3d(1, 0.4 * seed, 0.2).normalized()));
  start.pose = {0, 0, 1, q.w(), q.x(), q.y(), q.z()};
  start.twist = {1, 0.3, 0, 2.0 * seed, 1, -1};
  Fleet run({start}, robot, Integrator::midpoint, 0.001);
  run.among({}, friction);
  std::vector<double> result;
  for (int k = 0; k < 3000; ++k) {
    run.tick(0.001, {Command{}});
    if (const auto now = energy(robot, run.states[0])) result.push_back(*now);
  }
  return result;
}

TEST(Bounce, TumblingLosesNoEnergyWithoutFrictionAndGainsNoneWithIt) {
  for (int seed = 0; seed < 4; ++seed) {
    const std::vector<double> kept = energies_of_tumbling(elastic_box(1), 0, seed);
    for (const double now : kept) ASSERT_NEAR(now, kept.front(), 0.005 * kept.front()) << seed;
    for (const double e : {0.5, 0.9, 1.0}) {
      const std::vector<double> lost = energies_of_tumbling(elastic_box(e), 1, seed);
      for (std::size_t k = 1; k < lost.size(); ++k) ASSERT_LT(lost[k], 1.0002 * lost[k - 1]) << e << ' ' << seed;
      EXPECT_LT(lost.back(), 0.97 * lost.front()) << e << ' ' << seed;
    }
  }
}

TEST(Bounce, HeadOnRobotsPartWithTheirShareOfSpeed) {
  for (const double e : {0.3, 1.0}) {
    const description::Robot sled = elastic_sled(e);
    Fleet run({moving(0, 0, 0, 0.5, 0), moving(0.6, 0, M_PI, -0.1, 0)}, sled, Integrator::midpoint, 0.01);
    for (int k = 0; k < 120; ++k) {
      run.tick(0.01, {command(0, 0), command(0, 0)});
    }
    EXPECT_NEAR(run.states[0].twist[0], 0.2 - 0.3 * e, 1e-3);
    EXPECT_NEAR(run.states[1].twist[0], 0.2 + 0.3 * e, 1e-3);
  }
}

// Two Hummingbirds that meet in the air, not quite head on.
TEST(Bounce, MomentumIsKeptInTheAir) {
  const description::Robot robot = elastic("hummingbird", 0.8);
  RobotState a = moving(0, 0, 0, 1, 0), b = moving(1, 0.12, 3.5, -0.6, 0.2);
  a.pose[2] = b.pose[2] = 50;
  Fleet run({a, b}, robot);
  const auto momentum = [&](std::size_t i) -> Vector3d {
    const RobotState& s = run.states[i];
    return velocity_of(s) + rates_of(s).cross(matrix_of(s) * whole_mass(robot).centre);
  };
  const Vector3d alone = momentum(0), both = alone + momentum(1);
  for (int k = 0; k < 100; ++k) run.tick(0.01, {Command{}, Command{}});
  EXPECT_LT((momentum(0) + momentum(1) - both).head<2>().norm(), 1e-12);
  EXPECT_GT((momentum(0) - alone).head<2>().norm(), 0.5);  // they did meet
}

TEST(Bounce, OfTwoTheLessElasticDecides) {
  const description::Robot elastic = elastic_sled(1), half = elastic_sled(0.5), plastic = elastic_sled(0);
  for (const auto* other : {&half, &plastic}) {
    const auto engine = make_engine({{"a", &elastic}, {"b", other}}, Integrator::midpoint, 0.001);
    engine->set_surroundings({}, 0.3);
    std::vector<RobotState> states{moving(0, 0, 0, 0.4, 0), moving(0.3, 0, M_PI, 0, 0)};
    for (int k = 0; k < 50; ++k) engine->step(0.01, {command(0, 0), command(0, 0)}, states);
    EXPECT_NEAR(states[1].twist[0] - states[0].twist[0], 0.4 * other->restitution, 5e-3);
  }
}

// The impulse (1 + e) m vn reverses the normal speed, and friction reduces the tangential one.
TEST(Bounce, WallsReflectAndFrictionTakesItsShare) {
  for (const double mu : {0.0, 0.1}) {
    const double e = 0.6;
    const description::Robot sled = elastic_sled(e);
    Fleet run({moving(0, 0, 0, 0.4, 0.5)}, sled, Integrator::midpoint, 0.002);
    run.among({wall(0.4, -5, 0.4, 5, 0.1)}, mu);
    double farthest = 0;
    for (int k = 0; k < 100; ++k) {
      run.tick(0.01, {command(0, 0)});
      farthest = std::max(farthest, run.states[0].pose[0]);
    }
    EXPECT_LT(farthest, 0.35 - front + 1e-6);
    EXPECT_NEAR(run.states[0].twist[0], -0.4 * e, 1e-3);
    EXPECT_NEAR(run.states[0].twist[1], 0.5 - mu * (1 + e) * 0.4, 1e-3);
  }
}

// Of its body alone: legs continue to swing in their hips, and pull at it from then on.
TEST(Bounce, AHexapodBouncesOffAWall) {
  description::Robot robot = elastic("rdk", 0.5);
  robot.legs->max_torque = 1e-9;
  RobotState start = moving(0, 0, 0, 1, 0);
  start.pose[2] = 3;
  Fleet run({start}, robot);
  run.among({{0.5, -2, 0.5, 2, 0, 5, 0.1, 0}}, 0);
  for (int k = 0; k < 400; ++k) {
    run.tick(0.001, {Command{}});
    ASSERT_LT(run.states[0].pose[0], 0.45 - 0.175 + 1e-5) << k;
    if (run.states[0].twist[0] > 0) continue;
    EXPECT_NEAR(run.states[0].twist[0], -0.5, 0.01);
    return;
  }
  FAIL() << "it did not come back";
}

TEST(Bounce, StandsAndDrivesWithTheBitsOfPlasticRobots) {
  const auto driven = [](double e) {
    const description::Robot robot = elastic("scarab", e);
    Fleet run({at_rest(0, 0, 0), at_rest(2, 0, 1)}, robot, Integrator::midpoint, 0.01);
    run.drive(2, 0.01, [](double t) { return command(0.2 * t, std::sin(3 * t)); });
    return run.states;
  };
  const auto plastic = driven(0), bouncing = driven(0.9);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(plastic[i].pose, bouncing[i].pose);
    EXPECT_EQ(plastic[i].twist, bouncing[i].twist);
  }
}

// A crowd of elastic robots, in ticks of some steps, remade now and then.
TEST(Bounce, LongTicksAndRemadeEnginesGiveTheSameBits) {
  const auto after = [](double tick, bool remade) {
    std::vector<RobotState> start;
    for (int i = 0; i < 9; ++i) {
      const int column = i % 3, row = i / 3;
      start.push_back(moving(0.4 * column, 0.4 * row, i, 0.6 - 0.4 * column, 0.4 - 0.3 * row));
    }
    const description::Robot sled = elastic_sled(0.8);
    Fleet run(start, sled, Integrator::midpoint, 0.005);
    run.among({wall(-0.4, -2, -0.4, 2, 0.1), wall(1.2, -2, 1.2, 2, 0.1)}, 0.3);
    for (int k = 0; k < std::lround(1 / tick); ++k) {
      if (remade && k % 7 == 3) run.remake();
      run.tick(tick, std::vector<Command>(9, command(0, 0)));
    }
    return run.states;
  };
  const auto straight = after(0.005, false);
  for (const auto& other : {after(0.02, false), after(0.005, true)}) {
    for (std::size_t i = 0; i < 9; ++i) {
      EXPECT_EQ(straight[i].pose, other[i].pose) << i;
      EXPECT_EQ(straight[i].twist, other[i].twist) << i;
    }
  }
}

TEST(Bounce, CrowdNeitherOverlapsNorJumps) {
  constexpr int count = 25;
  const description::Robot robot = elastic("scarab", 0.5);
  for (uint64_t seed : {1, 2}) {
    Fleet run(square(count, [&](int i, double, double) { return 6.28 * Stream(seed).uniform(1000 + i); }), robot,
              Integrator::midpoint, 0.01);
    run.among(arena(count), 0.3);
    const RandomArcs arcs(seed);
    Trouble seen;
    for (int k = 0; k < 400; ++k) {
      std::vector<Command> commands;
      for (int i = 0; i < count; ++i) commands.push_back(arcs.between(i, k * 0.01, (k + 1) * 0.01));
      run.tick(0.01, commands);
      seen.see(run.states, slabs(run.walls(), {}), 0.01);
    }
    EXPECT_LT(seen.deepest, 1e-3) << seed;
    EXPECT_LT(seen.rise, 0.3) << seed;
  }
}

TEST(Bounce, SimbodysOwnIntegratorsRefuseIt) {
  const description::Robot robot = elastic("scarab", 0.5);
  try {
    Fleet run({at_rest(0, 0, 0)}, robot, Integrator::rk3);
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()),
              "robot 'r0' bounces; Simbody's own integrators keep wheels on the ground: use midpoint");
  }
}

}  // namespace
}  // namespace muster::simbody
