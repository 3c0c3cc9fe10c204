// Robots that follow a target: what they do without a sighting, and what they tell.
#include <gtest/gtest.h>

#include <cmath>

#include "plugins/tracking/sighting.hpp"
#include "tests/plugins/robots/robot_world.hpp"

namespace muster::test {
namespace {

// A scout 10 m east of its base, and a target further east.
Simulation followed(const Folder& folder, const std::string& sighting, const std::string& track,
                    const std::string& more = "") {
  return world_of(folder,
                  "<station name='base' at='0 0 1'/><robot name='scout' at='10 0 0'/><robot name='target' at='25 0 0'/>"
                  "<physics.planar/><robots.drive/><robots.odometry/><radio.multiwall l0='40' n='2'/><network.ideal/>"
                  "<sensors.sighting target='target' " +
                      sighting + "/><control.track robot='scout' base='base' obstacles='discs.csv' " + track + "/>" +
                      more,
                  {{"discs.csv", "x[m],y[m],radius[m]\n0,20,1\n"}});
}

double x_at(Simulation& run, double time) {
  while (run.time() < time - run.world().dt / 2) run.step();
  return row<Pose>(run, "robot/scout/pose").x;
}

// It stood still for ever where it had lost both.
TEST(Track, ARobotWithoutBaseAndTargetComesBack) {
  const Folder folder;
  Simulation aware = followed(folder, "range='5'", ""), unaware = followed(folder, "range='5'", "aware='false'");
  EXPECT_NEAR(x_at(aware, 2.9), 10, 0.01) << "the base has been silent for less than `lost`";
  EXPECT_LT(x_at(aware, 25), 5) << "0.4 m/s";
  EXPECT_NEAR(x_at(unaware, 25), 10, 0.01);
}

// The first was not later than time 0.
TEST(Track, TheFirstSightingIsTold) {
  const Folder folder;
  Simulation run = followed(folder, "period='0.5'", "");
  x_at(run, 0.4);
  EXPECT_EQ(row<Traffic>(run, "radio/scout/traffic").asked, 1);
  x_at(run, 1.4);
  EXPECT_EQ(row<Traffic>(run, "radio/scout/traffic").asked, 3);
}

// It was seen for ever where it had been last.
TEST(Track, ATargetThatHasLeftIsNotSeen) {
  const Folder folder;
  Simulation run = followed(folder, "period='0.5'", "", "<at t='2'><leave robot='target'/></at>");
  const auto seen = [&] { return row<tracking::Sighting>(run, "robot/scout/sighting").x; };
  x_at(run, 1.8);
  EXPECT_NEAR(seen(), 25, 5) << "with noise";
  x_at(run, 3);
  EXPECT_TRUE(std::isnan(seen()));
}

}  // namespace
}  // namespace muster::test
