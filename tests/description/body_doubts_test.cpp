// Robots whose figures are legal and cannot be meant: millimetres, N mm, and a body that tips.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "description/robot.hpp"
#include "files.hpp"

namespace muster::description {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Texts = std::vector<std::string>;

// A box of these sizes with its centre of mass, two wheels of radius 0.1 m whose axle is at this x, and more.
std::string cart(const std::string& box, const std::string& centre, const std::string& axle, const std::string& more,
                 const std::string& torque = "2") {
  const auto wheel = [&](const std::string& name, const std::string& y) {
    return "<link name='" + name +
           "'><inertial><mass value='1'/><inertia ixx='0.00263' ixy='0' ixz='0' iyy='0.005' iyz='0' izz='0.00263'/>"
           "</inertial><collision><origin rpy='1.5707963267948966 0 0'/><geometry><cylinder radius='0.1' "
           "length='0.04'/></geometry></collision></link>\n<joint name='" +
           name + "_joint' type='continuous'><parent link='base'/><child link='" + name + "'/><origin xyz='" + axle +
           ' ' + y + " 0.1'/><axis xyz='0 1 0'/></joint>\n";
  };
  return "<link name='base'><inertial><origin xyz='" + centre +
         "'/><mass value='10'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>"
         "<collision><origin xyz='0 0 0.2'/><geometry><box size='" +
         box + "'/></geometry></collision></link>\n" + wheel("l", "0.25") + wheel("r", "-0.25") + more +
         "<muster><differential left='l_joint' right='r_joint' wheel_radius='0.1' wheel_base='0.5' max_torque='" +
         torque + "' max_speed='10' max_acceleration='10' friction='0.8'/></muster>\n";
}

const std::string caster =
    "<link name='caster'><collision><geometry><sphere radius='0.02'/></geometry></collision></link>\n<joint "
    "name='caster_joint' type='fixed'><parent link='base'/><child link='caster'/><origin xyz='-0.2 0 0.02'/></joint>\n";

Texts warnings_of(const std::string& elements) {
  Files files;
  const std::string path = files.write("r.urdf", "<robot name='r'>\n" + elements + "</robot>\n");
  Texts result;
  for (const std::string& warning : read_robot(path).warnings) result.push_back(warning.substr(path.size()));
  return result;
}

TEST(BodyDoubts, SayNothingOfACartThatStands) {
  EXPECT_THAT(warnings_of(cart("0.5 0.3 0.1", "-0.05 0 0.2", "0.1", caster)), IsEmpty());
}

TEST(BodyDoubts, AWheelOnEnd) {
  const auto with = [](const std::string& origin) {
    std::string text = cart("0.5 0.3 0.1", "-0.05 0 0.2", "0.1", caster);
    const std::string lying = "<origin rpy='1.5707963267948966 0 0'/>";
    return warnings_of(text.replace(text.find(lying), lying.size(), origin));
  };
  EXPECT_THAT(with(""), Contains(":3: link 'l': its collision cylinder lies along 0 0 1, and its joint 'l_joint' turns "
                                 "about 0 1 0, so that the wheel stands on end; expected <origin "
                                 "rpy=\"1.5707963267948966 0 0\"/> in its <collision>"));
  EXPECT_THAT(
      with("<origin xyz='0 0.01 0' rpy='0 1.5708 0'/>"),
      Contains(HasSubstr("lies along 1 0 0, and its joint 'l_joint' turns about 0 1 0, so that the wheel stands "
                         "on end; expected <origin xyz=\"0 0.01 0\" rpy=\"1.5707963267948966 0 0\"/>")));
  EXPECT_THAT(with("<origin rpy='-1.5708 0.3 0'/>"), IsEmpty());  // turned about its axle
  EXPECT_THAT(with("<origin rpy='1.57 0 0'/>"), IsEmpty());
}

TEST(BodyDoubts, SizesInMillimetres) {
  EXPECT_THAT(warnings_of(cart("500 300 100", "-0.05 0 0.2", "0.1", caster)),
              ElementsAre(":2: link 'base': a shape of 500 x 300 x 100 m; are these millimetres? expected metres, here "
                          "0.5 x 0.3 x 0.1 m, and all origins, radii and distances of the model alike"));
  EXPECT_THAT(warnings_of(cart("0.5 0.3 0.1", "-50 0 0.2", "0.1", caster)),
              Contains(":2: link 'base': its centre of mass is 49.75 m off its collision shapes; are these "
                       "millimetres?"));
}

TEST(BodyDoubts, ADriveThatCreeps) {
  const auto with = [](const std::string& speed, const std::string& acceleration) {
    std::string text = cart("0.5 0.3 0.1", "-0.05 0 0.2", "0.1", caster);
    const std::string limits = "max_speed='10' max_acceleration='10'";
    return warnings_of(text.replace(text.find(limits), limits.size(),
                                    "max_speed='" + speed + "' max_acceleration='" + acceleration + "'"));
  };
  EXPECT_THAT(
      with("0.6", "0.5"),
      testing::ElementsAre(testing::EndsWith(": <differential> max_speed=\"0.6\" rad/s of a wheel is 0.06 m/s at "
                                             "its rim (radius 0.1 m); is it in m/s? 0.6 m/s are 6 rad/s"),
                           testing::EndsWith(": <differential> max_acceleration=\"0.5\" rad/s2 of a wheel is 0.05 "
                                             "m/s2 at its rim (radius 0.1 m); is it in m/s2? 0.5 m/s2 are 5 "
                                             "rad/s2")));
  EXPECT_THAT(with("1.1", "1.1"), IsEmpty());
}

TEST(BodyDoubts, ATorqueInNewtonMillimetres) {
  EXPECT_THAT(
      warnings_of(cart("0.5 0.3 0.1", "-0.05 0 0.2", "0.1", caster, "2000")),
      Contains(": the drive's max_torque=\"2000\" is more than 50 times what its wheels can pass to the ground, "
               "9.42 N m; are these N mm?"));
}

TEST(BodyDoubts, ABodyThatTips) {
  // The axle stands at x = 0.1 m; the caster behind it carries what hangs behind, and nothing what hangs before it.
  EXPECT_THAT(warnings_of(cart("0.5 0.3 0.1", "0.2 0 0.2", "0.1", caster)),
              Contains(HasSubstr("at rest the robot tips: its centre of mass, at x = 0.183 m, y = 0 m, lies beyond")));
  EXPECT_THAT(warnings_of(cart("0.5 0.3 0.1", "-0.05 0 0.2", "0.1", "")),
              Contains(HasSubstr("at rest the robot tips")));
}

TEST(BodyDoubts, WheelsAboutAnotherAxisAreToldWithTheirOwn) {
  const auto told = [](const std::string& origin, const std::string& axis) {
    Files files;
    const std::string inertia =
        "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>";
    const std::string path = files.write(
        "bot.urdf", "<robot name='bot'>\n<link name='base'>" + inertia + "</link>\n<link name='wheel'>" + inertia +
                        "</link>\n<joint name='j' type='continuous'><parent link='base'/><child link='wheel'/>" +
                        origin + axis + "</joint></robot>");
    std::string words = wheels_about_others(read_robot(path));
    if (const auto at = words.find(path); at != words.npos) words.erase(at, path.size());
    return words;
  };
  EXPECT_EQ(
      told("", "<axis xyz='0 0 1'/>"),
      "joint 'j' of link 'wheel' (:3) turns about the robot's z axis, and a wheel about y: expected <axis xyz=\"0 1 "
      "0\"/>");
  EXPECT_EQ(
      told("<origin rpy='-1.5707963267948966 0 0'/>", "<axis xyz='1 0 0'/>"),
      "joint 'j' of link 'wheel' (:3) turns about the robot's x axis, and a wheel about y: expected <axis xyz=\"0 0 "
      "1\"/>");
  EXPECT_EQ(told("<origin rpy='-1.5707963267948966 0 0'/>", "<axis xyz='0 0 1'/>"), "");
  EXPECT_EQ(told("", "<axis xyz='0 -1 0'/>"), "");
}

}  // namespace
}  // namespace muster::description
