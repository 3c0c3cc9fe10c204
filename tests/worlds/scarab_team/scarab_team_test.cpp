// worlds/scarab_team, reference [24] of the seed: a team of Scarabs by physics, against its odometry and against the
// simulation that the same laboratory publishes for teams of Scarabs. Sources of the figures are in the world's README.
#include <gtest/gtest.h>

#include <cmath>
#include <muster/tables.hpp>

#include "tests/backends.hpp"
#include "tests/run_world.hpp"

namespace muster::test {
namespace {

constexpr double laboratory_step = 1.0 / 50;                        // [s] of its simulation
constexpr double fastest_wheel = 0.8;                               // [m/s] its driver's max_wheel_vel
constexpr double wheel_base = 0.21;                                 // [m] the seed's Scarab
constexpr double pulse = 3.141592653589793 * 0.1 / (2000 * 38.35);  // [m] of its encoder along the ground
constexpr double commanded = 29.99;  // [s] 2,999 ticks begin before the command's end at 30 s

struct Task {
  const char* robot;
  double x, y, v, w;  // where it starts, towards the east, and what it is asked for: as in the world
};
constexpr Task tasks[] = {{"ahead", 0, 0, 0.16, 0},
                          {"left", 0, 2, 0.16, 0.1},
                          {"right", 0, -2, 0.16, -0.2},
                          {"spinner", -2, 0, 0, 1},
                          {"fast", 0, -6, 0.7, -0.5}};

struct Place {
  double x, y, yaw;
};

double between(const Place& a, const Place& b) { return std::hypot(a.x - b.x, a.y - b.y); }
double turn(double a, double b) { return std::abs(std::remainder(a - b, 2 * 3.141592653589793)); }

// One step of the laboratory's simulation: a unicycle, the sine and cosine of its turn to third order.
Place stepped(const Place& at, double v, double w, double dt) {
  const double ahead = v * (dt - w * w * dt * dt * dt / 6);
  const double aside = v * (w * dt * dt / 2 - w * w * w * dt * dt * dt * dt / 24);
  return {at.x + ahead * std::cos(at.yaw) - aside * std::sin(at.yaw),
          at.y + ahead * std::sin(at.yaw) + aside * std::cos(at.yaw), at.yaw + w * dt};
}

Place simulated_by_the_laboratory(const Task& task) {
  Place at{task.x, task.y, 0};
  double left = commanded;
  for (; left > laboratory_step; left -= laboratory_step) at = stepped(at, task.v, task.w, laboratory_step);
  return stepped(at, task.v, task.w, left);
}

class Team : public Simulation {
 public:
  explicit Team(const std::string& physics)
      : Simulation(read_world(std::filesystem::path(MUSTER_SOURCE_DIR) / "worlds/scarab_team", standard()), standard(),
                   {{MUSTER_PLUGINS_DIR}, 1, {}}) {
    if (physics != "physics.simbody") swap("physics", {physics, physics, 1, {}, {}, {}, {"test"}});
  }
  Place truth(const std::string& robot) const {
    const Pose p = row<Pose>(*this, "robot/" + robot + "/pose");
    return {p.x, p.y, 2 * std::atan2(p.qz, p.qw)};
  }
  Place odometry(const std::string& robot) const {
    const Odometry o = row<Odometry>(*this, "robot/" + robot + "/odometry");
    return {o.x, o.y, o.yaw};
  }
};

// After up to 21 m and up to five turns.
constexpr double place_bound = 0.0002, yaw_bound = 0.0002;  // [m], [rad]

class ScarabTeam : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Backends, ScarabTeam,
                         testing::ValuesIn(test::built({"physics.planar", "physics.simbody", "physics.ode",
                                                        "physics.mujoco"})),
                         [](const auto& made) { return std::string(made.param).substr(8); });

TEST_P(ScarabTeam, EndsWhereItsOdometryAndTheLaboratorysSimulationSay) {
  Team run(GetParam());
  double farthest = 0;
  while (!run.done()) {
    run.step();
    for (const Task& task : tasks)
      farthest = std::max(farthest, between(run.truth(task.robot), run.odometry(task.robot)));
  }
  EXPECT_LT(farthest, place_bound);
  for (const Task& task : tasks) {
    const Place end = run.truth(task.robot), theirs = simulated_by_the_laboratory(task);
    EXPECT_LT(between(end, theirs), place_bound) << task.robot;
    EXPECT_LT(turn(end.yaw, theirs.yaw), yaw_bound) << task.robot;
  }
}

// On the way a robot is late by the ramp that its steppers need: v / 2a seconds, and one tick for the command to
// arrive.
TEST(ScarabTeamOnTheWay, IsBehindTheUnicycleByItsRamp) {
  Team run("physics.simbody");
  constexpr double ramp = 2, tick = 0.01;  // [m/s2] at the rim, [s]
  while (run.time() < 20) run.step();
  for (const Task& task : tasks) {
    if (task.w != 0) continue;
    const double expected = task.v * (run.time() - tick - task.v / (2 * ramp));
    EXPECT_NEAR(run.truth(task.robot).x - task.x, expected, 0.002) << task.robot;
  }
}

TEST(ScarabTeamOnTheWay, RollsOnRadiiOfSpeedOverTurnRate) {
  Team run("physics.simbody");
  while (run.time() < 20) run.step();
  for (const Task& task : tasks) {
    if (task.w == 0 || task.v == 0) continue;
    const Twist t = row<Twist>(run, "robot/" + std::string(task.robot) + "/twist");
    const double radius = task.v / std::abs(task.w);
    EXPECT_NEAR(std::hypot(t.vx, t.vy) / std::abs(t.wz), radius, 0.001 * radius) << task.robot;
  }
}

// The figures of the world are within the laboratory's: no wheel is asked for more than its driver lets through. And
// the odometry errs by less than ten pulses of its encoder, so that a model of the encoder would change nothing that is
// told.
TEST(ScarabTeamOnTheWay, StaysWithinTheLaboratorysDriver) {
  Team run("physics.simbody");
  double fastest = 0, farthest = 0;
  while (!run.done()) {
    run.step();
    for (const Task& task : tasks) {
      const Wheels wheels = row<Wheels>(run, "robot/" + std::string(task.robot) + "/wheels");
      fastest = std::max({fastest, 0.05 * std::abs(wheels.left_rate), 0.05 * std::abs(wheels.right_rate)});
      farthest = std::max(farthest, between(run.truth(task.robot), run.odometry(task.robot)));
    }
  }
  EXPECT_NEAR(fastest, 0.7 + 0.5 * wheel_base / 2, 0.001);
  EXPECT_LT(fastest, fastest_wheel);
  EXPECT_LT(farthest, 10 * pulse);
}

}  // namespace
}  // namespace muster::test
