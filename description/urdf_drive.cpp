#include <algorithm>
#include <cmath>

#include "description/file_text.hpp"
#include "description/urdf_check.hpp"

namespace muster::description {

using tinyxml2::XMLElement;

namespace {

constexpr double placement_tolerance = 1e-4;  // [m]: a drive that contradicts the joints by more is a mistake

std::string tag(const XMLElement& element) { return std::string("<") + element.Name() + "> "; }

// The axle lies along the body's y axis, left wheel on the left, and turns forward for positive rates.
Eigen::Vector3d check_wheel(const Source& source, const XMLElement& element, const Robot& robot, std::size_t index,
                            double y) {
  const Eigen::Vector3d middle = place_of_turning(source, element, robot, index);
  if (std::abs(middle.y() - y) > placement_tolerance) {
    source.fail(element.GetLineNum(), tag(element) + "joint '" + robot.joints[index].name +
                                          "' is not half a wheel_base from the body's x axis (left: +y, right: -y)");
  }
  return middle;
}

// 0 where it is not said.
double share(const Source& source, const XMLElement& element, const char* attribute) {
  const char* text = element.Attribute(attribute);
  if (!text) return 0;
  const auto value = parse_number(text);
  if (!value || *value < 0 || *value > 1) {
    source.fail(element.GetLineNum(),
                tag(element) + attribute + "=\"" + text + "\" is wrong; expected a number from 0 to 1");
  }
  return *value;
}

DifferentialDrive read_differential(const Source& source, const XMLElement& element, const Robot& robot) {
  only_attributes(
      source, element,
      {"left", "right", "wheel_radius", "wheel_base", "max_torque", "max_speed", "max_acceleration", "friction"});
  DifferentialDrive drive;
  drive.left = find_joint(source, element, "left", robot);
  drive.right = find_joint(source, element, "right", robot);
  drive.wheel_radius = positive(source, element, "wheel_radius");
  drive.wheel_base = positive(source, element, "wheel_base");
  drive.max_torque = positive(source, element, "max_torque");
  drive.max_speed = positive(source, element, "max_speed");
  if (element.Attribute("max_acceleration")) drive.max_acceleration = positive(source, element, "max_acceleration");
  drive.friction = positive(source, element, "friction");
  const Eigen::Vector3d left = check_wheel(source, element, robot, drive.left, drive.wheel_base / 2);
  const Eigen::Vector3d right = check_wheel(source, element, robot, drive.right, -drive.wheel_base / 2);
  if (std::hypot(left.x() - right.x(), left.z() - right.z()) > placement_tolerance) {
    source.fail(element.GetLineNum(), tag(element) + "the wheels are not on one axle");
  }
  return drive;
}

}  // namespace

std::size_t find_joint(const Source& source, const XMLElement& element, const char* attribute, const Robot& robot) {
  const std::string name = required(source, element, attribute);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    if (robot.joints[i].name == name) return i;
    names.push_back(robot.joints[i].name);
  }
  source.fail(element.GetLineNum(),
              tag(element) + attribute + ": joint '" + name + "' is not known" + nearest(name, names));
}

Eigen::Vector3d place_of_turning(const Source& source, const XMLElement& element, const Robot& robot,
                                 std::size_t index) {
  const Joint& joint = robot.joints[index];
  const int line = element.GetLineNum();
  const std::string what = tag(element) + "joint '" + joint.name + "' ";
  if (joint.kind != JointKind::continuous) source.fail(line, what + "is not continuous");
  const auto carrier = frame_on_body(robot, joint.parent);
  if (!carrier) source.fail(line, what + "is not on the robot's body: a joint between them moves");
  const Eigen::Isometry3d frame = *carrier * joint.origin;
  if (!(frame.linear() * joint.axis - Eigen::Vector3d::UnitY()).isZero(1e-6)) {
    source.fail(line, what + "does not turn about the body's +y axis");
  }
  return frame.translation();
}

void read_muster(const Source& source, const XMLElement& muster, Robot& robot) {
  only_attributes(source, muster, {"restitution"});
  if (muster.Attribute("restitution")) robot.restitution = share(source, muster, "restitution");
  const std::vector<std::string> known = {"differential", "quadrotor", "legs", "ball", "laser"};
  for (const auto* child = muster.FirstChildElement(); child; child = child->NextSiblingElement()) {
    const std::string name = child->Name();
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      source.fail(child->GetLineNum(), "<" + name +
                                           "> is not known in <muster>; expected <differential>, <quadrotor>, <legs>, "
                                           "<ball> or <laser>" +
                                           nearest(name, known));
    }
    if (name == "ball") {
      read_ball(source, *child, robot);
      continue;
    }
    if (name == "laser") {
      read_laser(source, *child, robot);
      continue;
    }
    if (robot.drive || robot.quadrotor || robot.legs) source.fail(child->GetLineNum(), "has a second drive");
    if (name == "differential") robot.drive = read_differential(source, *child, robot);
    if (name == "quadrotor") robot.quadrotor = read_quadrotor(source, *child, robot);
    if (name == "legs") robot.legs = read_legs(source, *child, robot);
  }
}

}  // namespace muster::description
