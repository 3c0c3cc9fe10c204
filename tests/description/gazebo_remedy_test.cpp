// What Gazebo and exports of CAD programs say of wheels and lasers, and a run does not take: told with what to write.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "description/robot.hpp"
#include "files.hpp"

namespace muster::description {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// A body on two wheels of 0.1 m, with `more` in each wheel's joint and `beside` them.
std::vector<std::string> warnings_of(const std::string& more, const std::string& beside) {
  const auto wheel = [&](const std::string& name, const std::string& y) {
    return "<link name='" + name +
           "'><inertial><mass value='1'/><inertia ixx='0.00263' ixy='0' ixz='0' iyy='0.005' iyz='0' izz='0.00263'/>"
           "</inertial></link>\n<joint name='" +
           name + "_joint' type='continuous'><parent link='base'/><child link='" + name + "'/><origin xyz='0 " + y +
           " 0.1'/><axis xyz='0 1 0'/>" + more + "</joint>\n";
  };
  Files files;
  const std::string path = files.write(
      "r.urdf",
      "<robot name='r'>\n<link name='base'><inertial><origin xyz='0 0 0.2'/><mass value='10'/><inertia ixx='1' ixy='0' "
      "ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>\n" +
          wheel("l", "0.25") + wheel("r", "-0.25") + beside +
          "\n<muster><differential left='l_joint' right='r_joint' wheel_radius='0.1' wheel_base='0.5' max_torque='2' "
          "max_speed='10' max_acceleration='10' friction='0.8'/></muster></robot>\n");
  std::vector<std::string> result;
  for (const std::string& warning : read_robot(path).warnings) result.push_back(warning.substr(path.size()));
  return result;
}

TEST(GazeboRemedy, FrictionOfAWheelIsThatOfTheDrive) {
  const auto with = [](const std::string& link, const std::string& mu) {
    return warnings_of("", "<gazebo reference='" + link + "'><mu1>" + mu + "</mu1></gazebo>");
  };
  EXPECT_THAT(
      with("l", "0.05"),
      ElementsAre(":7: <gazebo> of 'l': <mu1> 0.05 is not taken, and the drive's wheels have a friction of 0.8; "
                  "expected friction=\"0.05\" in <muster>, <differential>"));
  EXPECT_THAT(with("l", "0.8"), IsEmpty());
  EXPECT_THAT(with("l", "100000"), IsEmpty()) << "no slip";
  EXPECT_THAT(with("base", "0.05"), IsEmpty());
}

TEST(GazeboRemedy, LimitsOfNothingAreNoLimits) {
  const std::string begin =
      "<limit> effort=\"0\" velocity=\"0\" would let the wheel not turn, and is taken as no limit; "
      "the drive has 2 N m and 10 rad/s: expected effort=\"2\" velocity=\"10\", or no <limit>";
  EXPECT_THAT(warnings_of("<limit effort='0' velocity='0'/>", ""),
              ElementsAre(":4: joint 'l_joint': " + begin, ":6: joint 'r_joint': " + begin));
  EXPECT_THAT(warnings_of("<limit effort='2' velocity='10'/>", ""), IsEmpty());
}

TEST(GazeboRemedy, NoiseOfALaserIsThatOfTheWorld) {
  const auto with = [](const std::string& deviation) {
    return warnings_of("",
                       "<gazebo reference='base'><sensor type='ray' name='lidar'><update_rate>10</update_rate><ray>"
                       "<scan><horizontal><samples>9</samples><min_angle>-1</min_angle><max_angle>1</max_angle>"
                       "</horizontal></scan><range><min>0.1</min><max>8</max></range>\n<noise><type>gaussian</type>"
                       "<stddev>" +
                           deviation + "</stddev></noise></ray></sensor></gazebo>");
  };
  EXPECT_THAT(with("0.05"), ElementsAre(":8: sensor 'lidar': its <noise> of 0.05 m is not taken; expected "
                                        "<sensors.laser noise=\"0.05\"/> in the world"));
  EXPECT_THAT(with("0"), IsEmpty());
}

}  // namespace
}  // namespace muster::description
