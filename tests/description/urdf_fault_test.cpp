// Faults of a URDF are reported with line and link; nothing is dropped in silence.
#include <gtest/gtest.h>

#include "description/robot.hpp"
#include "files.hpp"

namespace muster::description {
namespace {

const std::string mass =
    "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>";

struct Case {
  const char* name;
  std::string text;     // in <robot>, from line 2 on
  std::string message;  // after "FILE:"
};

std::string link(const std::string& name, const std::string& inside) {
  return "<link name='" + name + "'>" + inside + "</link>\n";
}
std::string joint(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& type = "fixed", const std::string& inside = "") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent + "'/><child link='" + child + "'/>" +
         inside + "</joint>\n";
}
std::string inertial(const std::string& value, const std::string& x, const std::string& y, const std::string& z) {
  return "<inertial><mass value='" + value + "'/><inertia ixx='" + x + "' ixy='0' ixz='0' iyy='" + y +
         "' iyz='0' izz='" + z + "'/></inertial>";
}
std::string wheels(const std::string& attributes, const std::string& axis = "0 1 0", const std::string& y = "0.1",
                   const std::string& right = "") {
  return link("b", mass) + link("l", mass) + link("r", mass + right) +
         joint("jl", "b", "l", "continuous", "<origin xyz='0 " + y + " 0'/><axis xyz='" + axis + "'/>") +
         joint("jr", "b", "r", "continuous", "<origin xyz='0 -0.1 0'/><axis xyz='0 1 0'/>") + "<muster><differential " +
         attributes + "/></muster>\n";
}
const std::string good =
    "left='jl' right='jr' wheel_radius='0.05' wheel_base='0.2' max_torque='1' max_speed='9' friction='0.8'";

std::string round(const std::string& geometry, const std::string& angles) {
  return "<collision><origin rpy='" + angles + "'/><geometry>" + geometry + "</geometry></collision>";
}

// A joint and its <muster>, from line 6 on.
std::string ball(const std::string& inside, const std::string& type = "floating") {
  return link("a", mass) + link("b", mass) + joint("j", "a", "b", type, "<axis xyz='0 0 1'/>") + "<muster>\n" + inside +
         "</muster>\n";
}

// Six legs of radius 0.05 on hips at the given height; `last` is the sixth's declaration.
std::string legs(const std::string& attributes, const std::string& last = "<leg joint='j6' tripod='2'/>",
                 const std::string& height = "0.1", const std::string& sixth = mass) {
  std::string text = link("b", mass);
  const char* places[] = {"1 1", "0 1", "-1 1", "1 -1", "0 -1", "-1 -1"};
  for (int i = 1; i <= 6; ++i) {
    const std::string number = std::to_string(i);
    text += link("l" + number, i == 6 ? sixth : mass) +
            joint("j" + number, "b", "l" + number, "continuous",
                  std::string("<origin xyz='") + places[i - 1] + " " + height + "'/><axis xyz='0 1 0'/>");
  }
  return text + "<muster>\n<legs " + attributes +
         ">\n<leg joint='j1' tripod='1'/><leg joint='j2' tripod='2'/><leg joint='j3' tripod='1'/>"
         "<leg joint='j4' tripod='2'/><leg joint='j5' tripod='1'/>\n" +
         last + "\n</legs></muster>\n";
}
const std::string good_legs =
    "radius='0.05' position_gain='9' rate_gain='1' max_torque='1' max_speed='9' friction='0.8'";

// A laser on link 'a', from line 5 on: attributes of <sensor> and its <horizontal>, and <muster>.
std::string laser(const std::string& horizontal, const std::string& muster = "",
                  const std::string& attributes = "update_rate='10'", const std::string& parent = "link='a'") {
  return link("a", mass) + link("b", mass) + joint("j", "a", "b", "continuous", "<axis xyz='0 0 1'/>") +
         "<sensor name='s' " + attributes + ">\n<parent " + parent + "/>\n<ray>\n<horizontal " + horizontal +
         "/></ray></sensor>\n<muster>" + muster + "</muster>\n";
}

const Case cases[] = {
    {"laser_without_rate", laser("", "", ""), "5: <sensor> has no attribute 'update_rate'"},
    {"laser_rate_of_zero", laser("", "", "update_rate='0'"),
     "5: <sensor> update_rate=\"0\" is wrong; expected a number above 0"},
    {"laser_misspelt", laser("", "", "update_rat='10'"),
     "5: <sensor> has no attribute 'update_rat'; did you mean 'update_rate'?"},
    {"laser_on_no_link", laser("", "", "update_rate='10'", "link='c'"),
     "6: sensor 's': link 'c' is not known; did you mean 'a'?"},
    {"laser_on_a_link_of_another_name", laser("", "", "update_rate='10'", "link='laser_frame'"),
     "6: sensor 's': link 'laser_frame' is not known; expected one of its links: a, b"},
    {"laser_on_what_moves", laser("", "", "update_rate='10'", "link='b'"),
     "6: sensor 's' is not on the robot's body: a joint between them moves"},
    {"laser_samples", laser("samples='2.5'"),
     "8: sensor 's': <horizontal> samples=\"2.5\" is wrong; expected a whole number from 1 to 100000"},
    {"laser_angle_is_no_number", laser("samples='3' min_angle='-1' max_angle='1rad'"),
     "8: sensor 's': <horizontal> max_angle=\"1rad\" is wrong; expected a number"},
    {"laser_angles_reversed", laser("samples='3' min_angle='1' max_angle='-1'"),
     "8: sensor 's': <horizontal> max_angle is not above min_angle; a single ray has one angle"},
    {"laser_single_ray_of_two_angles", laser("min_angle='-1' max_angle='1'"),
     "8: sensor 's': <horizontal> max_angle is not above min_angle; a single ray has one angle"},
    {"laser_beyond_a_turn", laser("samples='3' min_angle='-4' max_angle='4'"),
     "8: sensor 's': <horizontal> sweeps more than a whole turn"},
    {"laser_in_degrees", laser("samples='3' min_angle='-120' max_angle='120'"),
     "8: sensor 's': <horizontal> goes beyond a whole turn, from -120 to 120 rad; are these degrees? expected "
     "min_angle=\"-2.094\" max_angle=\"2.094\""},
    {"laser_between_samples", laser("samples='3' min_angle='-1' max_angle='1' resolution='2'"),
     "8: sensor 's': <horizontal> resolution is not 1: a range for each ray"},
    {"laser_of_many_planes", laser("/><vertical samples='16'"),
     "8: sensor 's': <vertical> is more than one ray at angle 0; a laser's rays lie in one plane"},
    {"laser_twice", laser("") + "<sensor name='s' update_rate='1'/>", "10: sensor 's' is there twice"},
    {"laser_range_of_another", laser("", "<laser sensor='t' max_range='4'/>"),
     "9: <laser> sensor 't' is not known, or has no <ray>; did you mean 's'?"},
    {"parent_as_in_sdf",
     link("a", mass) + link("b", mass) + "<joint name='j' type='fixed'><parent>a</parent><child link='b'/></joint>",
     "4: <parent> has no attribute 'link'; expected <parent link=\"a\"/>"},
    {"laser_without_range", laser("", "<laser sensor='s'/>"), "9: <laser> has no attribute 'max_range'"},
    {"laser_ranges_reversed", laser("", "<laser sensor='s' max_range='4' min_range='5'/>"),
     "9: sensor 's': <laser> min_range is not below max_range"},
    {"laser_range_below_0", laser("", "<laser sensor='s' max_range='4' min_range='-1'/>"),
     "9: sensor 's': <laser> min_range=\"-1\" is below 0"},
    {"laser_range_twice", laser("", "<laser sensor='s' max_range='4'/><laser sensor='s' max_range='5'/>"),
     "9: sensor 's': <laser> has its range already"},
    {"laser_too_coarse", laser("", "<laser sensor='s' max_range='4' resolution='5'/>"),
     "9: sensor 's': <laser> resolution is not between a billionth of max_range and max_range"},
    {"laser_too_often", laser("", "", "update_rate='1e7'"), "5: sensor 's': update_rate is above 1000000 Hz"},
    {"laser_range_as_in_sdf", laser("/><range min='0'"),
     "8: <ray> has no element <range>; expected <horizontal> or <vertical>"},
    {"laser_origin_misspelt", laser("", "", "update_rate='10'", "link='a'/><orign xyz='1 0 0'"),
     "6: <sensor> has no element <orign>; expected <parent>, <origin> or <ray>; did you mean 'origin'?"},
    {"laser_two_origins", laser("", "", "update_rate='10'", "link='a'/><origin/><origin"),
     "6: <sensor> has a second <origin>"},
    {"negative_mass", link("a", inertial("-3", "1", "1", "1")),
     "2: link 'a': <mass value=\"-3\"/>; expected the mass in kg, above 0, or no <inertial> if the link is a frame "
     "without mass"},
    {"no_mass", link("a", inertial("0", "1", "1", "1")),
     "2: link 'a': <mass value=\"0\"/>; expected the mass in kg, above 0, or no <inertial> if the link is a frame "
     "without mass"},
    {"indefinite_inertia", link("a", inertial("1", "-1", "1", "1")),
     "2: link 'a': inertia is not positive definite: its principal moments are -1, 1 and 1 kg m2, each of which is "
     "above 0 "
     "in a body"},
    {"impossible_inertia", link("a", inertial("1", "1", "1", "3")),
     "2: link 'a': inertia breaks the triangle inequality: of its principal moments 1, 1 and 3 kg m2 the largest is 50 "
     "% "
     "above the sum of the others; no body has such moments"},
    {"unit_in_mass", link("a", inertial("2.5kg", "1", "1", "1")),
     "2: link 'a': <mass> value=\"2.5kg\" is wrong; expected a number"},
    {"nan_mass", link("a", inertial("nan", "1", "1", "1")),
     "2: link 'a': <mass> value=\"nan\" is wrong; expected a number"},
    {"huge_mass", link("a", inertial("1e400", "1", "1", "1")),
     "2: link 'a': <mass> value=\"1e400\" is wrong; expected a number"},
    {"decimal_comma", link("a", inertial("2,5", "1", "1", "1")),
     "2: link 'a': <mass> value=\"2,5\" is wrong; expected a number"},
    {"inertial_without_mass", link("a", "<inertial/>"), "2: link 'a': <inertial> has no <mass>"},
    {"two_numbers_for_three", link("a", "") + link("b", "") + joint("j", "a", "b", "fixed", "<origin xyz='1 2'/>"),
     "4: joint 'j': <origin> xyz=\"1 2\" is wrong; expected 3 numbers"},
    {"negative_radius", link("a", "<collision><geometry><sphere radius='-1'/></geometry></collision>"),
     "2: link 'a': the radius of a sphere is not above 0"},
    {"shape_without_geometry", link("a", "<collision><origin xyz='0 0 1'/></collision>"),
     "2: link 'a': <collision> has no <geometry>"},
    {"colour_of_bytes", link("a", "") + "<material name='m'>\n<color rgba='128 128 128 255'/></material>\n",
     "4: <color> rgba=\"128 128 128 255\": expected four numbers from 0 to 1"},
    {"limits_out_of_order",
     link("a", mass) + link("b", mass) +
         joint("j", "a", "b", "revolute", "<limit lower='2' upper='1' effort='1' velocity='1'/>"),
     "4: joint 'j': lower limit is above the upper one; are they exchanged?"},
    {"no_limits", link("a", mass) + link("b", mass) + joint("j", "a", "b", "prismatic"),
     "4: joint 'j' has no <limit>; a prismatic joint needs one"},
    {"zero_axis", link("a", mass) + link("b", mass) + joint("j", "a", "b", "continuous", "<axis xyz='0 0 0'/>"),
     "4: joint 'j': axis has no length"},
    {"cycle_beside_the_root",
     link("a", mass) + link("b", mass) + link("c", mass) + joint("j1", "b", "c") + joint("j2", "c", "b"),
     "3: link 'b' is on a cycle of joints; expected one tree from 'a'"},
    {"cycle_of_all", link("a", mass) + link("b", mass) + joint("j1", "a", "b") + joint("j2", "b", "a"),
     "2: every link has a parent: the joints form a cycle"},
    {"two_parents",
     link("a", mass) + link("b", mass) + link("c", mass) + joint("j1", "a", "b") + joint("j2", "a", "c") +
         joint("j3", "b", "c"),
     "7: link 'c' is the <child> of two joints, 'j2' (line 6) and 'j3'; expected one"},
    {"parent_and_child_exchanged",
     link("a", mass) + link("b", mass) + link("c", mass) + joint("j1", "b", "a") + joint("j2", "c", "a"),
     "6: link 'a' is the <child> of two joints, 'j1' (line 5) and 'j2'; expected one: are <parent> and <child> "
     "exchanged? expected <parent link=\"a\"/> and <child link=\"c\"/>"},
    {"a_child_that_is_copied",
     link("a", mass) + link("b", mass) + link("c", mass) + joint("j1", "a", "b") + joint("j2", "a", "b"),
     "6: link 'b' is the <child> of two joints, 'j1' (line 5) and 'j2'; expected one: link 'c' is in no joint; is it "
     "meant here?"},
    {"two_roots", link("a", mass) + link("b", mass),
     "3: link 'b' is a second root beside 'a'; expected one tree: a <joint> with <child link=\"b\"/>"},
    {"a_link_on_no_joint", link("a_lidar", mass) + link("base", mass) + link("c", mass) + joint("j", "base", "c"),
     "2: link 'a_lidar' is a second root beside 'base'; expected one tree: a <joint> with <child link=\"a_lidar\"/>"},
    {"words_of_a_name_in_another_order",
     link("base", mass) + link("wheel_left_link", mass) + joint("j", "base", "left_wheel_link"),
     "4: joint 'j': link 'left_wheel_link' is not known; did you mean 'wheel_left_link'?"},
    {"mimic_of_itself",
     link("a", mass) + link("b", mass) + joint("j", "a", "b", "continuous", "<axis xyz='0 0 1'/><mimic joint='j'/>"),
     "4: joint 'j': mimics itself"},
    {"unknown_link", link("a", mass) + joint("j", "a", "bb"),
     "3: joint 'j': link 'bb' is not known; did you mean 'a'?"},
    {"unknown_joint_type", link("a", mass) + link("b", mass) + joint("j", "a", "b", "revolut"),
     "4: joint 'j': type 'revolut' is not known; expected fixed, revolute, continuous, prismatic, floating or planar; "
     "did you mean "
     "'revolute'?"},
    {"same_link_twice", link("a", mass) + link("a", mass),
     "3: link 'a' is there twice; first in line 2; expected another name for one of them"},
    {"unknown_element", "<lnk name='a'/>", "2: <lnk> is not known in <robot>; did you mean 'link'?"},
    {"unit_beside_mass", link("a", "<inertial>\n<mass value='0.4' unit='kg'/></inertial>"),
     "3: <mass> has no attribute 'unit'; expected 'value'"},
    {"inertia_misspelt", link("a", "<inertial><mass value='1'/><inertia ixx='1' ixz='0' ixyy='0'/></inertial>"),
     "2: <inertia> has no attribute 'ixyy'; did you mean 'ixy'?"},
    {"friction_misspelt",
     link("a", mass) + link("b", mass) + joint("j", "a", "b", "fixed", "\n<dynamics damping='0.005' frction='0.3'/>"),
     "5: <dynamics> has no attribute 'frction'; did you mean 'friction'?"},
    {"limit_misspelt",
     link("a", mass) + link("b", mass) +
         joint("j", "a", "b", "revolute", "\n<limit loewr='1' effort='1' velocity='1'/>"),
     "5: <limit> has no attribute 'loewr'; did you mean 'lower'?"},
    {"colour_of_a_box", link("a", "<collision>\n<geometry>\n<box size='1 1 1' colour='red'/></geometry></collision>"),
     "4: <box> has no attribute 'colour'; expected 'size'"},
    {"origin_misspelt", link("a", "<collision>\n<origin xzy='1 1 1'/></collision>"),
     "3: <origin> has no attribute 'xzy'; did you mean 'xyz'?"},
    {"link_misspelt_in_parent",
     link("a", mass) + "<joint name='j' type='fixed'>\n<parent lnk='a'/><child link='a'/></joint>",
     "4: <parent> has no attribute 'lnk'; did you mean 'link'?"},
    {"attribute_of_inertial", link("a", "<inertial mass='1'/>"), "2: <inertial> has no attribute 'mass'"},
    {"collision_misspelt", link("a", "\n<colision/>"),
     "3: <link> has no element <colision>; expected <inertial>, <visual> or <collision>; did you mean 'collision'?"},
    {"two_masses", link("a", "<inertial><mass value='1'/>\n<mass value='2'/></inertial>"),
     "3: <inertial> has a second <mass>"},
    {"shape_misspelt", link("a", "<collision><geometry>\n<bx size='1 1 1'/></geometry></collision>"),
     "3: <geometry> has no element <bx>; expected <box>, <cylinder>, <sphere> or <mesh>; did you mean 'box'?"},
    {"shape_misspelt_where_it_is_drawn", link("a", "<visual><geometry>\n<cone/></geometry></visual>"),
     "3: <geometry> has no element <cone>; expected <box>, <cylinder>, <sphere> or <mesh>"},
    {"no_shape", link("a", "<collision>\n<geometry/></collision>"),
     "3: <geometry> is empty; expected <box>, <cylinder>, <sphere> or <mesh>"},
    {"moving_without_mass", link("a", mass) + link("b", "") + joint("j", "a", "b", "continuous", "<axis xyz='0 0 1'/>"),
     "3: link 'b' moves by joint 'j' but has no <inertial>"},
    {"drive_of_unknown_joint",
     wheels("left='jll' right='jr' wheel_radius='0.05' wheel_base='0.2' max_torque='1' max_speed='9' friction='0.8'"),
     "7: <differential> left: joint 'jll' is not known; did you mean 'jl'?"},
    {"drive_without_torque",
     wheels("left='jl' right='jr' wheel_radius='0.05' wheel_base='0.2' max_speed='9' friction='0.8'"),
     "7: <differential> has no attribute 'max_torque'"},
    {"drive_attribute_misspelt", wheels(good + " max_sped='1'"),
     "7: <differential> has no attribute 'max_sped'; did you mean 'max_speed'?"},
    {"drive_number",
     wheels("left='jl' right='jr' wheel_radius='5cm' wheel_base='0.2' max_torque='1' max_speed='9' friction='0.8'"),
     "7: <differential> wheel_radius=\"5cm\" is wrong; expected a number above 0"},
    {"wheel_askew", wheels(good, "0.1 1 0"),
     "5: joint 'jl', a wheel of <differential> (line 7), does not turn about the body's +y axis: its own is 5.711 "
     "degrees off; expected <axis xyz=\"0 1 0\"/>"},
    {"wheel_base_contradicts_joints", wheels(good, "0 1 0", "0.11"),
     "7: <differential> joint 'jl' is not half a wheel_base from the body's x axis (left: +y, right: -y): it "
     "is at y = 0.11 m, expected 0.1"},
    {"wheel_base_in_millimetres",
     wheels("left='jl' right='jr' wheel_radius='50' wheel_base='200' max_torque='1' max_speed='9' friction='0.8'"),
     "7: <differential> joint 'jl' is not half a wheel_base from the body's x axis (left: +y, right: -y): it is at y = "
     "0.1 m, expected 100; is wheel_base=\"200\" in millimetres? expected 0.2"},
    {"parent_and_child_of_a_wheel_exchanged",
     link("a", mass) + link("b", mass) + link("c", mass) +
         joint("jl", "b", "a", "continuous", "<origin xyz='0 0.1 0'/><axis xyz='0 1 0'/>") +
         joint("jr", "a", "c", "continuous", "<axis xyz='0 1 0'/>") + "<muster><differential " + good + "/></muster>",
     "5: joint 'jl', a wheel of <differential> (line 7), carries link 'a', on which is the wheel of joint 'jr'; are "
     "<parent> and <child> of 'jl' exchanged?"},
    {"wheel_base_and_radius_exchanged",
     wheels("left='jl' right='jr' wheel_radius='0.2' wheel_base='0.05' max_torque='1' max_speed='9' friction='0.8'"),
     "7: <differential> joint 'jl' is not half a wheel_base from the body's x axis (left: +y, right: -y): it is at y = "
     "0.1 m, expected 0.025; are wheel_radius and wheel_base exchanged?"},
    {"sides_exchanged",
     wheels("left='jr' right='jl' wheel_radius='0.05' wheel_base='0.2' max_torque='1' max_speed='9' friction='0.8'"),
     "7: <differential> joint 'jr' is not half a wheel_base from the body's x axis (left: +y, right: -y): it is at y = "
     "-0.1 m, expected 0.1; are left and right exchanged?"},
    {"wheel_radius_in_centimetres",
     wheels("left='jl' right='jr' wheel_radius='5' wheel_base='0.2' max_torque='1' max_speed='9' friction='0.8'",
            "0 1 0", "0.1", round("<sphere radius='0.05'/>", "0 0 0")),
     "7: <differential> wheel_radius=\"5\" contradicts the wheel of joint 'jr', whose collision shape has a radius of "
     "0.05; is wheel_radius=\"5\" in centimetres? expected 0.05"},
    {"wheel_radius_contradicts_cylinder",
     wheels(good, "0 1 0", "0.1", round("<cylinder radius='0.09' length='0.02'/>", "1.5708 0 0")),
     "7: <differential> wheel_radius=\"0.05\" contradicts the wheel of joint 'jr', whose collision shape has a radius "
     "of 0.09; expected wheel_radius=\"0.09\""},
    {"wheel_shape_in_millimetres",
     wheels(good, "0 1 0", "0.1", round("<cylinder radius='50' length='20'/>", "1.5708 0 0")),
     "7: <differential> wheel_radius=\"0.05\" contradicts the wheel of joint 'jr', whose collision shape has a radius "
     "of 50; is the shape in millimetres? expected 0.05 there"},
    {"wheel_radius_contradicts_sphere", wheels(good, "0 1 0", "0.1", round("<sphere radius='0.04'/>", "0 0 0")),
     "7: <differential> wheel_radius=\"0.05\" contradicts the wheel of joint 'jr', whose collision shape has a radius "
     "of 0.04; expected wheel_radius=\"0.04\""},
    {"joints_with_commas",
     wheels("left='jl,jk' right='jr' wheel_radius='0.05' wheel_base='0.2' max_torque='1' max_speed='9' friction='0.8'"),
     "7: <differential> left=\"jl,jk\" has commas between its joints; expected blanks: left=\"jl jk\""},
    {"wheel_radius_is_the_diameter",
     wheels(good, "0 1 0", "0.1", round("<cylinder radius='0.025' length='0.02'/>", "1.5708 0 0")),
     "7: <differential> wheel_radius=\"0.05\" contradicts the wheel of joint 'jr', whose collision shape has a radius "
     "of 0.025; is it the diameter? expected wheel_radius=\"0.025\""},
    {"another_drive", link("a", mass) + "<muster><tracks/></muster>",
     "3: <tracks> is not known in <muster>; expected <differential>, <ackermann>, <mecanum>, <quadrotor>, <legs>, "
     "<ball> or <laser>"},
    {"ball_as_a_type", link("a", mass) + link("b", mass) + joint("j", "a", "b", "ball"),
     "4: joint 'j': URDF has no type 'ball'; expected type 'floating' and <muster><ball joint=\"j\"/></muster>"},
    {"spherical", link("a", mass) + link("b", mass) + joint("j", "a", "b", "spherical"),
     "4: joint 'j': URDF has no type 'spherical'; expected type 'floating' and <muster><ball joint=\"j\"/></muster>"},
    {"ball_of_unknown_joint", ball("<ball joint='k'/>"), "6: <ball> joint: joint 'k' is not known; did you mean 'j'?"},
    {"ball_of_no_joint", ball("<ball/>"), "6: <ball> has no attribute 'joint'"},
    {"ball_attribute_misspelt", ball("<ball joint='j' limit='1'/>"),
     "6: <ball> has no attribute 'limit'; expected 'joint'"},
    {"ball_with_limits", ball("<ball joint='j'><limit/></ball>"), "6: <ball> has no element <limit>"},
    {"ball_twice", ball("<ball joint='j'/>\n<ball joint='j'/>"), "7: <ball> joint 'j' is a ball already"},
    {"ball_in_a_second_extension", ball("<ball joint='j'/></muster>\n<muster><ball joint='j'/>"),
     "7: <ball> joint 'j' is a ball already"},
    {"ball_on_an_axis", ball("<ball joint='j'/>", "continuous"),
     "6: <ball> joint 'j' is continuous; expected type 'floating'"},
    {"ball_misspelt", ball("<bal joint='j'/>"),
     "6: <bal> is not known in <muster>; expected <differential>, <ackermann>, <mecanum>, <quadrotor>, <legs>, <ball> "
     "or <laser>; did you mean "
     "'ball'?"},
    {"ball_without_mass",
     link("a", mass) + link("b", "") + joint("j", "a", "b", "floating") + "<muster><ball joint='j'/></muster>",
     "3: link 'b' moves by joint 'j' but has no <inertial>"},
    {"wheel_on_a_ball",
     link("w", mass) + joint("jw", "b", "w", "floating") +
         wheels(
             "left='jw' right='jr' wheel_radius='0.05' wheel_base='0.2' max_torque='1' max_speed='9' friction='0.8'") +
         "<muster><ball joint='jw'/></muster>",
     "3: joint 'jw', a wheel of <differential> (line 9), is floating; expected type=\"continuous\""},
    {"negative_damping",
     link("a", mass) + link("b", mass) +
         joint("j", "a", "b", "continuous", "<axis xyz='0 0 1'/><dynamics damping='-1'/>"),
     "4: joint 'j': damping and friction must not be below 0"},
    {"restitution_above_one", link("a", mass) + "<muster restitution='1.1'/>",
     "3: <muster> restitution=\"1.1\" is wrong; expected a number from 0 to 1"},
    {"restitution_misspelt", link("a", mass) + "<muster restitutoin='0.5'/>",
     "3: <muster> has no attribute 'restitutoin'; did you mean 'restitution'?"},
    {"leg_without_gain", legs("radius='0.05' rate_gain='1' max_torque='1' max_speed='9' friction='0.8'"),
     "16: <legs> has no attribute 'position_gain'"},
    {"legs_attribute_misspelt", legs(good_legs + " stifness='1'"),
     "16: <legs> has no attribute 'stifness'; did you mean 'stiffness'?"},
    {"damping_of_rigid_legs", legs(good_legs + " damping='1'"), "16: <legs> has a damping, but no stiffness"},
    {"leg_of_unknown_joint", legs(good_legs, "<leg joint='j7' tripod='2'/>"),
     "18: <leg> joint: joint 'j7' is not known; did you mean 'j1'?"},
    {"leg_twice", legs(good_legs, "<leg joint='j5' tripod='2'/>"), "18: <leg> joint 'j5' has a leg already"},
    {"third_tripod", legs(good_legs, "<leg joint='j6' tripod='3'/>"),
     "18: <leg> tripod=\"3\" is wrong; expected 1 or 2"},
    {"four_legs_and_two", legs(good_legs, "<leg joint='j6' tripod='1'/>"),
     "16: <legs> tripod 1 has 4 legs; expected 3"},
    {"five_legs", legs(good_legs, ""), "16: <legs> has 5 legs; expected 6"},
    {"foot", legs(good_legs, "<foot/>"), "18: <legs> has no element <foot>; expected <leg>"},
    {"hip_too_low", legs(good_legs, "", "0.09"),
     "17: <leg> joint 'j1' is not two radii above the ground, which is at z = 0 of the robot's frame"},
    {"leg_with_shape",
     legs(good_legs, "<leg joint='j6' tripod='2'/>", "0.1",
          mass + "<collision><geometry><sphere radius='1'/></geometry></collision>"),
     "18: <leg> joint 'j6' has a link with a <collision>; a leg is a half circle, and nothing else of it touches"},
    {"mesh_outside",
     link("a", "<collision><geometry><mesh filename='package://../../etc/passwd'/></geometry></collision>"),
     "2: link 'a': mesh 'package://../../etc/passwd' is in a ROS package; expected packages=\"DIR\" of the <robot> in "
     "the "
     "world, where DIR holds the folder '..'"},
    {"mesh_outside_by_path", link("a", "<collision><geometry><mesh filename='/etc/passwd'/></geometry></collision>"),
     "2: link 'a': mesh '/etc/passwd' is outside the allowed folder; expected a path relative to FOLDER"},
    {"inertia_impossible_for_a_box",
     link("a", inertial("12", "1", "1", "3") + "<collision><geometry><box size='1 1 1'/></geometry></collision>"),
     "2: link 'a': inertia breaks the triangle inequality: of its principal moments 1, 1 and 3 kg m2 the largest is 50 "
     "% "
     "above the sum of the others; no body has such moments; its collision shapes, filled evenly, give "
     "<inertial><origin "
     "xyz=\"0 0 0\"/><mass value=\"12\"/><inertia ixx=\"2\" ixy=\"0\" ixz=\"0\" iyy=\"2\" iyz=\"0\" "
     "izz=\"2\"/></inertial>"},
    {"xacro_element", "<xacro:property name='r' value='1'/>\n",
     "2: is xacro, not URDF: it has <xacro:property>; run xacro first: xacro FILE > OUT.urdf"},
    {"xacro_value", link("a", "<collision><geometry>\n<sphere radius='${2 * r}'/></geometry></collision>"),
     "3: is xacro, not URDF: it has \"${2 * r}\"; run xacro first: xacro FILE > OUT.urdf"},
    {"xacro_find", link("a", "<visual><geometry><mesh filename='$(find husky)/a.stl'/></geometry></visual>"),
     "2: is xacro, not URDF: it has \"$(find husky)\"; run xacro first: xacro FILE > OUT.urdf"},
    {"wheel_named_twice",
     wheels("left='jl jl' right='jr' wheel_radius='0.05' wheel_base='0.2' max_torque='1' max_speed='9' friction='0.8'"),
     "7: <differential> left has joint 'jl' twice"},
    {"wheels_uneven",
     link("w", mass) + joint("jw", "b", "w", "continuous", "<origin xyz='0.3 0.1 0'/><axis xyz='0 1 0'/>") +
         wheels("left='jl jw' right='jr' wheel_radius='0.05' wheel_base='0.2' max_torque='1' max_speed='9' "
                "friction='0.8'"),
     "9: <differential> has 2 wheels on the left and 1 on the right; expected as many"},
};

class UrdfFault : public testing::TestWithParam<Case> {};

TEST_P(UrdfFault, IsNamedWithItsLine) {
  Files files;
  const std::string path = files.write("bad.urdf", "<robot name='r'>\n" + GetParam().text + "</robot>\n");
  std::string message = GetParam().message;
  if (const auto at = message.find("FOLDER"); at != std::string::npos) {
    message.replace(at, 6, std::filesystem::path(path).parent_path().string());
  }
  if (const auto at = message.find("FILE"); at != std::string::npos) message.replace(at, 4, path);
  EXPECT_EQ(message_of([&] { read_robot(path); }), path + ":" + message);
}

INSTANTIATE_TEST_SUITE_P(All, UrdfFault, testing::ValuesIn(cases),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace muster::description
