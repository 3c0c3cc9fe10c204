// Estimated and true places under physics with friction.
#include <gtest/gtest.h>

#include <cmath>

#include "robot_world.hpp"

namespace {

using namespace muster;
using namespace muster::test;

// The distance between the two after two rounds of a square of 3 m at 0.3 m/s, on wheels with this friction.
double gap(const std::string& friction) {
  Folder folder;
  const auto model = scarab_with(folder, {{"friction=\"0.8\"", "friction=\"" + friction + "\""}});
  Simulation run = world_of(folder,
                            "<robot name=\"r\" model=\"" + model.string() +
                                "\" at=\"0 0 0\"/><physics.simbody/><robots.drive/>"
                                "<control.waypoint name=\"c\" robot=\"r\" path=\"path.csv\" loop=\"true\"/>",
                            {{"path.csv", "x[m],y[m]\n3,0\n3,3\n0,3\n0,0\n"}}, "dt=\"0.02\" until=\"200\" seed=\"1\"");
  const auto reached = [&run] { return run.table("instance/c/progress").at(0, 1); };
  while (!run.done() && reached() < 8) run.step();
  EXPECT_EQ(reached(), 8);
  const auto believed = row<Odometry>(run, "robot/r/odometry");
  const auto place = row<Pose>(run, "robot/r/pose");
  return std::hypot(believed.x - place.x, believed.y - place.y);
}

TEST(Slip, OdometryIsTrueWhereWheelsHoldTheFloor) { EXPECT_LT(gap("0.8"), 0.001); }

TEST(Slip, AndDoesNotSeeThatTheySlip) { EXPECT_GT(gap("0.01"), 0.1); }

}  // namespace
