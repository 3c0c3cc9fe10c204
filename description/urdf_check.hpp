// Checks the XML itself, with line numbers, for faults that urdfdom accepts in silence.
#pragma once

#include <tinyxml2.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "description/robot.hpp"

namespace muster::description {

// What a drive or a leg may differ from its joints before that is a mistake: [m], and of a unit vector.
constexpr double placement_tolerance = 1e-4;
constexpr double axis_tolerance = 1e-6;

// A place in a URDF file, for messages.
struct Source {
  std::string file;
  [[noreturn]] void fail(int line, const std::string& message) const;
};

// Links and joints by name, with their lines; `order` lists joints so that parents come before children.
struct Outline {
  std::map<std::string, int> link_lines, joint_lines;
  std::map<std::string, int> mass_lines;  // of links with an <inertial>
  std::vector<std::string> order;
  std::string root;
};

// Parses the text under limits on depth and tag size; no DTD, no entities, one root element.
void parse_xml(const Source& source, const std::string& text, tinyxml2::XMLDocument& document);
// The same, with <robot> as root.
void parse_urdf(const Source& source, const std::string& text, tinyxml2::XMLDocument& document);

// Checks a <link> or <joint> and all inside it: only elements and attributes of URDF. <visual> is skipped.
void check_names(const Source& source, const tinyxml2::XMLElement& element);
// Checks that every number is one, that every required attribute is present, and that the links form a tree.
Outline check_urdf(const Source& source, const tinyxml2::XMLElement& robot);

// Reads <muster> into a robot whose links, joints and sensors are complete: restitution, balls, ranges of lasers, and
// at most one drive.
void read_muster(const Source& source, const tinyxml2::XMLElement& element, Robot& robot);
Quadrotor read_quadrotor(const Source& source, const tinyxml2::XMLElement& element, const Robot& robot);
DifferentialDrive read_differential(const Source& source, const tinyxml2::XMLElement& element, Robot& robot);
DifferentialDrive read_ackermann(const Source& source, const tinyxml2::XMLElement& element, Robot& robot);
DifferentialDrive read_mecanum(const Source& source, const tinyxml2::XMLElement& element, Robot& robot);
LegDrive read_legs(const Source& source, const tinyxml2::XMLElement& element, const Robot& robot);
void read_laser(const Source& source, const tinyxml2::XMLElement& element, Robot& robot);
void read_ball(const Source& source, const tinyxml2::XMLElement& element, Robot& robot);

// Reads a <sensor> of a robot whose links and joints are complete. Kinds of sensors that muster lacks give a warning.
void read_sensor(const Source& source, const tinyxml2::XMLElement& element, Robot& robot);
// After all is read: warns of lasers whose range no <muster> gives.
void warn_of_blind_lasers(const Source& source, const tinyxml2::XMLElement& root, Robot& robot);

// After all is read: warns of angles that look like degrees, of friction that looks like per cent, and of transmissions
// of joints that are not there.
void warn_of_doubts(const Source& source, const tinyxml2::XMLElement& root, Robot& robot);

// The angles of a joint, or of one between it and the body, that are none in radians, and what they are in degrees:
// fails with them. What else is wrong with the place or the axis of such a joint follows from it.
void refuse_degrees(const Source& source, const tinyxml2::XMLElement& root, const Robot& robot, std::size_t joint);

// Turns joints whose axis is within a degree of an axis of the robot's frame onto it, with a warning.
void snap_axes(const Source& source, const Outline& outline, Robot& robot);

// Reads the sensors and the drive that <gazebo> elements declare, where neither <sensor> nor <muster> do: lasers and
// differential drives. One warning lists what is ignored.
void read_gazebo(const Source& source, const tinyxml2::XMLElement& root, Robot& robot);
// Without any drive declared: takes wheels that turn about the robot's y axis on both of its sides for one, with a
// warning that has it in full.
void derive_drive(const Source& source, const tinyxml2::XMLElement& root, Robot& robot);
// The same, before it: refuses a wheel that carries the robot's body, since <parent> and <child> are exchanged; warns
// of wheels that can be seen and have no shape.
void refuse_exchanged(const Source& source, const tinyxml2::XMLElement& root, Robot& robot);
void warn_of_shapeless_wheels(const Source& source, const tinyxml2::XMLElement& root, Robot& robot);
// True of names such as "wheel_left_joint", and not of casters.
bool is_named_wheel(std::string name);
// The <joint> or <link> of that name in <robot>; null if there is none.
const tinyxml2::XMLElement* find_element(const tinyxml2::XMLElement& root, const char* kind, const std::string& name);
// After the drive is known: warns of joints that a <transmission> or <ros2_control> drives and muster does not.
void warn_of_undriven(const Source& source, const tinyxml2::XMLElement& root, Robot& robot);
// Sets a drive's wheels, those of each side from the first on.
void take_wheels(const std::vector<std::size_t>& left, const std::vector<std::size_t>& right, DifferentialDrive& drive);
// Makes the inertia of a wheel even about its axle where rounded figures leave a few per cent, with a warning.
void balance_wheel(std::size_t joint, Robot& robot);
// A drive whose wheels and sizes are known: checks them against the joints, and completes it.
void complete_drive(const Source& source, const tinyxml2::XMLElement& element, DifferentialDrive& drive, Robot& robot);
// The largest radius of the collision shapes of a joint's child that are round about its axis; 0 if there are none.
double round_about_axle(const Robot& robot, const Joint& joint);

// Torque, speed, acceleration and friction of wheels.
void read_motors(const Source& source, const tinyxml2::XMLElement& element, DifferentialDrive& drive);

// The index of a joint; the position on the body of one that turns without end about the body's +y axis.
std::size_t find_joint(const Source& source, const tinyxml2::XMLElement& element, const char* attribute,
                       const Robot& robot);
// Of a wheel or kingpin that is at y `is` where half of the attribute `width` says `expected`: exchanged sides, or
// another unit; "" where neither explains it.
std::string doubt_of_place(const tinyxml2::XMLElement& element, const char* width, double is, double expected);
Eigen::Vector3d place_of_turning(const Source& source, const tinyxml2::XMLElement& element, const Robot& robot,
                                 std::size_t joint);

// "<wheel> ", as messages begin.
std::string tag(const tinyxml2::XMLElement& element);
// An attribute that must be present and not empty; one that must be a number above 0; those that are allowed, beside
// those of other namespaces.
std::string required(const Source& source, const tinyxml2::XMLElement& element, const char* attribute);
double positive(const Source& source, const tinyxml2::XMLElement& element, const char* attribute);
void only_attributes(const Source& source, const tinyxml2::XMLElement& element, const std::vector<std::string>& known);
// The same for child elements, each present at most once but for `many`.
void only_children(const Source& source, const tinyxml2::XMLElement& element, const std::vector<std::string>& known,
                   const std::vector<std::string>& many = {});

}  // namespace muster::description
