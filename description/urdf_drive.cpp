#include <algorithm>
#include <cmath>

#include "description/file_text.hpp"
#include "description/urdf_check.hpp"

namespace muster::description {

using tinyxml2::XMLElement;

namespace {

constexpr double placement_tolerance = 1e-4;  // [m]: a drive that contradicts the joints by more is a mistake

// Checks that the axle is along the body's y axis, the left wheel on the left, and that positive rates turn forward.
Eigen::Vector3d check_wheel(const Source& source, const XMLElement& element, const Robot& robot, std::size_t index,
                            double y) {
  Eigen::Vector3d middle = place_of_turning(source, element, robot, index);
  if (std::abs(middle.y() - y) > placement_tolerance) {
    source.fail(element.GetLineNum(), tag(element) + "joint '" + robot.joints[index].name +
                                          "' is not half a wheel_base from the body's x axis (left: +y, right: -y)");
  }
  return middle;
}

// The largest radius of a wheel's collision shapes that are round about the axle; 0 if there is none.
double round_about_axle(const Robot& robot, const Joint& joint) {
  double result = 0;
  for (const Shape& shape : rigid_shapes(robot, joint.child)) {
    if (shape.pose.translation().cross(joint.axis).norm() > placement_tolerance) continue;
    if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) result = std::max(result, sphere->radius);
    const auto* cylinder = std::get_if<Cylinder>(&shape.geometry);
    constexpr double rounded = 1e-3;  // [rad]: a right angle in few digits
    if (cylinder && shape.pose.linear().col(2).cross(joint.axis).norm() < rounded)
      result = std::max(result, cylinder->radius);
  }
  return result;
}

void check_radius(const Source& source, const XMLElement& element, const Robot& robot, std::size_t index,
                  double wheel_radius) {
  const Joint& joint = robot.joints[index];
  const double radius = round_about_axle(robot, joint);
  if (radius == 0 || std::abs(radius - wheel_radius) <= placement_tolerance) return;
  source.fail(element.GetLineNum(), tag(element) + "wheel_radius=\"" + element.Attribute("wheel_radius") +
                                        "\" contradicts the wheel of joint '" + joint.name +
                                        "', whose collision shape has a radius of " + print_number(radius));
}

// Not an error: the world file may put the robot's frame above the ground.
void warn_of_height(const Source& source, const XMLElement& element, double height, double wheel_radius, Robot& robot) {
  if (std::abs(height - wheel_radius) <= placement_tolerance) return;
  robot.warnings.push_back(source.file + ":" + std::to_string(element.GetLineNum()) + ": " + tag(element) +
                           "the axle is at z = " + print_number(height) +
                           " of the robot's frame, which is to be on the ground; wheels of radius " +
                           print_number(wheel_radius) + " do not stand there");
}

// 0 where it is absent.
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

DifferentialDrive read_differential(const Source& source, const XMLElement& element, Robot& robot) {
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
  for (const std::size_t wheel : {drive.left, drive.right})
    check_radius(source, element, robot, wheel, drive.wheel_radius);
  warn_of_height(source, element, left.z(), drive.wheel_radius, robot);
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
