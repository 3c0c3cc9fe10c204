// Player's position2d beside velocities: goals, car-like commands, odometry that is set, geometry.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <sstream>

#include "robot_world.hpp"

namespace {

using namespace muster;
using namespace muster::test;

struct Arrived {
  double there, arrived;
};

// A robot at (1, 2), heading 0.5, with wheels that follow exactly, commanded by this plan.
Simulation asked(const Folder& folder, const std::string& what, const std::string& plan, const std::string& more) {
  return world_of(folder,
                  "<robot name=\"r\" at=\"1 2 0\" heading=\"0.5\"/><test.asks robot=\"r\" what=\"" + what +
                      "\" plan=\"plan.csv\"/><test.turner/><robots.drive/><robots.odometry/>" + more,
                  {{"plan.csv", "t[s],a,b,c\n" + plan}}, "dt=\"0.05\" until=\"600\" seed=\"1\"");
}

const std::string to_goals = "<control.goal2d name=\"c\" robot=\"r\"/>";

double time_of(const Simulation& run, double dt) { return static_cast<double>(run.tick()) * dt; }

void run_to(Simulation& run, double time) {
  while (time_of(run, 0.05) < time - 0.025) run.step();
}

TEST(Goal2d, IsReachedFromAnySideAndStoodAtAsAsked) {
  for (const auto& [x, y, yaw] : {std::array{3.0, 2.0, 1.0}, {-2.0, 1.0, -3.0}, {1.0, 4.0, 3.1}, {0.9, 2.0, 0.5}}) {
    Folder folder;
    std::ostringstream plan;
    plan << "0," << x << ',' << y << ',' << yaw << '\n';
    Simulation run = asked(folder, "goal2d", plan.str(), to_goals);
    while (!run.done() && row<Arrived>(run, "instance/c/arrived").arrived == 0) run.step();
    ASSERT_FALSE(run.done());
    run.step();  // the commands of that tick are done
    EXPECT_LT(std::abs(std::remainder(row<Odometry>(run, "robot/r/odometry").yaw - yaw, 6.283185307179586)), 0.011);
    run_to(run, time_of(run, 0.05) + 20);
    const auto at = row<Odometry>(run, "robot/r/odometry");
    EXPECT_LT(std::hypot(at.x - x, at.y - y), 0.01);
    EXPECT_LT(std::abs(std::remainder(at.yaw - yaw, 6.283185307179586)), 0.01);
    EXPECT_LT(std::abs(at.v), 1e-6);
    EXPECT_LT(std::abs(at.w), 1e-6);
  }
}

// Straight ahead it drives at its speed, and from speed / slow_gain on its distance falls exponentially.
TEST(Goal2d, TakesTheTimeThatItsLawSays) {
  Folder folder;
  Simulation run = world_of(folder,
                            "<robot name=\"r\" at=\"1 2 0\"/><test.asks robot=\"r\" what=\"goal2d\" plan=\"plan.csv\"/>"
                            "<control.goal2d name=\"c\" robot=\"r\" speed=\"0.3\" slow_gain=\"1\" tolerance=\"0.01\"/>"
                            "<test.turner/><robots.drive/><robots.odometry/>",
                            {{"plan.csv", "t[s],a,b,c\n0,5,2,\n"}}, "dt=\"0.01\" until=\"60\" seed=\"1\"");
  while (!run.done() && row<Arrived>(run, "instance/c/arrived").arrived == 0) run.step();
  const double ramp = 0.3 / 2 / 2;  // at 2 m/s2
  EXPECT_NEAR(time_of(run, 0.01), ramp + (4 - 0.3) / 0.3 + std::log(0.3 / 0.01), 0.1);
}

// Once there, it starts again when it is beyond twice the tolerance, and not before; a new goal is approached like any
// other.
TEST(Goal2d, SetsOutAgainFromBeyondTwiceItsTolerance) {
  const auto moves = [](const std::string& goals, const std::string& resets) {
    Folder folder;
    folder.write("resets.csv", "t[s],a,b,c\n" + resets);
    Simulation run =
        asked(folder, "goal2d", goals,
              "<control.goal2d name=\"c\" robot=\"r\" tolerance=\"0.1\"/><test.asks name=\"other\" robot=\"r\" "
              "what=\"odometry_reset\" plan=\"resets.csv\"/>");
    run_to(run, 10);
    EXPECT_EQ(row<Arrived>(run, "instance/c/arrived").there, 1);
    run_to(run, 10.3);
    return row<Arrived>(run, "instance/c/arrived").there == 0;
  };
  EXPECT_FALSE(moves("0,1,2,\n", "10.01,1.15,2,0\n"));
  EXPECT_TRUE(moves("0,1,2,\n", "10.01,1.25,2,0\n"));
  EXPECT_TRUE(moves("0,1,2,\n10.01,1.15,2,\n", ""));
}

TEST(Goal2d, WithoutAGoalItStands) {
  Folder folder;
  Simulation run = asked(folder, "goal2d", "0,2,2,\n3,,,\n", to_goals);
  run_to(run, 4);
  const auto at = row<Odometry>(run, "robot/r/odometry");
  EXPECT_GT(at.x, 1.2);
  EXPECT_EQ(at.v, 0);
  EXPECT_EQ(row<Arrived>(run, "instance/c/arrived").there, 0);
  run_to(run, 10);
  EXPECT_EQ(row<Odometry>(run, "robot/r/odometry").x, at.x);
}

TEST(Car, TurnsAboutTheCentreOfItsAxles) {
  Folder folder;
  Simulation run = asked(folder, "car_command", "0,0.4,0.3,\n", "<control.car robot=\"r\" wheel_base=\"0.5\"/>");
  run_to(run, 2);
  const double radius = 0.5 / std::tan(0.3);
  const auto a = row<Odometry>(run, "robot/r/odometry");
  EXPECT_NEAR(a.v / a.w, radius, 1e-9);
  run_to(run, 2 + 3.141592653589793 * radius / 0.4);  // half a round
  const auto b = row<Odometry>(run, "robot/r/odometry");
  EXPECT_NEAR(std::hypot(b.x - a.x, b.y - a.y), 2 * radius, 0.01);
}

TEST(Car, SteersNoFurtherThanItCanAndDoesNotTurnStanding) {
  Folder folder;
  Simulation run = asked(folder, "car_command", "0,0,0.3,\n2,0.4,1.5,\n5,-0.4,-1.5,\n",
                         "<control.car robot=\"r\" wheel_base=\"0.5\" max_steering=\"0.4\"/>");
  run_to(run, 2);
  EXPECT_EQ(row<Odometry>(run, "robot/r/odometry").yaw, 0.5);
  run_to(run, 4);
  EXPECT_NEAR(row<Odometry>(run, "robot/r/odometry").w, 0.4 * std::tan(0.4) / 0.5, 1e-9);
  run_to(run, 7);
  EXPECT_NEAR(row<Odometry>(run, "robot/r/odometry").w, 0.4 * std::tan(0.4) / 0.5, 1e-9) << "backwards to the right";
}

// At each request, and once for each; from there on it counts as before.
TEST(OdometryIsSet, WhenAskedTo) {
  Folder folder;
  const std::string steady = "<test.command robot=\"r\" plan=\"steady.csv\"/>";
  folder.write("steady.csv", "t[s],v[m/s],w[rad/s]\n0,0.3,0.2\n");
  Simulation run = asked(folder, "odometry_reset", "2,10,20,1\n4,0,0,0\n", steady);
  run_to(run, 2);
  EXPECT_GT(row<Odometry>(run, "robot/r/odometry").x, 1.3);
  run.step();
  const auto set = row<Odometry>(run, "robot/r/odometry");
  EXPECT_EQ(set.x, 10);
  EXPECT_EQ(set.y, 20);
  EXPECT_EQ(set.yaw, 1);
  EXPECT_NEAR(set.v, 0.3, 1e-9);
  run_to(run, 3.05);
  const auto on = row<Odometry>(run, "robot/r/odometry");
  EXPECT_NEAR(on.yaw, 1.2, 1e-9);
  EXPECT_NEAR(std::hypot(on.x - 10, on.y - 20), 2 * 1.5 * std::sin(0.1), 1e-9);
  run_to(run, 4.05);
  EXPECT_EQ(row<Odometry>(run, "robot/r/odometry").x, 0);
  run_to(run, 5);
  EXPECT_GT(row<Odometry>(run, "robot/r/odometry").x, 0.2);
}

// Restored in the middle, or with every instance remade again and again, a run has the same bits.
TEST(Position2d, KeepsItsStateOnTheBlackboard) {
  Folder folder;
  folder.write("goals.csv", "t[s],a,b,c\n0,2,2.5,1\n2.5,1,1,\n");
  folder.write("resets.csv", "t[s],a,b,c\n1,10,20,1\n2.2,0,0,0\n");
  const auto made = [&] {
    return world_of(
        folder,
        "<robot name=\"r\" at=\"1 2 0\"/><robot name=\"q\" at=\"5 2 0\"/><robot name=\"h\" model=\"rdk\" at=\"9 2 0\"/>"
        "<test.asks name=\"goals\" robot=\"r\" what=\"goal2d\" plan=\"goals.csv\"/><control.goal2d robot=\"r\"/>"
        "<test.asks name=\"resets\" robot=\"q\" what=\"odometry_reset\" plan=\"resets.csv\"/>"
        "<control.steady name=\"a\" robot=\"q\" v=\"0.2\" w=\"0.3\"/><control.steady name=\"b\" robot=\"h\" v=\"0.1\"/>"
        "<physics.simbody/><robots.odometry noise=\"0.02\"/><robots.geometry/>",
        {}, "dt=\"0.02\" until=\"4\" seed=\"1\"");
  };
  Simulation straight = made();
  while (straight.tick() < 90) straight.step();
  straight.snapshot().save(folder / "then");
  while (!straight.done()) straight.step();
  Simulation restored = made();
  restored.restore(Snapshot::load(folder / "then"));
  while (!restored.done()) restored.step();
  EXPECT_EQ(restored.digest(), straight.digest());
  Simulation remade = made();
  std::vector<std::string> names;
  for (const auto& instance : remade.instances()) names.push_back(instance->name());
  while (!remade.done()) {
    if (remade.tick() % 17 == 5) {
      for (const std::string& name : names) remade.remake(name);
    }
    remade.step();
  }
  EXPECT_EQ(remade.digest(), straight.digest());
}

TEST(RobotGeometry, IsTheBoxThatARobotFills) {
  Folder folder;
  Simulation run = world_of(folder,
                            "<robot name=\"s\" at=\"0 0 0\"/><robot name=\"h\" model=\"rdk\" at=\"3 0 0\"/>"
                            "<robot name=\"c\" model=\"crate\" at=\"6 0 0\"/><physics.simbody/><robots.geometry/>");
  run.step();
  const auto scarab = row<Geometry>(run, "robot/s/geometry");
  EXPECT_NEAR(scarab.length, 0.2, 1e-9);
  EXPECT_NEAR(scarab.width, 0.23, 1e-9) << "0.21 m between the wheels' middles, which are 2 cm wide";
  EXPECT_NEAR(scarab.z + scarab.height / 2, 0.222, 1e-9);
  EXPECT_NEAR(scarab.z - scarab.height / 2, 0, 1e-9) << "it stands on the ground";
  const auto rdk = row<Geometry>(run, "robot/h/geometry");
  EXPECT_NEAR(rdk.length, 0.35 + 0.025, 1e-9) << "its hind legs bulge beyond its body";
  EXPECT_NEAR(rdk.z - rdk.height / 2, 0, 1e-9) << "on its legs";
  const auto crate = row<Geometry>(run, "robot/c/geometry");
  EXPECT_NEAR(crate.x, 0, 1e-12);
  EXPECT_NEAR(crate.z, 0.125, 1e-12);
  EXPECT_NEAR(crate.width, 0.3, 1e-12);
}

}  // namespace
