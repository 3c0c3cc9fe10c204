// URDF files as ROS people have them: what is mended is told word for word, with figures and what to write.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "description/robot.hpp"
#include "files.hpp"

namespace muster::description {
namespace {

const std::string mass =
    "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>";

std::string link(const std::string& name, const std::string& inside) {
  return "<link name='" + name + "'>" + inside + "</link>\n";
}
std::string wheel_joint(const std::string& name, const std::string& at, const std::string& inside = "",
                        const std::string& axis = "0 1 0") {
  return "<joint name='" + name + "_joint' type='continuous'><parent link='base'/><child link='" + name +
         "'/><origin xyz='" + at + "'/><axis xyz='" + axis + "'/>" + inside + "</joint>\n";
}
// A wheel of radius 0.1 m, 1 kg; homogeneous, of width 0.04 m.
const std::string wheel =
    "<inertial><mass value='1'/><inertia ixx='0.00263' ixy='0' ixz='0' iyy='0.005' iyz='0' izz='0.00263'/></inertial>"
    "<collision><origin rpy='1.5707963267948966 0 0'/><geometry><cylinder radius='0.1' length='0.04'/></geometry>"
    "</collision>";

// The warnings of a robot with these elements, from line 2 on, without the file's name.
std::vector<std::string> warnings_of(const std::string& elements, const UrdfSetting& setting = {}) {
  Files files;
  const std::string path = files.write("r.urdf", "<robot name='r'>\n" + elements + "</robot>\n");
  std::vector<std::string> result;
  for (const std::string& warning : read_robot(path, Meshes::import, setting).warnings) {
    EXPECT_EQ(warning.rfind(path, 0), 0u) << warning;
    result.push_back(warning.substr(path.size() + 1));
  }
  return result;
}
using Texts = std::vector<std::string>;

Robot robot_of(const std::string& elements) {
  Files files;
  return read_robot(files.write("r.urdf", "<robot name='r'>\n" + elements + "</robot>\n"));
}

TEST(UrdfOfRos, RoundedAxisIsTurnedOntoTheRobots) {
  const std::string arm = link("base", mass) + link("arm", mass) +
                          "<joint name='j' type='continuous'><parent link='base'/><child link='arm'/>"
                          "<origin xyz='0 1 0' rpy='-1.57 0 0'/><axis xyz='0 0 1'/></joint>\n";
  EXPECT_EQ(warnings_of(arm),
            Texts({"4: joint 'j': its axis is 0.04563 degrees off the robot's +y axis, and is turned onto it; write "
                   "<origin rpy=\"-1.5707963267948966 0 0\"/>"}));
  const Robot robot = robot_of(arm);
  EXPECT_TRUE((robot.joints[0].origin.linear() * robot.joints[0].axis).isApprox(Eigen::Vector3d::UnitY(), 1e-15));
  EXPECT_EQ(robot.joints[0].origin.translation(), Eigen::Vector3d(0, 1, 0));
}

TEST(UrdfOfRos, DegreesAndPerCentAreDoubted) {
  const std::string arm = link("base", mass) + link("arm", mass);
  const auto joint = [&](const std::string& origin, const std::string& limit) {
    return arm + "<joint name='j' type='revolute'><parent link='base'/><child link='arm'/><origin rpy='" + origin +
           "'/><axis xyz='0 1 0'/><limit " + limit + " effort='1' velocity='1'/></joint>\n";
  };
  EXPECT_EQ(warnings_of(joint("0 0 90", "lower='-1' upper='1'")),
            Texts({"4: joint 'j': <origin> rpy=\"0 0 90\": 90 rad is more than a full turn; are these degrees? 90 "
                   "degrees are 1.571 rad"}));
  EXPECT_EQ(
      warnings_of(joint("0 0 0", "lower='-90' upper='90'")),
      Texts({"4: joint 'j': limits of -90 to 90 rad are more than a full turn; are these degrees? 90 degrees are 1.571 "
             "rad"}));
  EXPECT_EQ(warnings_of(joint("0 0 6.283185307179586", "lower='-6.2832' upper='6.2832'")), Texts());
  EXPECT_EQ(warnings_of(joint("0 0 0", "lower='-1000' upper='1000'")), Texts());  // no degrees: it has no limits
  EXPECT_EQ(warnings_of(joint("0 0 0", "lower='-1' upper='1'") +
                        "<transmission name='t'>\n<joint name='jj'/></transmission>\n"),
            Texts({"6: <transmission> 't': joint 'jj' is not known; did you mean 'j'?"}));
}

// An axis a degree and more away is meant, and one within a microradian needs nothing.
TEST(UrdfOfRos, OtherAxesStay) {
  for (const char* angle : {"0.02", "0.0000005"}) {
    const std::string arm = link("base", mass) + link("arm", mass) +
                            "<joint name='j' type='continuous'><parent link='base'/><child link='arm'/><origin rpy='" +
                            angle + " 0 0'/><axis xyz='0 0 1'/></joint>\n";
    EXPECT_EQ(warnings_of(arm), Texts());
    EXPECT_NEAR(robot_of(arm).joints[0].origin.linear()(2, 1), std::sin(std::stod(angle)), 1e-15);
  }
}

TEST(UrdfOfRos, AxisOfAnotherLength) {
  const std::string arm = link("base", mass) + link("arm", mass) +
                          "<joint name='j' type='continuous'><parent link='base'/><child link='arm'/>"
                          "<axis xyz='0 3 4'/></joint>\n";
  EXPECT_EQ(warnings_of(arm), Texts({"4: joint 'j': its axis has a length of 5 where 1 is expected, and is divided by "
                                     "it; write <axis xyz=\"0 0.6 0.8\"/>"}));
}

TEST(UrdfOfRos, InertiaThatNearlyBreaksTheTriangleInequalityIsWidened) {
  const std::string body =
      "<inertial><mass value='2'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='2.1'/></inertial>";
  EXPECT_EQ(
      warnings_of(link("a", body)),
      Texts({"2: link 'a': inertia breaks the triangle inequality: of its principal moments 1, 1 and 2.1 kg m2 the "
             "largest is 5 % above the sum of the others; the others are raised by 0.05 kg m2 each; write "
             "<inertial><origin xyz=\"0 0 0\"/><mass value=\"2\"/><inertia ixx=\"1.05\" ixy=\"0\" ixz=\"0\" "
             "iyy=\"1.05\" iyz=\"0\" izz=\"2.1\"/></inertial>"}));
  EXPECT_NEAR(robot_of(link("a", body)).links[0].mass.inertia.trace(), 4.2, 1e-12);
}

TEST(UrdfOfRos, MassAndInertiaAreHeldAgainstTheShapes) {
  const auto box = [](const std::string& m, const std::string& i) {
    return link("a", "<inertial><mass value='" + m + "'/><inertia ixx='" + i + "' ixy='0' ixz='0' iyy='" + i +
                         "' iyz='0' izz='" + i +
                         "'/></inertial><collision><origin xyz='0 0 1'/><geometry><box size='1 1 1'/></geometry>"
                         "</collision>");
  };
  EXPECT_EQ(warnings_of(box("12", "2")), Texts());
  EXPECT_EQ(warnings_of(box("12", "19")), Texts());
  const std::string remedy =
      "; expected 1/10 to 10 times; unless it is meant, write <inertial><origin xyz=\"0 0 1\"/><mass value=\"12\"/>"
      "<inertia ixx=\"2\" ixy=\"0\" ixz=\"0\" iyy=\"2\" iyz=\"0\" izz=\"2\"/></inertial>";
  EXPECT_EQ(warnings_of(box("12", "30")), Texts({"2: link 'a': its inertia is 15 times that of its collision shapes "
                                                 "filled evenly with 12 kg" +
                                                 remedy}));
  EXPECT_EQ(warnings_of(box("12", "0.1")), Texts({"2: link 'a': its inertia is 1/20 of that of its collision shapes "
                                                  "filled evenly with 12 kg" +
                                                  remedy}));
  EXPECT_EQ(warnings_of(box("0.6", "0.1")),
            Texts({"2: link 'a': its mass of 0.6 kg gives its collision shapes a density "
                   "of 0.6 kg/m3; expected 1 to 2.26e+04 (osmium)"}));
  EXPECT_EQ(
      warnings_of(box("30000", "5000")),
      Texts({"2: link 'a': its mass of 3e+04 kg gives its collision shapes a density of 3e+04 kg/m3; expected 1 to "
             "2.26e+04 (osmium); are these grams?"}));
}

std::string two_wheels(const std::string& left = wheel, const std::string& left_axis = "0 1 0") {
  return link("base", mass) + link("l", left) + link("r", wheel) + wheel_joint("l", "0 0.25 0.1", "", left_axis) +
         wheel_joint("r", "0 -0.25 0.1");
}
std::string with(std::string text, const std::string& was, const std::string& is) {
  return text.replace(text.find(was), was.size(), is);
}
const std::string declared_drive =
    "<muster><differential left='%' right='r_joint' wheel_radius='0.1' wheel_base='0.5' max_torque='1' max_speed='9' "
    "friction='0.8'/></muster>\n";

TEST(UrdfOfRos, WheelOfRoundedFiguresIsBalanced) {
  const std::string elements = two_wheels(with(wheel, "0.00263", "0.00264")) + with(declared_drive, "%", "l_joint");
  // 38 % of the way: the mean of 0.00264 and 0.00263.
  EXPECT_EQ(warnings_of(elements),
            Texts({"3: the wheel of joint 'l_joint': its inertia is uneven about the axle by 0.3795 %; it is taken as "
                   "balanced; write <inertial><origin xyz=\"0 0 0\"/><mass value=\"1\"/><inertia ixx=\"0.002635\" "
                   "ixy=\"0\" ixz=\"0\" iyy=\"0.005\" iyz=\"0\" izz=\"0.002635\"/></inertial> in link 'l'"}));
  const Eigen::Matrix3d inertia = robot_of(elements).links[1].mass.inertia;
  EXPECT_NEAR(inertia(0, 0), 0.002635, 1e-15);
  EXPECT_NEAR(inertia(2, 2), 0.002635, 1e-15);
}

TEST(UrdfOfRos, WheelWithItsMassBesideTheAxle) {
  const std::string elements = two_wheels(with(wheel, "<inertial>", "<inertial><origin xyz='0.001 0.003 0'/>")) +
                               with(declared_drive, "%", "l_joint");
  EXPECT_EQ(warnings_of(elements),
            Texts({"3: the wheel of joint 'l_joint': its centre of mass is 1 mm off the axle; it is taken as balanced; "
                   "write <inertial><origin xyz=\"0 0.003 0\"/><mass value=\"1\"/><inertia ixx=\"0.00263\" ixy=\"0\" "
                   "ixz=\"0\" iyy=\"0.005\" iyz=\"0\" izz=\"0.00263\"/></inertial> in link 'l'"}));
}

TEST(UrdfOfRos, WheelAboutMinusYIsTurnedAround) {
  const std::string elements = two_wheels(wheel, "0 -1 0") + with(declared_drive, "%", "l_joint");
  EXPECT_EQ(
      warnings_of(elements),
      Texts({"7: <differential> joint 'l_joint' turns about the body's -y axis, and is taken to turn about +y; its "
             "angle has the other sign; write <axis xyz=\"0 1 0\"/>"}));
  EXPECT_EQ(robot_of(elements).joints[0].axis, Eigen::Vector3d::UnitY());
}

std::string four_wheels() {
  std::string text = link("base", mass);
  for (const char* name : {"fl", "fr", "rl", "rr"}) text += link(name, wheel);
  return text + wheel_joint("fl", "0.2 0.25 0.1") + wheel_joint("fr", "0.2 -0.25 0.1") +
         wheel_joint("rl", "-0.2 0.25 0.1") + wheel_joint("rr", "-0.2 -0.25 0.1");
}

TEST(UrdfOfRos, FourDrivenWheels) {
  const Robot robot = robot_of(
      four_wheels() +
      "<muster><differential left='fl_joint rl_joint' right='fr_joint rr_joint' wheel_radius='0.1' wheel_base='0.5' "
      "max_torque='1' max_speed='9' friction='0.8'/></muster>\n");
  const DifferentialDrive& drive = *robot.drive;
  ASSERT_EQ(drive.wheels().size(), 4u);
  EXPECT_EQ(robot.joints[drive.wheels()[2].joint].name, "rl_joint");
  EXPECT_EQ(drive.side_of(drive.wheels()[3].joint), 1);
  EXPECT_TRUE(limbs_of(robot).empty());
  // 2 b (1 + (a / b)^2) with a = 0.2, b = 0.25.
  EXPECT_NEAR(drive.effective_base, 0.82, 1e-12);
  EXPECT_NEAR(drive.turn(-1, 1), 0.2 / 0.82, 1e-12);
}

TEST(UrdfOfRos, DriveIsTakenFromWheels) {
  const Texts warnings = warnings_of(four_wheels());
  // 5 kg and 0.8: 9.81 * 5 * 0.8 / 2 N on a side.
  EXPECT_EQ(warnings,
            Texts({"1: its drive is taken from its wheels' joints, with defaults for what is not there; to set "
                   "it, write <muster><differential left=\"fl_joint rl_joint\" right=\"fr_joint rr_joint\" "
                   "wheel_radius=\"0.1\" wheel_base=\"0.5\" effective_base=\"0.82\" max_torque=\"1.962\" "
                   "max_speed=\"10\" max_acceleration=\"10\" friction=\"0.8\"/></muster>"}));
  EXPECT_FALSE(robot_of(four_wheels() + "<muster/>").drive) << "who writes <muster> has decided";
  const std::string limited = link("base", mass) + link("l", wheel) + link("r", wheel) +
                              wheel_joint("l", "0 0.25 0.1", "<limit effort='3' velocity='4'/>") +
                              wheel_joint("r", "0 -0.25 0.1", "<limit effort='3' velocity='4'/>");
  EXPECT_EQ(robot_of(limited).drive->max_torque, 3);
  EXPECT_EQ(robot_of(limited).drive->max_speed, 4);
  EXPECT_FALSE(robot_of(link("base", mass) + link("l", wheel) + wheel_joint("l", "0 0.25 0.1")).drive);
}

const std::string gazebo_laser =
    "<gazebo reference='base'><sensor type='gpu_ray' name='lds'><pose>0 0 0.1 0 0 1.5707963267948966</pose>\n"
    "<update_rate>5</update_rate><ray><scan><horizontal><samples>360</samples><resolution>1</resolution>\n"
    "<min_angle>0.0</min_angle><max_angle>6.28319</max_angle></horizontal></scan>\n"
    "<range><min>0.12</min><max>3.5</max><resolution>0.015</resolution></range></ray></sensor></gazebo>\n";

TEST(UrdfOfRos, GazeboSensorsAreRead) {
  const Robot robot = robot_of(link("base", mass) + gazebo_laser);
  ASSERT_EQ(robot.sensors.size(), 1u);
  const Sensor& lds = robot.sensors[0];
  EXPECT_EQ(lds.name, "lds");
  EXPECT_EQ(lds.rate, 5);
  EXPECT_EQ(lds.laser.samples, 360);
  EXPECT_EQ(lds.laser.min_angle, 0);
  EXPECT_EQ(lds.laser.max_angle, 6.283185307179586);
  EXPECT_EQ(lds.laser.min_range, 0.12);
  EXPECT_EQ(lds.laser.max_range, 3.5);
  EXPECT_EQ(lds.laser.resolution, 0.015);
  EXPECT_TRUE(lds.pose.translation().isApprox(Eigen::Vector3d(0, 0, 0.1)));
  EXPECT_TRUE(lds.pose.linear().col(0).isApprox(Eigen::Vector3d::UnitY()));
}

TEST(UrdfOfRos, GazeboPartsThatAreNotUsedAreToldOnce) {
  EXPECT_EQ(warnings_of(link("base", mass) + "<gazebo><plugin name='states' filename='libstates.so'/></gazebo>\n" +
                        gazebo_laser +
                        "<gazebo reference='base'><material>Gazebo/Grey</material><sensor type='imu' name='imu'/>"
                        "<sensor type='depth' name='realsense'/></gazebo>\n<ros2_control/>"),
            Texts({"3: muster has no part for these, and ignores them: plugin 'states', sensor 'imu' (imu), sensor "
                   "'realsense' (depth), <ros2_control>"}));
}

// Of an arm. A wheel of the drive is driven here as well, and a joint that nothing drives in ROS hangs there as here.
TEST(UrdfOfRos, JointsThatRosDrivesAndNothingHereMoveFreely) {
  const std::string arm = link("base", mass) + link("arm", mass) +
                          "<joint name='elbow' type='continuous'><parent link='base'/><child link='arm'/>"
                          "<axis xyz='0 0 1'/></joint>\n";
  const std::string is_free =
      "> drives it in ROS, and nothing drives it here: it moves freely; expected it among the joints of "
      "<differential> or <legs>, or type=\"fixed\" where it is to hold";
  EXPECT_EQ(warnings_of(arm), Texts());
  EXPECT_EQ(warnings_of(arm + "<transmission name='t'><type>x</type>\n<joint name='elbow'/></transmission>\n"),
            Texts({"6: joint 'elbow': <transmission" + is_free}));
  const std::string control = "<ros2_control name='c' type='system'>\n<joint name='elbow'>";
  EXPECT_EQ(warnings_of(arm + control + "<command_interface name='position'/></joint></ros2_control>\n").back(),
            "6: joint 'elbow': <ros2_control" + is_free);
  EXPECT_EQ(warnings_of(arm + control + "<state_interface name='position'/></joint></ros2_control>\n").size(), 1u);
  EXPECT_EQ(warnings_of(two_wheels() + with(declared_drive, "%", "l_joint") +
                        "<transmission name='t'><type>x</type><joint name='l_joint'/></transmission>\n"),
            Texts());
}

TEST(UrdfOfRos, GazeboFaultsHaveTheirLine) {
  Files files;
  const auto message = [&](const std::string& was, const std::string& is) {
    const std::string path =
        files.write("r.urdf", "<robot name='r'>\n" + link("base", mass) + with(gazebo_laser, was, is) + "</robot>");
    return message_of([&] { read_robot(path); }).substr(path.size() + 1);
  };
  EXPECT_EQ(message("<max>3.5", "<max>3.5m"), "6: sensor 'lds': <max> \"3.5m\" is wrong; expected a number");
  EXPECT_EQ(message("6.28319", "270"),
            "4: sensor 'lds': sweeps more than a whole turn, from 0 to 270 rad; are these degrees? expected "
            "<min_angle>0</min_angle> and <max_angle>4.712</max_angle>");
  EXPECT_EQ(message("6.28319", "7"), "4: sensor 'lds': sweeps more than a whole turn, from 0 to 7 rad");
  EXPECT_EQ(message("<update_rate>5</update_rate>", ""), "3: sensor 'lds': <sensor> has no <update_rate>");
  EXPECT_EQ(message("reference='base'", "reference='bas'"),
            "3: <gazebo> reference: link 'bas' is not known; did you mean 'base'?");
}

TEST(UrdfOfRos, GazeboDriveIsRead) {
  const std::string plugin =
      "<gazebo><plugin name='drive' filename='libgazebo_ros_diff_drive.so'>\n<left_joint>l_joint</left_joint>"
      "<right_joint>r_joint</right_joint>\n<wheel_separation>0.5</wheel_separation><wheel_diameter>0.2</wheel_diameter>"
      "<max_wheel_torque>20</max_wheel_torque></plugin></gazebo>\n";
  EXPECT_EQ(warnings_of(two_wheels() + plugin),
            Texts({"7: its drive is taken from <gazebo>, with defaults for what is not there; to set it, write "
                   "<muster><differential left=\"l_joint\" right=\"r_joint\" wheel_radius=\"0.1\" wheel_base=\"0.5\" "
                   "max_torque=\"20\" max_speed=\"10\" max_acceleration=\"10\" friction=\"0.8\"/></muster>"}));
  // A separation that is not that of the joints is meant for the turns.
  EXPECT_EQ(robot_of(two_wheels() + with(plugin, "n>0.5", "n>0.6")).drive->effective_base, 0.6);
  EXPECT_EQ(robot_of(two_wheels() + with(plugin, "n>0.5", "n>0.6")).drive->wheel_base, 0.5);
}

TEST(UrdfOfRos, FittingsHoldWhatAUrdfLacks) {
  Files files;
  const std::string path = files.write("r.urdf", "<robot name='r'>\n" + two_wheels() + "</robot>\n");
  const std::string more =
      files.write("more.xml", "<robot>" + with(declared_drive, "%", "l_joint") + gazebo_laser + "</robot>");
  const Robot robot = read_robot(path, Meshes::import, {"", more});
  EXPECT_TRUE(robot.drive);
  EXPECT_EQ(robot.sensors.size(), 1u);
  EXPECT_EQ(robot.warnings, Texts());
  const std::string uneven =
      files.write("u.urdf", "<robot name='r'>\n" + two_wheels(with(wheel, "0.00263", "0.00264")) + "</robot>\n");
  const Texts of_wheels = read_robot(uneven, Meshes::import, {"", more}).warnings;
  ASSERT_EQ(of_wheels.size(), 1u);  // of the file of links, whose line it names
  for (const std::string& warning : of_wheels) EXPECT_EQ(warning.rfind(uneven + ":", 0), 0u) << warning;
  const std::string wrong = files.write("wrong.xml", "<robot>\n<link name='a'/></robot>");
  EXPECT_EQ(message_of([&] {
              read_robot(path, Meshes::import, {"", wrong});
            }),
            wrong + ":2: <link> does not belong into fittings; expected <sensor>, <gazebo> or <muster>");
  EXPECT_EQ(message_of([&] {
              find_setting({"", "mor.xml"}, {files.at("")});
            }),
            "there is no file mor.xml in " + files.at(""));
}

TEST(UrdfOfRos, ModelThatIsXacroByItsName) {
  EXPECT_EQ(message_of([] { find_model("burger.urdf.xacro", {"."}); }),
            "burger.urdf.xacro is xacro, not URDF; run xacro first: xacro burger.urdf.xacro > burger.urdf");
  EXPECT_EQ(message_of([] { find_model("a/burger.xacro", {"."}); }),
            "a/burger.xacro is xacro, not URDF; run xacro first: xacro a/burger.xacro > burger.urdf");
}

std::filesystem::path shared_urdf(const std::string& name) {
  return std::filesystem::path(MUSTER_SOURCE_DIR).parent_path() / "shared/data/urdf" / name;
}

TEST(UrdfOfRos, StockBurgerLoads) {
  const auto path = shared_urdf("turtlebot3_burger.urdf");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "needs ../shared/data/urdf";
  const Robot robot = read_robot(path.string());
  ASSERT_TRUE(robot.drive);
  EXPECT_NEAR(robot.drive->wheel_radius, 0.033, 1e-12);
  EXPECT_NEAR(robot.drive->wheel_base, 0.16, 1e-12);
  const auto wheel_warning = [](const std::string& line, const std::string& side) {
    return ":" + line + ": the wheel of joint 'wheel_" + side +
           "_joint': its inertia is uneven about the axle by 0.178 %; it is taken as balanced; write <inertial><origin "
           "xyz=\"0 0 0\"/><mass value=\"0.0285\"/><inertia ixx=\"1.118e-05\" ixy=\"0\" ixz=\"0\" iyy=\"1.118e-05\" "
           "iyz=\"0\" izz=\"2.071e-05\"/></inertial> in link 'wheel_" +
           side + "_link'";
  };
  const auto axis_warning = [](const std::string& line, const std::string& side) {
    return ":" + line + ": joint 'wheel_" + side +
           "_joint': its axis is 0.04563 degrees off the robot's +y axis, and is turned onto it; write <origin "
           "rpy=\"-1.5707963267948966 0 0\"/>";
  };
  Texts warnings;
  for (const std::string& warning : robot.warnings) warnings.push_back(warning.substr(path.string().size()));
  EXPECT_EQ(
      warnings,
      Texts({":116: link 'caster_back_link': its inertia is 2607 times that of its collision shapes filled evenly "
             "with 0.005 kg; expected 1/10 to 10 times; unless it is meant, write <inertial><origin "
             "xyz=\"0 0.001 0\"/><mass value=\"0.005\"/><inertia ixx=\"2.004e-07\" ixy=\"0\" ixz=\"0\" "
             "iyy=\"5.417e-07\" iyz=\"0\" izz=\"4.087e-07\"/></inertial>",
             axis_warning("50", "left"), axis_warning("80", "right"), wheel_warning("57", "left"),
             wheel_warning("87", "right"),
             ":2: its drive is taken from its wheels' joints, with defaults for what is not there; to set it, write "
             "<muster><differential left=\"wheel_left_joint\" right=\"wheel_right_joint\" wheel_radius=\"0.033\" "
             "wheel_base=\"0.16\" max_torque=\"0.1297\" max_speed=\"30.3\" max_acceleration=\"30.3\" "
             "friction=\"0.8\"/></muster>"}));
}

TEST(UrdfOfRos, StockSkidSteerHasFourWheels) {
  const auto path = shared_urdf("husky_like.urdf");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "needs ../shared/data/urdf";
  const Robot robot = read_robot(path.string());
  ASSERT_TRUE(robot.drive);
  EXPECT_EQ(robot.drive->wheels().size(), 4u);
  EXPECT_TRUE(limbs_of(robot).empty());
}

// Models that are shipped need no mending.
TEST(UrdfOfRos, ShippedModelsHaveNoWarnings) {
  for (const char* name : {"scarab", "rdk", "hummingbird", "crate", "husky", "waffle"}) {
    const std::string path = std::string(MUSTER_SOURCE_DIR "/plugins/robots/models/") + name + ".urdf";
    EXPECT_EQ(read_robot(path).warnings, Texts()) << name;
  }
}

}  // namespace
}  // namespace muster::description
