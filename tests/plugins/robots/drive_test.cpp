// robots.drive and robots.odometry between a command and wheels that follow exactly. The Scarab's wheels: radius 0.05
// m, base 0.21 m, at most 20 rad/s and 40 rad/s2.
#include <gtest/gtest.h>

#include <cmath>

#include "robot_world.hpp"

namespace {

using namespace muster;
using namespace muster::test;

constexpr double radius = 0.05, base = 0.21;

Simulation driven(const Folder& folder, const std::string& plan, const std::string& more = "",
                  const std::string& dt = "0.05") {
  return world_of(folder,
                  "<robot name=\"r\" at=\"1 2 0\" heading=\"0.5\"/><test.command robot=\"r\" plan=\"plan.csv\"/>"
                  "<test.turner/>" +
                      more + "<test.probe/>",
                  {{"plan.csv", "t[s],v[m/s],w[rad/s]\n" + plan}}, "dt=\"" + dt + "\" until=\"600\" seed=\"1\"");
}

TEST(Drive, RampsNoFasterThanItsAcceleration) {
  Folder folder;
  Simulation run = driven(folder, "0,0.5,0\n");
  double at_end = 0;
  for (int tick = 1; tick <= 10; ++tick) {
    run.step();
    const auto d = row<Drive>(run, "robot/r/drive");
    EXPECT_DOUBLE_EQ(d.left, at_end) << "begins where the last step ended";
    EXPECT_LE(std::abs(d.left_rate), 40 + 1e-9);
    EXPECT_EQ(d.left, d.right);
    at_end = d.left + d.left_rate * 0.05;
    EXPECT_NEAR(at_end, std::min(10.0, 2.0 * tick), 1e-12) << tick;
  }
}

TEST(Drive, SaturatesWithoutChangingTheTurningRadius) {
  Folder folder;
  Simulation run = driven(folder, "0,3,6\n");
  for (int tick = 0; tick < 40; ++tick) run.step();
  const auto d = row<Drive>(run, "robot/r/drive");
  EXPECT_NEAR(d.right, 20, 1e-12);
  const double v = (d.left + d.right) * radius / 2, w = (d.right - d.left) * radius / base;
  EXPECT_NEAR(v / w, 0.5, 1e-12);
}

TEST(Drive, ACommandFarBeyondItIsWarnedOfAlsoWhereItStepsEverySecondTick) {
  for (const char* every : {"1", "2"}) {
    Folder folder;
    Simulation run = driven(folder, "0,50,0\n", "<robots.drive every=\"" + std::string(every) + "\"/>");
    for (int tick = 0; tick < 6; ++tick) run.step();
    int warned = 0;
    for (const Event& event : run.events())
      warned += event.message.find("'r' is asked for 50 m/s, and its drive reaches 1 m/s") != std::string::npos;
    EXPECT_EQ(warned, 1) << every;
  }
}

TEST(Drive, NoiseHasTheDeclaredVariance) {
  Folder folder;
  Simulation run = driven(folder, "0,0.2,0.1\n", "<robots.drive noise=\"0.1\"/>");
  for (int tick = 0; tick < 20; ++tick) run.step();  // past the ramp
  const double left = (0.2 - 0.1 * base / 2) / radius, right = (0.2 + 0.1 * base / 2) / radius;
  double squares = 0, product = 0, lagged = 0, before = 0;
  constexpr int draws = 4000;
  for (int i = 0; i < draws; ++i) {
    run.step();
    const auto d = row<Drive>(run, "robot/r/drive");
    const double a = (d.left - left) / 0.1, b = (d.right - right) / 0.1;
    squares += a * a + b * b;
    product += a * b;
    lagged += a * before;
    before = a;
  }
  // Chi-square with 8000 degrees of freedom: sd 126.5; five sd, as for the two correlations.
  EXPECT_NEAR(squares, 2.0 * draws, 5 * std::sqrt(4.0 * draws));
  EXPECT_NEAR(product, 0, 5 * std::sqrt(draws)) << "the wheels' noises are independent";
  EXPECT_NEAR(lagged, 0, 5 * std::sqrt(draws)) << "and white";
}

TEST(Drive, AtRestHolds) {
  Folder folder;
  Simulation run = driven(folder, "100,1,0\n", "<robots.drive noise=\"0.1\"/>");
  for (int tick = 0; tick < 20; ++tick) run.step();
  EXPECT_EQ(row<Wheels>(run, "robot/r/wheels").left, 0);
}

TEST(OdometryTest, IsTheArcExactlyWithoutNoise) {
  Folder folder;
  Simulation run = driven(folder, "0,0.5,0.4\n");
  for (int tick = 0; tick < 200; ++tick) run.step();
  // The ramp keeps the ratio of the rates, so the whole path is one circle of radius v / w.
  const auto w = row<Wheels>(run, "robot/r/wheels");
  const double turned = (w.right - w.left) * radius / base;
  const auto o = row<Odometry>(run, "robot/r/odometry");
  EXPECT_NEAR(o.yaw, 0.5 + turned, 1e-12);
  EXPECT_NEAR(o.x, 1 + 0.5 / 0.4 * (std::sin(o.yaw) - std::sin(0.5)), 1e-11);
  EXPECT_NEAR(o.y, 2 - 0.5 / 0.4 * (std::cos(o.yaw) - std::cos(0.5)), 1e-11);
  EXPECT_NEAR(o.v, 0.5, 1e-12);
  EXPECT_NEAR(o.w, 0.4, 1e-12);
}

TEST(OdometryTest, StartsAtTheTruePose) {
  Folder folder;
  const Simulation run = driven(folder, "0,0,0\n");
  const auto o = row<Odometry>(run, "robot/r/odometry");
  EXPECT_EQ(o.x, 1);
  EXPECT_EQ(o.y, 2);
  EXPECT_DOUBLE_EQ(o.yaw, 0.5);
}

TEST(OdometryTest, SquareCloses) {
  Folder folder;
  // Four sides of 4 m and four turns on the spot, each command long enough to end its ramp: UMBmark's path (Borenstein
  // and Feng 1996). Every side and turn starts and ends at rest, so ramps shorten each equally.
  std::string plan;
  for (int side = 0; side < 4; ++side) {
    const double t = side * 12.0;
    plan += std::to_string(t) + ",0.5,0\n" + std::to_string(t + 8) + ",0,0\n" + std::to_string(t + 9) + ",0," +
            std::to_string(3.14159265358979324 / 4) + "\n" + std::to_string(t + 11) + ",0,0\n";
  }
  Simulation run = driven(folder, plan);
  double farthest = 0;
  for (int tick = 0; tick < 960; ++tick) {
    run.step();
    const auto o = row<Odometry>(run, "robot/r/odometry");
    farthest = std::max(farthest, std::hypot(o.x - 1, o.y - 2));
  }
  const auto o = row<Odometry>(run, "robot/r/odometry");
  EXPECT_NEAR(farthest, 4 * std::sqrt(2), 0.02);
  EXPECT_NEAR(o.x, 1, 1e-4);  // std::to_string gives six digits of the turn rate
  EXPECT_NEAR(o.y, 2, 1e-4);
  EXPECT_NEAR(o.yaw, 0.5 + 2 * 3.14159265358979324, 1e-4);
}

// The variance of the estimated path after 100 rad of both wheels, over robots that differ in name alone.
double variance_of_way(const std::string& dt, int robots) {
  Folder folder;
  std::string inside = "<test.turner/><robots.odometry noise=\"0.02\"/><test.probe/>";
  for (int i = 0; i < robots; ++i) {
    const auto name = std::to_string(i);
    inside += "<robot name=\"r" + name + "\" at=\"0 0 0\"/><test.command name=\"c" + name + "\" robot=\"r" + name +
              "\" plan=\"plan.csv\"/>";
  }
  Simulation run = world_of(folder, inside, {{"plan.csv", "t[s],v[m/s],w[rad/s]\n0,0.5,0\n"}},
                            "dt=\"" + dt + "\" until=\"600\" seed=\"3\"");
  while (run.time() < 10) run.step();
  double squares = 0;
  for (int i = 0; i < robots; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const auto o = row<Odometry>(run, "robot/*/odometry", at);
    const auto w = row<Wheels>(run, "robot/*/wheels", at);
    // The difference of the wheels' errors turns the robot: the clearest measure of the noise.
    const double turn_sd = 0.02 * std::sqrt(w.left + w.right) * radius / base;
    squares += o.yaw * o.yaw / (turn_sd * turn_sd);
  }
  return squares / robots;
}

TEST(OdometryTest, NoiseGrowsWithTheWayWhateverTheTick) {
  // Chi-square with 200 degrees of freedom has an sd of 20; four sd.
  EXPECT_NEAR(variance_of_way("0.1", 200), 1, 0.4);
  EXPECT_NEAR(variance_of_way("0.02", 200), 1, 0.4);
}

}  // namespace
