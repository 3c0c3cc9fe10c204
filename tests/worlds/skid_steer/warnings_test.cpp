// Warnings about robots that a run lists, word for word.
#include <gmock/gmock.h>

#include "stock.hpp"

namespace muster::test {
namespace {

using testing::ElementsAre;

std::vector<std::string> warnings(const Folder& folder, const std::string& inside, int ticks = 3) {
  const auto file =
      folder.write("world.xml", "<world name=\"w\" dt=\"0.01\" until=\"1\" seed=\"1\">" + inside + "</world>");
  Simulation run(read_world(file, standard()), standard(), {{MUSTER_PLUGINS_DIR}, 1, {}});
  for (int k = 0; k < ticks; ++k) run.step();
  std::vector<std::string> result;
  for (const auto& event : run.events()) {
    if (event.message.rfind("ODE complains", 0) != 0) result.push_back(folder.inside(event.message));
  }
  return result;
}

TEST(RobotWarnings, CommandedWithoutADrive) {
  Folder folder;
  for (const char* physics : built({"physics.simbody", "physics.ode", "physics.mujoco"})) {
    EXPECT_THAT(
        warnings(folder, std::string("<robot name=\"r\" model=\"crate\" at=\"0 0 0\"/><") + physics +
                             "/><control.steady robot=\"r\" v=\"1\" w=\"0\"/>"),
        ElementsAre(
            "warning: world.xml:1:46: robot 'r' is commanded, but its model 'crate' has no drive, so that it does not "
            "move; expected <muster><differential left=\"\" right=\"\" .../></muster> in " MUSTER_PLUGINS_DIR
            "/models/crate.urdf, or in a file of fittings"));
  }
}

// Every plugin that reads a robot's description would repeat them.
TEST(RobotWarnings, OfADescriptionComeOnce) {
  Folder folder;
  const std::string wheel =
      "<inertial><mass value='1'/><inertia ixx='0.00263' ixy='0' ixz='0' iyy='0.005' iyz='0' izz='0.00263'/></inertial>"
      "<collision><origin rpy='1.5707963267948966 0 0'/><geometry><cylinder radius='0.1' length='0.04'/></geometry>"
      "</collision>";
  const auto joint = [](const std::string& side, const std::string& y) {
    return "<joint name='" + side + "_joint' type='continuous'><parent link='base'/><child link='" + side +
           "'/><origin xyz='0 " + y + " 0.1'/><axis xyz='0 1 0'/></joint>";
  };
  folder.write(
      "cart.urdf",
      "<robot name='cart'><link name='base'><inertial><origin xyz='-0.05 0 0.1'/><mass value='2'/><inertia "
      "ixx='0.02' ixy='0' ixz='0' iyy='0.02' iyz='0' izz='0.02'/></inertial></link><link name='ball'><collision>"
      "<geometry><sphere radius='0.05'/></geometry></collision></link><joint name='b' type='fixed'><parent "
      "link='base'/><child link='ball'/><origin xyz='-0.2 0 0.05'/></joint><link name='l'>" +
          wheel + "</link><link name='r'>" + wheel + "</link>" + joint("l", "0.25") + joint("r", "-0.25") + "</robot>");
  EXPECT_THAT(
      warnings(folder,
               "<robot name=\"r\" model=\"cart.urdf\" at=\"0 0 0\"/><physics.ode/><robots.odometry/>"
               "<sensors.laser/><control.steady robot=\"r\" v=\"0.1\" w=\"0\"/>"),
      ElementsAre(
          "warning: cart.urdf:1: its drive is taken from its wheels' joints, with defaults for what is not there; "
          "to set it, write <muster><differential left=\"l_joint\" right=\"r_joint\" wheel_radius=\"0.1\" "
          "wheel_base=\"0.5\" max_torque=\"1.57\" max_speed=\"10\" max_acceleration=\"10\" "
          "friction=\"0.8\"/></muster>",
          testing::HasSubstr("no robot's model has a laser")));
}

TEST(RobotWarnings, StartsInAWallOrARobot) {
  Folder folder;
  const std::string inside =
      "<material name=\"brick\" loss=\"6\"/><wall name=\"north\" from=\"-5 0.2\" to=\"5 0.2\" thickness=\"0.1\" "
      "material=\"brick\"/><robot name=\"a\" model=\"crate\" at=\"0 0.05 0\"/><robot name=\"b\" model=\"crate\" at=\"2 "
      "-1 0\"/>"
      "<robot name=\"c\" model=\"crate\" at=\"2.39 -1 0\"/><robot name=\"d\" model=\"crate\" at=\"2 -1 0.25\"/>"
      "<robot name=\"e\" model=\"crate\" at=\"4 -0.001 0\"/>";
  for (const char* physics : built({"physics.simbody", "physics.ode", "physics.mujoco"})) {
    EXPECT_THAT(warnings(folder, inside + "<" + physics + "/>"),
                ElementsAre("warning: world.xml:1:157: robot 'a' starts in wall 'north', 50 mm deep, and will be "
                            "pushed out; expected a "
                            "place (at) clear of it",
                            "warning: world.xml:1:245: robot 'c' starts in robot 'b', 10 mm deep, and will be pushed "
                            "out; expected a place "
                            "(at) clear of it"))
        << physics;
  }
}

}  // namespace
}  // namespace muster::test
