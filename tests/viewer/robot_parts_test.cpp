// Bodies as the page draws them: shapes at their places, wheels and legs on joints that a recorded column turns.
#include "viewer/robot_parts.hpp"

#include <gtest/gtest.h>

#include "decoded.hpp"
#include "tests/folder.hpp"

namespace muster::test {
namespace {

Read parts_of_model(const std::string& file) {
  return Read::parse(viewer::parts_of(description::read_robot(file, description::Meshes::visual)).dump());
}

std::string shipped(const std::string& name) { return MUSTER_SOURCE_DIR "/plugins/robots/models/" + name + ".urdf"; }

TEST(RobotParts, TheScarabHasItsBodyCastersLaserAndTwoTurningWheels) {
  const Read scarab = parts_of_model(shipped("scarab"));
  ASSERT_EQ(scarab["joints"].size(), 2u);
  EXPECT_EQ(scarab["joints"][0]["quantity"], "wheels");
  EXPECT_EQ(scarab["joints"][0]["column"], "left");
  EXPECT_EQ(scarab["joints"][1]["column"], "right");
  EXPECT_EQ(scarab["joints"][0]["at"], Read({0.0, 0.105, 0.05}));
  EXPECT_EQ(scarab["joints"][0]["axis"], Read({0.0, 1.0, 0.0}));
  std::map<std::string, int> shapes;
  for (const Read& part : scarab["parts"]) {
    ++shapes[part["shape"]];
    EXPECT_EQ(part["main"], part["shape"] == "box");
    EXPECT_EQ(part.contains("joint"), part["shape"] == "cylinder");
  }
  EXPECT_EQ(shapes, (std::map<std::string, int>{{"box", 1}, {"sphere", 2}, {"cylinder", 2}, {"mesh", 1}}));
  EXPECT_EQ(scarab["parts"][0]["at"], Read({0.0, 0.0, 0.091}));
  EXPECT_NEAR(scarab["radius"].get<double>(), 0.157, 0.01);
}

TEST(RobotParts, TheHexapodHasSixLegsThatTurn) {
  const Read rdk = parts_of_model(shipped("rdk"));
  ASSERT_EQ(rdk["joints"].size(), 6u);
  EXPECT_EQ(rdk["joints"][5]["column"], "angle6");
  int legs = 0;
  for (const Read& part : rdk["parts"]) {
    if (part["shape"] != "leg") continue;
    EXPECT_EQ(part["joint"], legs++);
    EXPECT_EQ(part["radius"], 0.06);
  }
  EXPECT_EQ(legs, 6);
}

TEST(RobotParts, VisualsAreShownInsteadOfCollisionShapes) {
  Folder folder;
  const auto file =
      folder.write("r.urdf",
                   "<robot name='r'><link name='a'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' "
                   "iyz='0' izz='1'/>"
                   "</inertial><visual><origin xyz='0 0 2'/><geometry><sphere radius='3'/></geometry></visual>"
                   "<collision><geometry><box size='1 1 1'/></geometry></collision></link></robot>");
  const Read robot = parts_of_model(file.string());
  ASSERT_EQ(robot["parts"].size(), 1u);
  EXPECT_EQ(robot["parts"][0]["shape"], "sphere");
  EXPECT_EQ(robot["parts"][0]["at"], Read({0.0, 0.0, 2.0}));
}

TEST(RobotParts, AVisualThatCannotBeReadLeavesTheCollisionShapesAndAWarning) {
  Folder folder;
  const auto file =
      folder.write("r.urdf",
                   "<robot name='r'><link name='a'><visual><geometry><mesh filename='gone.stl'/></geometry></visual>"
                   "<collision><geometry><box size='1 1 1'/></geometry></collision></link></robot>");
  EXPECT_EQ(parts_of_model(file.string())["parts"][0]["shape"], "box");
  const auto robot = description::read_robot(file.string(), description::Meshes::visual);
  ASSERT_EQ(robot.warnings.size(), 1u);
  EXPECT_NE(robot.warnings[0].find("mesh 'gone.stl'"), std::string::npos) << robot.warnings[0];
  EXPECT_TRUE(description::read_robot(file.string()).warnings.empty());
}

}  // namespace
}  // namespace muster::test
