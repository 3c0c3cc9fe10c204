// Wheels that are none as a description has them: told at their line, with what to write.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "refusals.hpp"

namespace muster::description {
namespace {

using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const char wheel_shape[] =
    "<origin rpy='1.5707963267948966 0 0'/><geometry><cylinder radius='0.033' length='0.02'/></geometry>";

std::string inertial(const std::string& mass, const std::string& moment) {
  return "<inertial><mass value='" + mass + "'/><inertia ixx='" + moment + "' ixy='0' ixz='0' iyy='" + moment +
         "' iyz='0' izz='" + moment + "'/></inertial>";
}

std::string link(const std::string& name, const std::string& inside) {
  return "<link name='" + name + "'>" + inside + "</link>\n";
}

std::string joint(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& place) {
  return "<joint name='" + name + "' type='continuous'><parent link='" + parent + "'/><child link='" + child + "'/>\n" +
         "<origin " + place + "/><axis xyz='0 1 0'/></joint>\n";
}

std::string body(const std::string& name = "base_link") {
  return link(name,
              inertial("1.2", "0.006") +
                  "<collision><origin xyz='0 0 0.04'/><geometry><box size='0.3 0.2 0.08'/></geometry></collision>");
}

std::string wheel(const std::string& name, const std::string& shapes) {
  return link(name, inertial("0.03", "1.5e-5") + shapes);
}

std::string collision(const std::string& shape) { return "<collision>" + shape + "</collision>"; }
std::string visual(const std::string& shape) { return "<visual>" + shape + "</visual>"; }

// A body on line 2, its wheels on lines 3 and 4, their joints on lines 5 and 7; the rest from line 9 on.
std::string two_wheels(const std::string& shapes, const std::string& rest = "") {
  return body() + wheel("l", shapes) + wheel("r", shapes) + joint("lj", "base_link", "l", "xyz='0 0.12 0.033'") +
         joint("rj", "base_link", "r", "xyz='0 -0.12 0.033'") + rest;
}

std::vector<std::string> warnings_of(const std::string& elements) {
  Files files;
  std::vector<std::string> result;
  for (const auto& one : read_robot(files.write("r.urdf", "<robot name='r'>\n" + elements + "</robot>\n")).warnings)
    result.push_back(files.inside(one));
  return result;
}

std::string gazebo(const std::string& size) {
  return "<gazebo><plugin name='d' filename='libgazebo_ros_diff_drive.so'>\n<left_joint>lj</left_joint>"
         "<right_joint>rj</right_joint><wheel_separation>0.24</wheel_separation>\n" +
         size + "</plugin></gazebo>\n";
}

TEST(HiddenWheels, TheSizeOfGazeboIsToldAtItsOwnTag) {
  const auto with = [](const std::string& size) {
    return refusal_of(two_wheels(collision(wheel_shape), gazebo(size)));
  };
  EXPECT_EQ(
      with("<wheel_diameter>0.033</wheel_diameter>"),
      "r.urdf:11: <wheel_diameter> 0.033 is the radius of the collision shape of the wheel of joint 'lj', and not "
      "its diameter; expected <wheel_diameter>0.066</wheel_diameter>");
  EXPECT_EQ(with("<wheelDiameter>0.07</wheelDiameter>"),
            "r.urdf:11: <wheelDiameter> 0.07 contradicts the diameter of the collision shape of the wheel of joint "
            "'lj', which is 0.066; expected <wheelDiameter>0.066</wheelDiameter>");
  EXPECT_EQ(
      with("<wheel_radius>0.066</wheel_radius>"),
      "r.urdf:11: <wheel_radius> 0.066 is the diameter of the collision shape of the wheel of joint 'lj', and not "
      "its radius; expected <wheel_radius>0.033</wheel_radius>");
  EXPECT_THAT(with("<wheel_diameter>66</wheel_diameter>"),
              HasSubstr("; is it in millimetres? expected <wheel_diameter>0.066</wheel_diameter>"));
  EXPECT_EQ(with("<wheel_diameter>0.066</wheel_diameter>"), "no error");
}

TEST(HiddenWheels, ABodyOnItsWheelIsRefused) {
  const auto robot = [](const std::string& name, const std::string& shapes) {
    return body(name) + wheel("l", shapes) + wheel("r", shapes) + joint("lj", name, "l", "xyz='0 0.12 0.033'") +
           joint("rj", "r", name, "xyz='0 -0.12 0.033'");
  };
  const std::string ball = "<geometry><sphere radius='0.033'/></geometry>";
  EXPECT_EQ(refusal_of(robot("base_link", collision(wheel_shape))),
            "r.urdf:7: joint 'rj' has 'base_link' as its <child>, so that 'r' is the robot's root; are <parent> and "
            "<child> exchanged? expected <parent link=\"base_link\"/><child link=\"r\"/>");
  for (const std::string& shape : {std::string(wheel_shape), ball})
    EXPECT_THAT(refusal_of(robot("trunk", collision(shape))), StartsWith("r.urdf:7: joint 'rj' has 'trunk' as its"))
        << shape;
  EXPECT_EQ(refusal_of(two_wheels(collision(wheel_shape))), "no error");
}

// A round body is a root as good as any, and so is a frame without mass; on a pedestal a base may turn.
TEST(HiddenWheels, RoundBodiesAndTurntablesAreNone) {
  const std::string upright = collision("<geometry><cylinder radius='0.17' length='0.1'/></geometry>");
  const auto on = [](const std::string& root, const std::string& name) {
    return link(name, root) + wheel("l", collision(wheel_shape)) + wheel("r", collision(wheel_shape)) +
           joint("lj", name, "l", "xyz='0 0.12 0.033'") + joint("rj", name, "r", "xyz='0 -0.12 0.033'");
  };
  EXPECT_EQ(refusal_of(on(inertial("2", "0.02") + upright, "create")), "no error");
  const std::string sphere = collision("<geometry><sphere radius='0.1'/></geometry>");
  EXPECT_EQ(refusal_of(on(inertial("2", "0.02") + sphere, "robot")), "no error") << "its wheels carry nothing";
  const std::string pedestal =
      link("pedestal", inertial("9", "1") + collision("<geometry><box size='1 1 1'/></geometry>"));
  EXPECT_THAT(warnings_of(pedestal + body() + joint("turn", "pedestal", "base_link", "xyz='0 0 1'")),
              Contains("r.urdf:4: joint 'turn' has 'base_link' as its <child>, so that 'pedestal' is the robot's root; "
                       "are <parent> and <child> exchanged? expected <parent link=\"base_link\"/><child "
                       "link=\"pedestal\"/>"));
  EXPECT_THAT(warnings_of(link("world", "") + body() + joint("turn", "world", "base_link", "")),
              Each(Not(HasSubstr("exchanged"))));
}

TEST(HiddenWheels, AVisualAloneGivesNoRadius) {
  const auto told = [](const std::string& elements) {
    std::vector<std::string> result;
    for (const std::string& one : warnings_of(elements))
      if (one.find("no <collision>") != one.npos) result.push_back(one);
    return result;
  };
  const std::string copied =
      "' has a <visual> and no <collision>, so that its radius is not known and it is no wheel; copy its <visual> into "
      "a <collision>: <collision><origin rpy=\"1.5707963267948966 0 0\"/><geometry><cylinder radius=\"0.033\" "
      "length=\"0.02\"/></geometry></collision>";
  EXPECT_THAT(told(two_wheels(visual(wheel_shape))),
              ElementsAre("r.urdf:3: link 'l' of joint 'lj" + copied, "r.urdf:4: link 'r' of joint 'rj" + copied));
  // What is to be written makes it a robot that drives.
  Files files;
  const std::string path = files.write(
      "r.urdf", "<robot name='r'>\n" + two_wheels(visual(wheel_shape) + collision(wheel_shape)) + "</robot>\n");
  EXPECT_TRUE(read_robot(path).drive);
  EXPECT_TRUE(told(two_wheels(visual(wheel_shape) + collision(wheel_shape))).empty());
  EXPECT_TRUE(told(two_wheels(visual(wheel_shape), gazebo("<wheel_diameter>0.066</wheel_diameter>"))).empty())
      << "the radius is known";
  const std::string mesh = "<geometry><mesh filename='wheel.stl'/></geometry>",
                    box = "<geometry><box size='1 1 1'/></geometry>";
  EXPECT_TRUE(told(two_wheels(visual(box))).empty()) << "no wheel by name or shape";
  EXPECT_THAT(told(body() + wheel("wheel", visual(mesh)) + joint("j", "base_link", "wheel", "xyz='0 0 0.033'")),
              ElementsAre(HasSubstr("expected a <collision> with a <cylinder> of the wheel's radius and width")));
}

TEST(HiddenWheels, AnglesInDegreesAskForNoOtherAxis) {
  const auto told = [](const std::string& angles, const std::string& mount) {
    Files files;
    const std::string shapes = collision(wheel_shape);
    const Robot robot = read_robot(files.write(
        "r.urdf", "<robot name='r'>\n" + body() + link("arm", "") + wheel("wheel", shapes) +
                      "<joint name='m' type='fixed'><parent link='base_link'/><child link='arm'/><origin rpy='" +
                      mount +
                      "'/></joint>\n<joint name='j' type='continuous'><parent link='arm'/><child "
                      "link='wheel'/>\n<origin rpy='" +
                      angles + "'/><axis xyz='0 0 1'/></joint></robot>\n"));
    return files.inside(wheels_about_others(robot));
  };
  EXPECT_EQ(told("-90 0 0", "0 0 0"),
            "joint 'j' of link 'wheel' (r.urdf:4) turns about an axis 26.62 degrees off the robot's y axis, by the "
            "angles in the <origin> of joint 'j', which look like degrees: expected them in radians");
  EXPECT_THAT(told("0 0 0", "-90 0 0"),
              HasSubstr("by the angles in the <origin> of joint 'm', which look like degrees"));
  EXPECT_EQ(
      told("-1.2 0 0", "0 0 0"),
      "joint 'j' of link 'wheel' (r.urdf:4) turns about an axis 21.25 degrees off the robot's y axis, and a wheel "
      "about y: expected <axis xyz=\"0 0.3624 0.932\"/>");
}

TEST(HiddenWheels, SceneryOfAnMjcfIsTakenOutAndTheRobotStays) {
  const std::string robot =
      "<body name='bot'><freejoint/><geom size='1'/><body name='w'><joint/><geom size='1'/></body></body>\n";
  const std::string table = "<body name='table'><geom size='1'/></body>\n";
  const std::string crate = "<body><freejoint/><geom size='1'/></body>\n";
  const auto fault = [](const std::string& bodies) {
    Files files;
    const std::string path = files.write("r.xml", "<mujoco><worldbody>\n" + bodies + "</worldbody></mujoco>");
    return files.inside(message_of([&] { read_robot(path); }));
  };
  EXPECT_EQ(
      fault(table + robot),
      "r.xml:2: <worldbody> has 2 bodies; a model is one robot: expected 'bot' alone; take out 'table' (line 2, no "
      "joints), and put it into the world as a <mesh> or a <robot> of its own");
  EXPECT_THAT(fault(robot + table),
              StartsWith("r.xml:3: <worldbody> has 2 bodies; a model is one robot: expected 'bot' "
                         "alone; take out 'table' (line 3, no joints), and"));
  EXPECT_THAT(fault(table + robot + crate),
              HasSubstr("expected 'bot' alone; take out the <body> (line 4, one joint), "
                        "'table' (line 2, no joints), and put them into the world, each as a"));
  EXPECT_THAT(fault(robot + "<body name='second'><freejoint/><body name='x'><joint/></body></body>"),
              HasSubstr("has a second <body>"))
      << "two robots";
}

}  // namespace
}  // namespace muster::description
