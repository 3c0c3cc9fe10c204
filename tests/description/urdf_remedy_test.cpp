// What a refusal of a URDF says to write, where that follows from other figures of the file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "refusals.hpp"

namespace muster::description {
namespace {

const std::string inertia = "<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>";
std::string massive(const std::string& name) {
  return "<link name='" + name + "'><inertial><mass value='1'/>" + inertia + "</link>\n";
}

// Two wheels on lines 6 and 8, and what may stand between them and the body.
std::string wheels(const std::string& left, const std::string& mount = "0 0 0") {
  const auto wheel = [&](const std::string& name, const std::string& y, const std::string& angles) {
    return "<joint name='" + name + "_joint' type='continuous'><parent link='mount'/><child link='" + name +
           "'/>\n<origin xyz='0 " + y + " 0' rpy='" + angles + "'/><axis xyz='0 0 1'/></joint>\n";
  };
  return massive("b") + massive("l") + massive("r") + wheel("l", "0.1", left) +
         wheel("r", "-0.1", "-1.5707963267948966 0 0") +
         "<link name='mount'/><joint name='m' type='fixed'><parent link='b'/><child link='mount'/><origin rpy='" +
         mount +
         "'/></joint>\n<muster><differential left='l_joint' right='r_joint' wheel_radius='0.05' wheel_base='0.2' "
         "max_torque='1' max_speed='9' friction='0.8'/></muster>\n";
}

TEST(UrdfRemedy, ALinkWithoutMassHasThatOfItsShapes) {
  const std::string box = "<collision><geometry><box size='0.3 0.2 0.1'/></geometry></collision></link>\n";
  EXPECT_EQ(refusal_of("<link name='a'>\n<inertial>\n<mass value='0'/>" + inertia + box),
            "r.urdf:4: link 'a': <mass value=\"0\"/>; expected the mass in kg, above 0 (its collision shapes filled "
            "with water "
            "weigh 6 kg), or no <inertial> if the link is a frame without mass");
}

// A link with a shape and no mass is a frame, and as a body it is most likely forgotten; a link below it may hold the
// mass.
TEST(UrdfRemedy, ABodyThatWeighsNothingIsTold) {
  const std::string box = "<collision><geometry><box size='0.3 0.2 0.1'/></geometry></collision></link>\n";
  const std::string wheel =
      massive("w") +
      "<joint name='j' type='continuous'><parent link='a'/><child link='w'/><axis xyz='0 1 0'/></joint>\n";
  const auto warnings = [&](const std::string& elements) {
    Files files;
    std::string all;
    for (const auto& one : read_robot(files.write("r.urdf", "<robot name='r'>\n" + elements + "</robot>\n")).warnings)
      all += one.substr(one.find("r.urdf:")) + '\n';
    return all;
  };
  EXPECT_NE(
      warnings("<link name='a'>" + box + wheel)
          .find("r.urdf:2: link 'a' has a collision shape and no <inertial>, so that the robot's body weighs nothing; "
                "expected the mass in kg, above 0 (its collision shapes filled with water weigh 6 kg)"),
      std::string::npos);
  const std::string held = massive("m") + "<joint name='f' type='fixed'><parent link='a'/><child link='m'/></joint>\n";
  EXPECT_EQ(warnings("<link name='a'>" + box + wheel + held).find("weighs nothing"), std::string::npos);
}

TEST(UrdfRemedy, AGeometryHasOneShape) {
  EXPECT_THAT(
      refusal_of("<link name='a'><collision><geometry><box size='1 1 1'/>\n<sphere radius='1'/></geometry>"
                 "</collision></link>\n"),
      testing::HasSubstr("link 'a': <geometry> has a <box> and a <sphere>, of which URDF reads the first alone; "
                         "expected one shape, and another <collision> for each more"));
}

TEST(UrdfRemedy, ALinkIsNoJoint) {
  std::string elements = wheels("-1.5707963267948966 0 0");
  elements.replace(elements.find("left='l_joint'"), 14, "left='l'");
  EXPECT_NE(
      refusal_of(elements).find("left: 'l' is a link, and a joint is meant; expected left=\"l_joint\", the joint that "
                                "holds it"),
      std::string::npos)
      << refusal_of(elements);
}

TEST(UrdfRemedy, AnglesInDegreesAreToldBeforeTheAxisThatTheyGive) {
  EXPECT_EQ(refusal_of(wheels("-1.5707963267948966 0 0")), "no error");
  EXPECT_EQ(refusal_of(wheels("-90 0 0")),
            "r.urdf:6: joint 'l_joint': <origin> rpy=\"-90 0 0\": more than a full turn in radians; are these degrees? "
            "expected "
            "rpy=\"-1.570796 0 0\"");
  EXPECT_EQ(
      refusal_of(wheels("-1.5707963267948966 0 0", "0 0 15")),
      "r.urdf:9: joint 'm': <origin> rpy=\"0 0 15\": more than a full turn in radians; are these degrees? expected "
      "rpy=\"0 0 0.261799\"");
  EXPECT_NE(refusal_of(wheels("-1.4 0 0")).find("does not turn about the body's +y axis"), std::string::npos);
}

}  // namespace
}  // namespace muster::description
