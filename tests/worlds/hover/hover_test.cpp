// worlds/hover: how still a Hummingbird stands in the air, and how near it flies to a square, on each backend.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "plugins/controllers/timed_path.hpp"
#include "tests/backends.hpp"
#include "tests/run_world.hpp"

namespace muster::test {
namespace {

InstanceDeclaration plugin(const std::string& id, const std::vector<std::pair<std::string, std::string>>& more = {}) {
  InstanceDeclaration result{id, id, 1, {}, {}, {}, {"test"}};
  for (const auto& [name, value] : more) result.attributes.push_back({name, value, {"test"}, {"test"}});
  return result;
}

class Hover : public Simulation {
 public:
  explicit Hover(const std::string& physics = "physics.simbody")
      : Simulation(read_world(std::filesystem::path(MUSTER_SOURCE_DIR) / "worlds/hover", standard()), standard(),
                   {{MUSTER_PLUGINS_DIR}, 1, {}}) {
    if (physics != "physics.simbody") swap("physics", plugin(physics));
  }
  void run_to(double time) {
    while (this->time() < time - 1e-9) step();
  }
  Pose pose(const std::string& robot) const { return row<Pose>(*this, "robot/" + robot + "/pose"); }
  Twist twist(const std::string& robot) const { return row<Twist>(*this, "robot/" + robot + "/twist"); }
};

double speed(const Twist& t) { return std::hypot(t.vx, t.vy, t.vz); }

class OnEach : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Backends, OnEach,
                         testing::ValuesIn(test::built({"physics.simbody", "physics.ode", "physics.mujoco"})),
                         [](const auto& made) { return std::string(made.param).substr(8); });

TEST_P(OnEach, HoversWithoutDrift) {
  Hover run(GetParam());
  run.run_to(8);
  double farthest = 0;
  while (run.time() < 12) {
    run.step();
    const Pose p = run.pose("still");
    farthest = std::max(farthest, std::hypot(p.x, p.y + 2, p.z - 1));
  }
  EXPECT_LT(farthest, 0.0005);
  EXPECT_LT(speed(run.twist("still")), 0.001);
}

// Where the way is at the time, see the world.
Reference square(double t) {
  static const std::vector<WayPoint3d> points = {{0, 1, 0.06}, {0, 1, 1}, {1, 1, 1}, {1, 2, 1}, {0, 2, 1}, {0, 1, 1}};
  return timed_path(points, t - 0.5, 1, 3, 0.5, false);
}

TEST_P(OnEach, FliesTheSquareWithinTwoCentimetres) {
  Hover run(GetParam());
  double farthest = 0, off_plane = 0, fastest = 0;
  while (!run.done()) {
    run.step();
    const Pose p = run.pose("square");
    const Reference way = square(run.time());
    const double off = std::hypot(p.x - way.place[0], p.y - way.place[1], p.z - way.place[2]);
    farthest = std::max(farthest, off);
    if (run.time() < 2.8) continue;  // it has climbed
    off_plane = std::max(off_plane, std::abs(p.z - 1));
    fastest = std::max(fastest, speed(run.twist("square")));
  }
  EXPECT_LT(farthest, 0.02);
  EXPECT_LT(off_plane, 0.008);
  EXPECT_NEAR(fastest, 1, 0.05);
  const Pose end = run.pose("square");
  EXPECT_LT(std::hypot(end.x, end.y - 1, end.z - 1), 0.01);
}

// The loop along one side as small angles have it: position and velocity controllers and the attitude's, sampled every
// 10 ms and held, on a body that rotors of one lag tilt and drag.
class LinearLoop {
 public:
  double x() const { return x_; }

  // Over one tick from `t` with the way's place, velocity and, later, acceleration.
  void tick(double place, double velocity, double later_acceleration) {
    const double speed_asked = velocity + 2 * (place - x_);
    const double tilt_asked =
        (4 * (speed_asked - v_) + 1 * speed_sum_ + later_acceleration + drag * speed_asked) / gravity;
    const double turn_asked = 196 * (tilt_asked - tilt_) + 20 * tilt_sum_ - 22.4 * rate_;
    speed_sum_ += dt * (speed_asked - v_);
    tilt_sum_ += dt * (tilt_asked - tilt_);
    constexpr int parts = 100;
    constexpr double h = dt / parts;
    for (int k = 0; k < parts; ++k) {
      turn_ += h / lag * (turn_asked - turn_);
      rate_ += h * turn_;
      tilt_ += h * rate_;
      v_ += h * (gravity * tilt_ - drag * v_);
      x_ += h * v_;
    }
  }

 private:
  static constexpr double dt = 0.01, gravity = 9.81;
  static constexpr double lag = (0.0125 + 0.025) / 2;  // one rotor of a pair speeds up while the other slows down
  static constexpr double mass = 0.716, drag = 4 * 453.3 * 8.06428e-5 / mass;
  double x_ = 0, v_ = 0, tilt_ = 0, rate_ = 0, turn_ = 0, speed_sum_ = 0, tilt_sum_ = 0;
};

TEST(Square, ItsFirstSideIsThatOfTheLinearLoop) {
  Hover run;
  run.run_to(2.5);
  LinearLoop loop;
  double farthest = 0, off_the_way = 0;
  while (run.time() < 4.6) {
    const double t = run.time();
    loop.tick(square(t).place[0], square(t).velocity[0], square(t + 0.12).acceleration[0]);
    run.step();
    farthest = std::max(farthest, std::abs(run.pose("square").x - loop.x()));
    off_the_way = std::max(off_the_way, std::abs(loop.x() - square(run.time()).place[0]));
  }
  EXPECT_LT(farthest, 0.005);
  EXPECT_GT(off_the_way, 0.01);  // there is something to predict
}

template <class Row>
bool same_bits(const Row& a, const Row& b) {
  return std::memcmp(&a, &b, sizeof(Row)) == 0;
}

TEST(Hovering, SwapsOfTheBackendKeepEveryBitAndTheHeight) {
  Hover run;
  for (const char* to : {"physics.ode", "physics.simbody", "physics.ode"}) {
    run.run_to(run.time() + 3);
    const auto pose = run.pose("square");
    const auto twist = run.twist("square");
    const auto rotors = row<Rotors>(run, "robot/square/rotors");
    ASSERT_GT(rotors.front, 300);
    run.swap("physics", plugin(to, {{"step", "0.01"}}));
    EXPECT_TRUE(same_bits(pose, run.pose("square"))) << to;
    EXPECT_TRUE(same_bits(twist, run.twist("square"))) << to;
    EXPECT_TRUE(same_bits(rotors, row<Rotors>(run, "robot/square/rotors"))) << to;
  }
  run.run_to(12);
  EXPECT_NEAR(run.pose("still").z, 1, 0.005);
  EXPECT_NEAR(run.pose("square").z, 1, 0.01);
}

TEST(Hovering, APlaneIsRefusedWithTheListOfWhatItLacks) {
  Hover run;
  run.run_to(1);
  const auto before = run.digest();  // NOLINT(clang-analyzer-deadcode.DeadStores): read after the exception
  try {
    run.swap("physics", plugin("physics.planar"));
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.exit(), Exit::invalid_input);
    EXPECT_THAT(error.what(), testing::EndsWith("it lacks what the world's robots need: robot 'still' (model "
                                                "'hummingbird') needs rotors (<quadrotor>), changes of height, roll "
                                                "and pitch; expected physics.simbody, which has that"));
  }
  EXPECT_EQ(run.digest(), before);
  run.run_to(1.1);  // the old backend goes on
}

// Cameras as good as those of motion capture: 1 mm, 0.01 rad, 2 cm/s.
TEST(Hovering, StandsStillByNoisyCameras) {
  Hover run;
  run.swap("cameras", plugin("robots.mocap", {{"place", "0.001"}, {"angle", "0.01"}, {"speed", "0.02"}}));
  run.run_to(6);
  double sum = 0;
  int count = 0;
  for (; run.time() < 12; ++count) {
    run.step();
    const Pose p = run.pose("still");
    const double off = std::hypot(p.x, p.y + 2, p.z - 1);
    EXPECT_LT(off, 0.05);
    sum += off * off;
  }
  EXPECT_LT(std::sqrt(sum / count), 0.004);
  EXPECT_GT(std::sqrt(sum / count), 1e-4);
}

}  // namespace
}  // namespace muster::test
