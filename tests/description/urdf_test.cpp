// Good descriptions are read completely.
#include <gtest/gtest.h>

#include <algorithm>
#include <clocale>
#include <cmath>
#include <cstdlib>

#include "description/abilities.hpp"
#include "description/robot.hpp"
#include "files.hpp"

namespace muster::description {
namespace {

const std::string scarab = MUSTER_SOURCE_DIR "/plugins/robots/models/scarab.urdf";

TEST(Urdf, ScarabHasThePapersFigures) {
  const Robot robot = read_robot(scarab);
  EXPECT_EQ(robot.name, "scarab");
  EXPECT_NEAR(whole_mass(robot).mass, 8.0, 1e-12);
  ASSERT_TRUE(robot.drive);
  EXPECT_EQ(robot.drive->max_torque, 2.765);
  EXPECT_NEAR(robot.drive->max_torque, 28.2 * 9.80665 / 100, 1e-3);  // 28.2 kg cm
  EXPECT_EQ(robot.drive->wheel_base, 0.21);
  EXPECT_EQ(robot.drive->wheel_radius, 0.05);
  EXPECT_EQ(robot.drive->friction, 0.8);
  EXPECT_TRUE(robot.warnings.empty());
}

TEST(Urdf, RdkHasThePapersFigures) {
  const Robot robot = read_robot(MUSTER_SOURCE_DIR "/plugins/robots/models/rdk.urdf");
  EXPECT_NEAR(whole_mass(robot).mass, 2.7, 1e-12);
  ASSERT_TRUE(robot.legs);
  const auto& box = std::get<Box>(robot.links[0].shapes[0].geometry);
  EXPECT_EQ(box.size.x(), 0.35);
  EXPECT_EQ(box.size.z(), 0.1);
  EXPECT_NEAR(robot.legs->track() + 0.02, 0.3, 1e-12);  // legs are 2 cm wide
  EXPECT_FALSE(robot.legs->is_rigid());
  const Ability rolls = Ability::wheels | Ability::rotors;
  EXPECT_EQ(lacking(robot, rolls), "legs (<legs>), changes of height, roll and pitch");
  EXPECT_EQ(lacking(robot, rolls | Ability::legs | Ability::height | Ability::tilting), "");
  for (std::size_t i = 0; i < LegDrive::count; ++i) {
    const LegDrive::Leg &leg = robot.legs->legs[i], &beside = robot.legs->legs[(i + 3) % 6];
    EXPECT_NE(leg.tripod, beside.tripod);
    EXPECT_EQ(leg.hip.x(), beside.hip.x());
    EXPECT_EQ(leg.hip.y(), -beside.hip.y());
  }
  EXPECT_TRUE(robot.warnings.empty());
}

TEST(Urdf, NoPointOfALegLiesBelowItsLowest) {
  const LegDrive drive = *read_robot(MUSTER_SOURCE_DIR "/plugins/robots/models/rdk.urdf").legs;
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Vector3d up =
        Eigen::Vector3d(std::sin(trial), std::sin(2.3 * trial), std::cos(3.7 * trial)).normalized();
    const double angle = 0.1 * trial;
    double lowest = 1e9;
    for (int k = 0; k <= 10000; ++k)
      lowest = std::min(lowest, up.dot(drive.place(angle, 3.14159265358979 * k / 10000)));
    EXPECT_NEAR(up.dot(drive.place(angle, drive.lowest_way(angle, up))), lowest, 1e-9);
  }
  EXPECT_NEAR(drive.place(0, 3.14159265358979).z(), -0.12, 1e-12);  // upright on its end
  EXPECT_LT(drive.place(0, 1.5).x(), 0);                            // bulging backwards
  EXPECT_LT(drive.place(0.3, 3.14159265358979).x(), 0);             // positive rates push the ground back
}

TEST(Urdf, ScarabFillsItsMeasuredBox) {
  const Robot robot = read_robot(scarab);
  Eigen::AlignedBox3d body;
  for (const Shape& shape : rigid_shapes(robot, 0)) body.extend(bounds(shape));
  EXPECT_NEAR(body.sizes().x(), 0.2, 1e-9);
  EXPECT_NEAR(body.sizes().y(), 0.135, 1e-9);
  EXPECT_NEAR(body.max().z(), 0.222, 1e-7);  // above the ground; the mesh is in single precision
}

// Closed, outward-facing triangles give the volume by the divergence theorem.
TEST(Urdf, MeshIsScaledAndClosed) {
  const Robot robot = read_robot(scarab);
  const auto& mesh = std::get<Mesh>(robot.links.back().shapes.at(0).geometry);
  double volume = 0;
  for (const auto& f : mesh.faces) {
    volume += mesh.vertices[f[0]].dot(mesh.vertices[f[1]].cross(mesh.vertices[f[2]])) / 6;
  }
  const double disc = 0.5 * 16 * 0.021 * 0.021 * std::sin(2 * M_PI / 16);  // a 16-gon
  EXPECT_NEAR(volume, 0.05 * 0.05 * 0.04 + disc * 0.03, 1e-10);
}

TEST(Urdf, MassesLumpAsRigidBodies) {
  Files files;
  const Robot robot = read_robot(files.write("r.urdf", R"(<robot name="r">
    <link name="a"><inertial><mass value="2"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
    <link name="b"><inertial><origin xyz="1 0 0" rpy="0 0 1.5707963267948966"/><mass value="2"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="2" iyz="0" izz="2.5"/></inertial></link>
    <joint name="j" type="fixed"><parent link="a"/><child link="b"/><origin xyz="1 0 0"/></joint></robot>)"));
  const Mass sum = whole_mass(robot);
  EXPECT_EQ(sum.mass, 4);
  EXPECT_TRUE(sum.centre.isApprox(Eigen::Vector3d(1, 0, 0)));
  // The second link's axes are turned by 90 degrees about z: its x and y moments change places.
  EXPECT_TRUE(sum.inertia.isApprox(Eigen::Vector3d(1 + 2, 1 + 1 + 4, 1 + 2.5 + 4).asDiagonal().toDenseMatrix(), 1e-12));
}

TEST(Urdf, RestitutionIsReadAndPlasticWhereItIsNotSaid) {
  Files files;
  const auto read = [&](const std::string& muster) {
    return read_robot(files.write("r.urdf", "<robot name='r'><link name='a'/>" + muster + "</robot>")).restitution;
  };
  EXPECT_EQ(read("<muster restitution='0.5'/>"), 0.5);
  EXPECT_EQ(read("<muster restitution='1'/>"), 1);
  EXPECT_EQ(read("<muster/>"), 0);
  EXPECT_EQ(read(""), 0);
}

TEST(Urdf, EveryKindOfJointIsRead) {
  Files files;
  std::string text = "<robot name='r'>\n<link name='l0'/>";
  const std::string mass =
      "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>";
  for (std::size_t i = 0; i < joint_laws.size(); ++i) {
    const std::string kind = joint_laws[i].name, child = "l" + std::to_string(i + 1);
    text += "<link name='" + child + "'>" + mass + "</link><joint name='" + kind + "' type='" +
            (kind == "ball" ? "floating" : kind) + "'><parent link='l0'/><child link='" + child +
            "'/><axis xyz='0 0 2'/><limit lower='-1' upper='2' effort='3' velocity='4'/>"
            "<dynamics damping='5' friction='6'/></joint>";
  }
  const std::string file = files.write("r.urdf", text + "<muster><ball joint='ball'/></muster></robot>");
  const Robot robot = read_robot(file);
  ASSERT_EQ(robot.joints.size(), joint_laws.size());
  for (std::size_t i = 0; i < joint_laws.size(); ++i) {
    const Joint& joint = robot.joints[i];
    const JointLaw& law = law_of(joint.kind);
    EXPECT_EQ(joint.name, law.name);
    EXPECT_EQ(joint.child, i + 1);
    EXPECT_EQ(joint.axis, law.has_axis ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX()) << law.name;
    EXPECT_EQ(std::isfinite(joint.lower), law.has_limits) << law.name;
    EXPECT_EQ(std::isfinite(joint.upper), law.has_limits) << law.name;
    const std::string type = joint.kind == JointKind::ball ? "floating" : law.name;
    const auto warning =
        file + ":2: joint '" + law.name + "': a " + type + " joint has no lower and upper limit; they are left out";
    EXPECT_EQ(std::count(robot.warnings.begin(), robot.warnings.end(), warning), !law.has_limits) << law.name;
  }
  EXPECT_EQ(robot.joints[1].lower, -1);
  EXPECT_EQ(robot.joints[3].upper, 2);
  EXPECT_EQ(robot.joints[1].max_effort, 3);
  EXPECT_EQ(robot.joints[1].max_speed, 4);
  EXPECT_EQ(robot.joints[1].damping, 5);
  EXPECT_EQ(robot.joints[1].friction, 6);
}

// A coordinate for each rate, but where a quaternion stands for three of them.
// Elements of the standard that muster does not use, and those of other programs.
TEST(Urdf, WhatIsOfOthersMayStand) {
  Files files;
  const Robot robot =
      read_robot(files.write("r.urdf", R"(<robot name="r" version="1.0" xmlns:xacro="http://ros.org/xacro">
    <material name="blue"><color rgba="0 0 1 1"/></material>
    <link name="a" type="laser"><visual name="v"><geometry><box size="1 1 1" xacro:x="1"/></geometry>
      <material name="blue"/></visual>
      <collision name="one"><geometry><box size="1 1 1"/></geometry></collision>
      <collision><geometry><sphere radius="1"/></geometry></collision></link>
    <link name="b"/>
    <joint name="j" type="fixed" xacro:x="1"><parent link="a"/><child link="b"/><calibration rising="0"/>
      <safety_controller soft_lower_limit="-1" soft_upper_limit="1" k_position="1" k_velocity="1"/></joint>
    <transmission name="t"><type>x</type></transmission><gazebo reference="a"><mu1>0.2</mu1></gazebo></robot>)"));
  EXPECT_EQ(robot.links[0].shapes.size(), 2u);
  EXPECT_TRUE(robot.warnings.empty());
}

TEST(Urdf, JointsHaveAsManyRatesAsTheyLetMove) {
  for (const JointLaw& law : joint_laws) {
    const bool turns_about_all = law.kind == JointKind::ball || law.kind == JointKind::floating;
    EXPECT_EQ(law.positions, law.rates + turns_about_all) << law.name;
    EXPECT_EQ(&law_of(law.kind), &law);
  }
}

TEST(Urdf, BackendsAreToldWhichJointsTheyLack) {
  Files files;
  const std::string mass =
      "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>";
  std::string text = "<robot name='r'><link name='l0'>" + mass + "</link>";
  for (const JointLaw& law : joint_laws) {
    const std::string kind = law.name;
    text += "<link name='of_" + kind + "'>" + mass + "</link><joint name='" + kind + "' type='" +
            (kind == "ball" ? "floating" : kind) + "'><parent link='l0'/><child link='of_" + kind +
            "'/><axis xyz='0 0 1'/><limit lower='-1' upper='2' effort='3' velocity='4'/></joint>";
  }
  text += "<muster><ball joint='ball'/></muster>";
  text +=
      "<muster><quadrotor arm='0.2' thrust_factor='1e-3' torque_factor='1e-7' max_speed='900' lag_up='0.01' "
      "lag_down='0.01' attitude_p='196' attitude_d='22.4' yaw_p='4'/></muster></robot>";
  const Robot robot = read_robot(files.write("r.urdf", text));
  const Ability flies = Ability::rotors | Ability::height | Ability::tilting;
  EXPECT_EQ(lacking(robot, flies | Ability::balls),
            "joint 'revolute' (revolute) without a motor, joint 'continuous' (continuous) without a motor, "
            "joint 'prismatic' (prismatic) without a motor, joint 'floating' (floating) without a motor, "
            "joint 'planar' (planar) without a motor");
  EXPECT_EQ(lacking(robot, flies | Ability::hinges | Ability::sliders | Ability::loose),
            "joint 'ball' (ball) without a motor");
}

TEST(Urdf, LimbsHangOnWhatCarriesThem) {
  Files files;
  const std::string mass =
      "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>";
  std::string text = "<robot name='r'><link name='base'>" + mass + "</link>";
  const auto hang = [&](const std::string& name, const std::string& on, const std::string& type,
                        const std::string& at) {
    text += "<link name='" + name + "'>" + mass + "</link><joint name='" + name + "' type='" + type +
            "'><parent link='" + on + "'/><child link='" + name + "'/><origin xyz='" + at +
            "' rpy='0 0 1.5707963267948966'/></joint>";
  };
  hang("mast", "base", "fixed", "1 0 0");
  hang("arm", "mast", "floating", "2 0 0");
  hang("sleeve", "arm", "fixed", "3 0 0");
  hang("hand", "sleeve", "continuous", "4 0 0");
  const Robot robot = read_robot(files.write("r.urdf", text + "<muster><ball joint='arm'/></muster></robot>"));
  const std::vector<LimbJoint> limbs = limbs_of(robot);
  ASSERT_EQ(limbs.size(), 2u);
  EXPECT_EQ(robot.joints[limbs[0].joint].name, "arm");
  EXPECT_EQ(limbs[0].carrier, LimbJoint::body);
  EXPECT_TRUE(limbs[0].frame.translation().isApprox(Eigen::Vector3d(1, 2, 0)));
  EXPECT_EQ(robot.joints[limbs[1].joint].name, "hand");
  EXPECT_EQ(limbs[1].carrier, 0);
  EXPECT_TRUE(limbs[1].frame.translation().isApprox(Eigen::Vector3d(3, 4, 0)));
  EXPECT_TRUE(limbs[1].frame.linear().col(0).isApprox(-Eigen::Vector3d::UnitX()));
  EXPECT_EQ(rigid_mass(robot, robot.joints[limbs[0].joint].child).mass, 2);
  EXPECT_TRUE(limbs_of(read_robot(scarab)).empty());
}

// Bounds contain many points of a shape's surface, and no more.
TEST(Bounds, AreTheLeast) {
  const Eigen::Isometry3d pose =
      Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized());
  const auto span = [&](const auto& shape, const auto& surface) {
    Eigen::AlignedBox3d seen;
    for (double a = 0; a < 2 * M_PI; a += 0.01) {
      for (double b = 0; b <= M_PI; b += 0.01) seen.extend(pose * surface(a, b));
    }
    const Eigen::AlignedBox3d exact = bounds(Shape{pose, shape});
    EXPECT_TRUE(exact.min().isApprox(seen.min(), 1e-4)) << exact.min() << "\n" << seen.min();
    EXPECT_TRUE(exact.max().isApprox(seen.max(), 1e-4)) << exact.max() << "\n" << seen.max();
  };
  span(Sphere{0.5}, [](double a, double b) -> Eigen::Vector3d {
    return 0.5 * Eigen::Vector3d(std::sin(b) * std::cos(a), std::sin(b) * std::sin(a), std::cos(b));
  });
  span(Cylinder{0.5, 2}, [](double a, double b) -> Eigen::Vector3d {
    return {0.5 * std::cos(a), 0.5 * std::sin(a), b < M_PI / 2 ? -1.0 : 1.0};
  });
  span(Box{{1, 2, 3}}, [](double a, double b) -> Eigen::Vector3d {
    return {std::copysign(0.5, std::cos(a)), std::copysign(1, std::sin(a)), std::copysign(1.5, std::cos(b))};
  });
}

// Of a link on the body by fixed joints the frames add up; a wheel is not on it.
TEST(Urdf, ScarabHasItsLaser) {
  const Robot robot = read_robot(scarab, Meshes::skip);
  ASSERT_EQ(robot.sensors.size(), 1u);
  const Sensor& hokuyo = robot.sensors[0];
  EXPECT_EQ(hokuyo.name, "hokuyo");
  EXPECT_TRUE(hokuyo.pose.translation().isApprox(Eigen::Vector3d(0.05, 0, 0.207)));
  EXPECT_EQ(hokuyo.rate, 10);
  EXPECT_EQ(hokuyo.laser.samples, 683);
  EXPECT_NEAR(hokuyo.laser.step(), 2 * M_PI / 1024, 1e-7);
  EXPECT_EQ(hokuyo.laser.max_range, 4);
  EXPECT_FALSE(frame_on_body(robot, robot.joints[robot.drive->left].child));
}

TEST(Urdf, SensorsStandAsTheirOriginSays) {
  Files files;
  const Robot robot = read_robot(files.write("r.urdf", R"(<robot name="r"><link name="a"/><link name="b"/>
    <joint name="j" type="fixed"><parent link="a"/><child link="b"/><origin xyz="1 0 0" rpy="0 0 1.5707963267948966"/></joint>
    <sensor name="one" update_rate="5"><parent link="b"/><origin xyz="0.5 0 0" rpy="0 0.3 0"/>
      <ray><horizontal samples="3" min_angle="-1" max_angle="1"/><vertical samples="1"/></ray></sensor>
    <sensor name="single" update_rate="5"><parent link="a"/><ray><horizontal/></ray></sensor>
    <muster><laser sensor="one" min_range="0" max_range="7" resolution="0"/><laser sensor="single" max_range="2" min_range="0.1"/></muster></robot>)"));
  ASSERT_EQ(robot.sensors.size(), 2u);
  EXPECT_TRUE(robot.sensors[0].pose.translation().isApprox(Eigen::Vector3d(1, 0.5, 0)));
  const Eigen::Vector3d x(0, std::cos(0.3), -std::sin(0.3));  // pitched down, and turned to the left
  EXPECT_TRUE(robot.sensors[0].pose.linear().col(0).isApprox(x, 1e-12));
  EXPECT_EQ(robot.sensors[0].laser.step(), 1);
  EXPECT_EQ(robot.sensors[0].laser.resolution, 0);
  EXPECT_EQ(robot.sensors[1].laser.samples, 1);
  EXPECT_EQ(robot.sensors[1].laser.min_range, 0.1);
  EXPECT_TRUE(robot.warnings.empty());
}

TEST(Urdf, SensorsThatNothingSensesWithAreWarnedAbout) {
  Files files;
  const std::string path = files.write("r.urdf",
                                       "<robot name='r'><link name='a'/>\n<sensor name='eye' update_rate='5'><parent "
                                       "link='a'/><camera/></sensor>\n<sensor name='s' update_rate='5'><parent "
                                       "link='a'/><ray><horizontal/></ray></sensor></robot>");
  const Robot robot = read_robot(path);
  EXPECT_EQ(
      robot.warnings,
      (std::vector<std::string>{
          path + ":2: sensor 'eye' has no <ray>; muster has plugins for lasers alone, so that nothing senses with it",
          path + ":3: sensor 's' has no range, so that nothing senses with it; expected <muster><laser sensor=\"s\" "
                 "max_range=\"\"/></muster>"}));
}

TEST(Urdf, GermanLocaleReadsTheSameNumbers) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  ::setenv("LOCPATH", MUSTER_LOCALES, 1);
  ASSERT_NE(std::setlocale(LC_ALL, "de_DE.UTF-8"), nullptr);
  const Robot robot = read_robot(scarab);
  std::setlocale(LC_ALL, before.c_str());
  EXPECT_EQ(robot.drive->max_torque, 2.765);
  EXPECT_NEAR(whole_mass(robot).mass, 8.0, 1e-12);
}

TEST(Urdf, MeshInMillimetresIsWarnedAbout) {
  Files files;
  std::filesystem::copy_file(MUSTER_SOURCE_DIR "/plugins/robots/models/hokuyo.stl", files.at("hokuyo.stl"));
  const std::string path =
      files.write("r.urdf",
                  "<robot name='r'>\n<link name='a'><collision><geometry><mesh filename='hokuyo.stl' scale='10 10 10'/>"
                  "</geometry></collision></link></robot>");
  const Robot robot = read_robot(path);
  ASSERT_EQ(robot.warnings.size(), 1u);
  EXPECT_EQ(robot.warnings[0],
            path +
                ":2: link 'a': mesh 'hokuyo.stl' is 700 m large; is it in millimetres? expected <mesh "
                "filename=\"hokuyo.stl\" scale=\"0.01 0.01 0.01\"/>, with which it is 0.7 m large");
  EXPECT_TRUE(read_robot(path, Meshes::skip).links[0].shapes.empty());
}

TEST(Urdf, WheelsThatDoNotStandOnTheGroundAreWarnedAbout) {
  Files files;
  std::string text = test::contents(scarab);
  for (const std::string hub : {"0.105 0.05", "-0.105 0.05"}) text.replace(text.find(hub), hub.size(), hub + '6');
  const std::string path = files.write("r.urdf", text);
  const Robot robot = read_robot(path, Meshes::skip);
  ASSERT_EQ(robot.warnings.size(), 1u);
  EXPECT_EQ(robot.warnings[0], path +
                                   ":89: <differential> the axle is at z = 0.056 of the robot's frame, which is to be "
                                   "on the ground; wheels of radius 0.05 do not stand there");
}

TEST(Model, IsFoundByNameOrPath) {
  Files files;
  files.write("one/a.urdf", "");
  files.write("two/b.urdf", "");
  const std::vector<std::string> folders = {files.at("one"), files.at("two")};
  EXPECT_EQ(find_model("b", folders), files.at("two") + "/b.urdf");
  EXPECT_EQ(find_model("two/b.urdf", {files.at("")}), files.at("two/b.urdf"));
  EXPECT_EQ(find_model(files.at("one/a.urdf"), folders), files.at("one/a.urdf"));
}

// The world's folder comes last: for a name, but not for a path.
TEST(Model, AFileOfTheWorldComesBeforeABuiltInModel) {
  Files files;
  files.write("plugins/models/husky.urdf", "");
  files.write("world/husky.urdf", "");
  const std::string plugins = files.at("plugins"), world = files.at("world");
  const std::vector<std::string> folders = {plugins, plugins + "/models", world, world + "/models"};
  EXPECT_EQ(find_model("husky.urdf", folders), world + "/husky.urdf");
  EXPECT_EQ(find_model("./husky.urdf", folders), world + "/./husky.urdf");
  EXPECT_EQ(find_model("husky", folders), plugins + "/models/husky.urdf");
  EXPECT_EQ(doubt_of_model("husky", folders),
            "model=\"husky\" is " + plugins + "/models/husky.urdf; the file " + world +
                "/husky.urdf is not read; expected model=\"husky.urdf\" where that is meant");
  EXPECT_EQ(doubt_of_model("husky.urdf", folders), "");
  EXPECT_EQ(doubt_of_model("husky", {plugins, plugins + "/models"}), "");
}

TEST(Model, AFileWithAnotherEndingIsToldWhichThereAre) {
  Files files;
  files.write("bot.mjcf", "<mujoco/>");
  EXPECT_EQ(
      message_of([&] { find_model("bot.mjcf", {files.at("")}); }),
      "bot.mjcf is no name of a robot's file; expected one that ends in .urdf, or in .xml for a MuJoCo model (MJCF): "
      "\"bot.xml\"");
}

TEST(Model, AbsentOneIsNamedWithItsNearest) {
  Files files;
  files.write("scarab.urdf", "");
  EXPECT_EQ(message_of([&] { find_model("scrab", {files.at("")}); }),
            "there is no model \"scrab\"; did you mean 'scarab'? expected one of scarab, or a URDF file, such as "
            "\"scrab.urdf\"");
  files.write("crate.urdf", "");
  EXPECT_EQ(message_of([&] { find_model("turtlebot", {files.at("")}); }),
            "there is no model \"turtlebot\"; expected one of crate, scarab, or a URDF file, such as "
            "\"turtlebot.urdf\"");
  files.write("husky.urdf", "");
  files.write("waffle.urdf", "");
  const std::string all = " expected one of crate, husky, scarab, waffle, or a URDF file, such as ";
  EXPECT_EQ(message_of([&] { find_model("turtlebot3_burger", {files.at("")}); }),
            "there is no model \"turtlebot3_burger\"; did you mean \"waffle\"?" + all + "\"turtlebot3_burger.urdf\"");
  EXPECT_EQ(message_of([&] { find_model("husky_a200", {files.at("")}); }),
            "there is no model \"husky_a200\"; did you mean \"husky\"?" + all + "\"husky_a200.urdf\"");
}

TEST(Drive, RatesAndTwistAreEachOthersInverse) {
  const DifferentialDrive drive = *read_robot(scarab).drive;
  const double left = drive.left_rate(0.4, 0.7), right = drive.right_rate(0.4, 0.7);
  EXPECT_NEAR(drive.forward(left, right), 0.4, 1e-15);
  EXPECT_NEAR(drive.turn(left, right), 0.7, 1e-15);
}

TEST(Drive, TurnsNoFasterThanItsTopSpeed) {
  const DifferentialDrive drive = *read_robot(scarab).drive;
  EXPECT_EQ(drive.limited_rate(100), 20);
  EXPECT_EQ(drive.limited_rate(-100), -20);
  EXPECT_EQ(drive.limited_rate(19.5), 19.5);
}

}  // namespace
}  // namespace muster::description
