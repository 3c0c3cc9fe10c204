// MuJoCo files: bodies, joints, shapes and masses against closed forms, and faults by their text.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "description/robot.hpp"
#include "files.hpp"

namespace muster::description {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Robot read(const std::string& text) {
  const Files files;
  return read_robot(files.write("m.xml", text));
}

Robot of_body(const std::string& inside, const std::string& before = "") {
  return read("<mujoco model='m'>" + before + "<worldbody><body name='base'><freejoint/>" + inside +
              "</body></worldbody></mujoco>");
}

// A cart: a box on two wheels of radius 0.1 and a ball in front, its body's frame at the height of the axle.
const std::string cart =
    "<mujoco model='cart'>\n<compiler angle='radian' autolimits='true'/>\n<default><default class='wheel'><geom "
    "type='cylinder' size='0.1 0.02'"
    " density='500' euler='1.5707963267948966 0 0'/><joint axis='0 1 0'/></default></default>\n<worldbody>\n<light "
    "pos='0 0 3'/>"
    "<geom type='plane' size='5 5 0.1'/>\n<body name='base' pos='0 0 0.1'><freejoint/>\n<geom type='box' size='0.2 0.1 "
    "0.05' mass='4'/>"
    "<geom type='sphere' size='0.05' pos='0.15 0 -0.05' mass='0'/>\n"
    "<body name='left' pos='0 0.15 0' childclass='wheel'><joint name='left_joint' damping='0.01'/><geom/></body>\n"
    "<body name='right' pos='0 -0.15 0' childclass='wheel'><joint name='right_joint'/><geom/></body>\n"
    "</body></worldbody>\n<actuator><velocity joint='left_joint' kv='1' ctrlrange='-15 15' forcerange='-2 2'/>"
    "<motor joint='right_joint' gear='4' ctrlrange='-0.5 0.5'/></actuator></mujoco>";

TEST(Mjcf, ACartHasItsDriveAndStandsOnTheGround) {
  const Robot robot = read(cart);
  EXPECT_EQ(robot.name, "cart");
  ASSERT_EQ(robot.links.size(), 3u);
  EXPECT_NEAR(robot.links[0].mass.mass, 4, 1e-12);
  EXPECT_NEAR(robot.links[0].mass.centre.z(), 0.1, 1e-12) << "the robot's frame is on the ground";
  EXPECT_NEAR(robot.links[0].mass.inertia(2, 2), 4.0 / 12 * (0.16 + 0.04), 1e-12);
  const double wheel = 500 * M_PI * 0.01 * 0.04;
  EXPECT_NEAR(robot.links[1].mass.mass, wheel, 1e-12);
  EXPECT_NEAR(robot.links[1].mass.inertia(1, 1), wheel * 0.01 / 2, 1e-12) << "turned onto y";
  EXPECT_NEAR(robot.links[1].mass.inertia(0, 0), wheel * (0.01 / 4 + 0.04 * 0.04 / 12), 1e-12);
  EXPECT_EQ(robot.joints[0].kind, JointKind::continuous);
  EXPECT_EQ(robot.joints[0].damping, 0.01);
  ASSERT_TRUE(robot.drive);
  EXPECT_NEAR(robot.drive->wheel_radius, 0.1, 1e-12);
  EXPECT_NEAR(robot.drive->wheel_base, 0.3, 1e-12);
  EXPECT_EQ(robot.drive->max_torque, 2) << "of the actuator's forcerange";
  EXPECT_EQ(robot.drive->max_speed, 15);
  EXPECT_EQ(robot.joints[1].max_effort, 2) << "gear times ctrlrange of a motor";
  ASSERT_EQ(robot.warnings.size(), 2u);
  EXPECT_THAT(robot.warnings[0],
              testing::HasSubstr("m.xml:1: of this MuJoCo model are not taken: <geom> of <worldbody> (a "
                                 "world has ground and walls of its own)"));
  EXPECT_THAT(robot.warnings[1], testing::HasSubstr("its drive is taken from its wheels' joints"));
}

TEST(Mjcf, FindsAModelByItsPath) {
  const Files files;
  const auto path = files.write("cart.xml", cart);
  EXPECT_EQ(find_model("cart.xml", {path.parent_path().string()}), path.string());
}

Matrix3d turn(const std::string& attribute, const std::string& compiler = "") {
  const Robot robot =
      of_body("<geom size='1'/><body " + attribute + "><geom type='box' size='1 2 3'/></body>", compiler);
  return robot.joints[0].origin.linear();
}

TEST(Mjcf, EachWayToGiveARotationIsTheSame) {
  const Matrix3d expected = Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitZ()).toRotationMatrix();
  const std::pair<std::string, std::string> ways[] = {{"quat='1 0 0 1'", ""},
                                                      {"euler='0 0 90'", ""},
                                                      {"euler='0 0 1.5707963267948966'", "<compiler angle='radian'/>"},
                                                      {"axisangle='0 0 3 90'", ""},
                                                      {"xyaxes='0 1 0 -1 0 0'", ""}};
  for (const auto& [way, compiler] : ways) EXPECT_LT((turn(way, compiler) - expected).norm(), 1e-12) << way;
  // Intrinsic x, y, z is extrinsic z, y, x.
  EXPECT_LT((turn("euler='30 40 50'") - turn("euler='50 40 30'", "<compiler eulerseq='ZYX'/>")).norm(), 1e-12);
  EXPECT_LT((turn("zaxis='1 0 0'") * Vector3d::UnitZ() - Vector3d::UnitX()).norm(), 1e-12);
}

// A capsule is a cylinder with two half spheres: about its middle, as a sphere cut in two and moved apart.
TEST(Mjcf, ShapesHaveTheMassOfTheirVolume) {
  const double r = 0.1, h = 0.3, density = 700;
  const Robot capsule = of_body("<geom type='capsule' size='0.1' fromto='0 -0.3 0 0 0.3 0' density='700'/>");
  const double rod = density * M_PI * r * r * 2 * h, ball = density * 4.0 / 3 * M_PI * r * r * r;
  const Mass& mass = capsule.links[0].mass;
  EXPECT_NEAR(mass.mass, rod + ball, 1e-9);
  EXPECT_NEAR(mass.inertia(1, 1), rod * r * r / 2 + ball * 0.4 * r * r, 1e-9) << "along y";
  const double across = rod * (r * r / 4 + h * h / 3) + ball * (0.4 * r * r + h * h + 0.75 * h * r);
  EXPECT_NEAR(mass.inertia(0, 0), across, 1e-9);
  EXPECT_NEAR(mass.inertia(2, 2), across, 1e-9);
  EXPECT_EQ(capsule.links[0].shapes.size(), 3u);
  const Robot ellipsoid = of_body("<geom type='ellipsoid' size='0.1 0.2 0.3'/>");
  const double all = 1000 * 4.0 / 3 * M_PI * 0.006;
  EXPECT_NEAR(ellipsoid.links[0].mass.mass, all, 1e-9);
  EXPECT_NEAR(ellipsoid.links[0].mass.inertia(0, 0), all / 5 * 0.13, 1e-9);
  EXPECT_THAT(ellipsoid.warnings[0], testing::HasSubstr("it touches as the box around it"));
  const Robot given = of_body("<geom size='0.2'/><inertial pos='0 0 0.5' mass='2' fullinertia='1 2 2.5 0.1 0.2 0.3'/>");
  EXPECT_EQ(given.links[0].mass.mass, 2);
  EXPECT_EQ(given.links[0].mass.centre.z(), 0.5);
  EXPECT_EQ(given.links[0].mass.inertia(1, 2), 0.3);
  const Robot ignored = of_body("<geom size='0.2'/><inertial pos='0 0 0.5' mass='2' diaginertia='1 2 2.5'/>",
                                "<compiler inertiafromgeom='true'/>");
  EXPECT_NEAR(ignored.links[0].mass.mass, 1000 * 4.0 / 3 * M_PI * 0.008, 1e-9);
}

// A joint beside its body's frame: the link's frame is the joint's, all that the body has moves back by as much.
TEST(Mjcf, JointsHaveTheirPlaceAndLimits) {
  const Robot robot = of_body(
      "<geom size='0.2'/><body name='arm' pos='1 0 0'><joint name='h' type='hinge' pos='0 0 0.5' axis='0 2 0' "
      "limited='true' range='-90 45' "
      "damping='0.2' frictionloss='0.1'/><geom size='0.1' pos='0 0 -0.2'/><body name='drawer'><joint type='slide' "
      "axis='1 0 0' "
      "range='-0.1 0.2' limited='true'/><geom size='0.1'/><body name='head'><joint type='ball'/><geom "
      "size='0.1'/></body></body></body>");
  ASSERT_EQ(robot.joints.size(), 3u);
  const Joint& hinge = robot.joints[0];
  EXPECT_EQ(hinge.name, "h");
  EXPECT_EQ(hinge.kind, JointKind::revolute);
  EXPECT_NEAR(hinge.lower, -M_PI / 2, 1e-12);
  EXPECT_NEAR(hinge.upper, M_PI / 4, 1e-12);
  EXPECT_EQ(hinge.axis, Vector3d::UnitY());
  EXPECT_EQ(hinge.damping, 0.2);
  EXPECT_EQ(hinge.friction, 0.1);
  EXPECT_LT((hinge.origin.translation() - Vector3d(1, 0, 0.5)).norm(), 1e-12);
  EXPECT_NEAR(robot.links[1].mass.centre.z(), -0.7, 1e-12);
  EXPECT_EQ(robot.joints[1].kind, JointKind::prismatic);
  EXPECT_EQ(robot.joints[1].upper, 0.2) << "in metres, whatever the angles are in";
  EXPECT_NEAR(robot.joints[1].origin.translation().z(), -0.5, 1e-12);
  EXPECT_EQ(robot.joints[1].name, "drawer_joint");
  EXPECT_EQ(robot.joints[2].kind, JointKind::ball);
  const Mass whole = whole_mass(robot);
  EXPECT_NEAR(whole.centre.x(), 3 * 0.001 / (3 * 0.001 + 0.008), 1e-12);
}

TEST(Mjcf, ClassesInheritAndBodiesHandThemDown) {
  const Robot robot = of_body("<geom/><body childclass='inner'><geom/><body><geom class='outer'/></body></body>",
                              "<default><geom size='0.3'/><default class='outer'><geom density='100'/><default "
                              "class='inner'><geom size='0.1'/></default></default></default>");
  const auto ball = [](double r, double density) { return density * 4.0 / 3 * M_PI * r * r * r; };
  EXPECT_NEAR(robot.links[0].mass.mass, ball(0.3, 1000), 1e-9);
  EXPECT_NEAR(robot.links[1].mass.mass, ball(0.1, 100), 1e-9);
  EXPECT_NEAR(robot.links[2].mass.mass, ball(0.3, 100), 1e-9);
}

TEST(Mjcf, WhatIsNotTakenIsListed) {
  const Robot robot = read(
      "<mujoco>\n<worldbody><body><geom size='0.1' friction='1 0 0'/><body><joint armature='0.1' stiffness='2'/><geom "
      "size='0.1'/></body>"
      "</body></worldbody><sensor/><tendon/></mujoco>");
  ASSERT_EQ(robot.warnings.size(), 2u);
  EXPECT_THAT(robot.warnings[0],
              testing::HasSubstr(":2: the robot's <body> is fixed to the world in MuJoCo; here it moves freely"));
  EXPECT_THAT(robot.warnings[1],
              testing::HasSubstr(
                  "of this MuJoCo model are not taken: <sensor>, <tendon>, armature of <joint>, friction of <geom> (a "
                  "drive has its own), stiffness of <joint>"));
}

// Physics of the world, and a mass for the whole: a run has its own.
TEST(Mjcf, OptionsOfTheWholeAreListed) {
  const auto said = [](const std::string& before) { return of_body("<geom size='0.1'/>", before).warnings; };
  EXPECT_THAT(said("<option gravity='0 0 -9.81' solver='CG' iterations='5'/>"), testing::IsEmpty());
  EXPECT_THAT(
      said("<option gravity='0 0 -1.62' timestep='0.002'/><compiler settotalmass='10'/>"),
      testing::ElementsAre(testing::EndsWith(
          "of this MuJoCo model are not taken: gravity=\"0 0 -1.62\" of <option> (a world has 9.81 m/s2 "
          "downwards), settotalmass of <compiler>, timestep of <option> (expected step=\"0.002\" of the physics "
          "in the world)")));
  EXPECT_THAT(said("<option><flag gravity='disable'/></option>"),
              testing::ElementsAre(testing::HasSubstr("not taken: gravity of <option>")));
}

TEST(Mjcf, ARangeWithinATurnOfRadiansIsAskedAbout) {
  const auto warnings = [](const std::string& compiler, const std::string& range) {
    const Files files;
    const std::string path =
        files.write("arm.xml", "<mujoco>" + compiler +
                                   "<worldbody><body name='b'><freejoint/><geom size='1'/>\n<body name='c'>"
                                   "<joint name='j' range='" +
                                   range +
                                   "' limited='true'/><geom size='1'/></body></body></worldbody>"
                                   "</mujoco>");
    std::string result;
    for (const std::string& warning : read_robot(path).warnings)
      if (warning.find("joint 'j'") != warning.npos) result += warning.substr(path.size());
    return result;
  };
  EXPECT_EQ(warnings("", "-1.57 1.57"),
            ":2: joint 'j': its range of -1.57 to 1.57 is in degrees, MuJoCo's default; are these radians? expected "
            "range=\"-89.95 89.95\", or <compiler angle=\"radian\"/> of all angles");
  EXPECT_EQ(warnings("", "-90 90"), "");
  EXPECT_EQ(warnings("", "-5 5"), "");
  EXPECT_EQ(warnings("<compiler angle='degree'/>", "-1.57 1.57"), "");
  EXPECT_EQ(warnings("<compiler angle='radian'/>", "-1.57 1.57"), "");
}

TEST(Mjcf, DegreesWhereTheFileHasRadiansAreAskedAbout) {
  const auto warnings = [](const std::string& compiler, const std::string& euler) {
    const Files files;
    const std::string path = files.write("arm.xml", "<mujoco>" + compiler +
                                                        "<worldbody><body name='b'><freejoint/><geom size='1'/>\n"
                                                        "<body name='c' euler='" +
                                                        euler +
                                                        "'><joint name='j'/><geom size='1'/></body></body></worldbody>"
                                                        "</mujoco>");
    std::string result;
    for (const std::string& warning : read_robot(path).warnings)
      if (warning.find("euler") != warning.npos) result += warning.substr(path.size());
    return result;
  };
  const std::string radians = "<compiler angle='radian'/>";
  EXPECT_EQ(warnings(radians, "90 0 -45"),
            ":2: <body> of body 'b': euler=\"90 0 -45\" is beyond a whole turn in radians, which the file has "
            "(angle=\"radian\"); "
            "are these degrees? expected euler=\"1.571 0 -0.7854\", or <compiler angle=\"degree\"/> of all angles");
  EXPECT_EQ(warnings(radians, "1.5707963 0 -3.14"), "");
  EXPECT_EQ(warnings("", "90 0 -45"), "");
  for (const auto& [given, degrees] : {std::pair("1.5708 0 0", "90 0 0"), {"0 -0.785 3.14", "0 -45 179.9"}})
    EXPECT_EQ(warnings("", given), ":2: <body> of body 'b': euler=\"" + std::string(given) +
                                       "\" is in degrees, MuJoCo's default, and looks like radians; expected euler=\"" +
                                       degrees + "\", or <compiler angle=\"radian\"/> of all angles");
  for (const char* of_degrees : {"1.5 0 0", "2 3 0", "0.5 -12.3 0"}) EXPECT_EQ(warnings("", of_degrees), "");
}

TEST(MjcfFault, IsNamedWithItsLine) {
  const auto fault = [](const std::string& text) {
    const Files files;
    const std::string path = files.write("bad.xml", text);
    const std::string what = message_of([&] { read_robot(path); });
    return what.substr(std::min(what.size(), path.size()));
  };
  const auto body = [&](const std::string& inside) {
    return fault("<mujoco>\n<worldbody><body name='b'><freejoint/><geom size='1'/>\n" + inside +
                 "</body></worldbody></mujoco>");
  };
  EXPECT_EQ(fault("<mujoco/>"), ":1: has no <worldbody>; expected one with the robot's <body>");
  EXPECT_EQ(fault("<mujoco>\n<include file='a.xml'/></mujoco>").substr(0, 40),
            ":2: <include> is not read; save the file");
  EXPECT_EQ(body("<geom siez='1'/>"), ":3: <geom> has no attribute 'siez'; did you mean 'size'?");
  EXPECT_EQ(body("<geom size='a'/>"), ":3: <geom> size=\"a\" is wrong; expected 1 to 3 numbers");
  EXPECT_EQ(body("<geom size='-1'/>"), ":3: <geom> size=\"-1\" is not above 0");
  EXPECT_EQ(body("<geom class='weel' size='1'/>"), ":3: <geom> has a class 'weel' that no <default> has");
  EXPECT_EQ(body("<body name='c'><joint/><joint/><geom size='1'/></body>"),
            ":3: <body> 'c' has a second <joint>; a link has one here: expected a <body> between them");
  EXPECT_EQ(body("<body name='c'><joint type='hing'/><geom size='1'/></body>"),
            ":3: <joint> type=\"hing\" is wrong here; expected hinge, slide or ball; did you mean 'hinge'?");
  EXPECT_EQ(body("<body name='c'><joint/></body>"), ":3: link 'c' moves by joint 'c_joint' but has no <inertial>");
  EXPECT_EQ(body("<inertial mass='1' diaginertia='1 1 5'/>").substr(0, 14), ":3: body 'b': ");
  EXPECT_EQ(
      fault("<mujoco>\n<worldbody><body><geom size='1'/></body>\n<body/></worldbody></mujoco>"),
      ":3: <worldbody> has a second <body>; a model is one robot: expected one <body>, and the other as a <mesh> or a "
      "<robot> of its own in the world");
  EXPECT_EQ(fault("<mujoco><worldbody><body name='b'><geom size='1'/></body></worldbody><actuator>\n<motor "
                  "joint='x'/></actuator></mujoco>"),
            ":2: <motor> joint 'x' is not known");
}

}  // namespace
}  // namespace muster::description
