// Files of other programs given as a world or as readings.
#include <gmock/gmock.h>

#include "tests/cli/errors/program.hpp"

using namespace muster::test;

namespace {

void expect_refused(const std::string& text, const std::string& message) {
  const ProgramFolder folder;
  folder.write("world.xml", text);
  expect_error(folder.muster({"check", "world.xml"}), 2, message);
}

// Their elements hold texts, which would be told first.
TEST(FirstHour, FilesOfOtherSimulatorsAreToldAsSuch) {
  expect_refused(
      "<?xml version=\"1.0\"?>\n<sdf version=\"1.7\"><world><physics><max_step_size>0.001</max_step_size></physics>"
      "</world></sdf>",
      "world.xml:2:1: the root element is <sdf>, as in a file of Gazebo; muster reads no SDF: expected <world>, with "
      "walls, stations and robots in it");
  expect_refused("<robot name=\"cart\"><link name=\"base\"/></robot>",
                 "world.xml:1:1: the root element is <robot>, as in a robot's description; expected <world>, with "
                 "<robot model=\"FILE.urdf\" at=\"0 0 0\"/> in it");
  expect_refused("<mujoco/>", "world.xml:1:1: the root element is <mujoco>, as in a model of MuJoCo; expected <world>");
  expect_refused(
      "<world name=\"w\" until=\"1\"><physics type=\"ode\"><max_step_size>0.001</max_step_size></physics>"
      "</world>",
      "world.xml:1:27: <physics> is no element of a world; expected <physics.ode/>");
  expect_refused(
      "<world name=\"w\" until=\"1\"><physics type=\"ode\"/></world>",
      "world.xml:1:27: <physics> is no element of a world; expected a plugin (with a dot in its name: "
      "<physics.ode/>) or one of at, swap, record, material, wall, walls, door, floor, mesh, station, robot");
}

TEST(FirstHour, PlacesWithCommasOrTooFewNumbers) {
  const std::string expected = "; expected 3 numbers from -1e+06 to 1e+06 m, with spaces between them (place: x y z)";
  expect_refused(world_of("<station at=\"1,2,0.5\"/>"),
                 "world.xml:1:49: attribute \"at\": \"1,2,0.5\" has commas between its numbers" + expected +
                     "; write at=\"1 2 0.5\"");
  expect_refused(world_of("<station at=\"1 2\"/>"),
                 "world.xml:1:49: attribute \"at\": \"1 2\" has 2 numbers" + expected);
}

TEST(FirstHour, PosesGivenAsReadings) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of("<radio.multiwall/>"));
  folder.write("poses.csv", "t[s],robot,x[m],y[m],yaw[rad]\n0,r,0,0,0\n1,r,1,0,0\n");
  for (const std::string verb : {"fit", "diagnose"})
    expect_error(folder.muster({verb, "world.xml", "--data", "poses.csv"}), 2,
                 "poses.csv:1:1: no radio readings: the columns are t, robot, x, y, yaw; expected tx, rx and "
                 "rssi[dBm], with tx_x[m], tx_y[m], rx_x[m], rx_y[m] or distance[m] (muster import FILE --map MAP "
                 "--out FILE renames columns)");
}

// A world is called as its folder is, also where that is the present one.
TEST(FirstHour, AWorldWithoutAName) {
  const ProgramFolder folder;
  folder.write("world.xml", "<world until=\"1\"/>");
  EXPECT_EQ(folder.muster({"check", "world.xml"}).out,
            folder.path().filename().string() + ": 0 instances, 0 tables; nothing is wrong\n");
}

}  // namespace
