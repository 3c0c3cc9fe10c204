// A car: two driven rear wheels, and two front ones on kingpins, whose angle is prescribed.
#include <cmath>

#include "description/file_text.hpp"
#include "description/urdf_check.hpp"

namespace muster::description {

using Eigen::Vector3d;
using tinyxml2::XMLElement;

namespace {

constexpr double quarter_turn = 1.5707963267948966;

// Frame of a joint on the body, while all kingpins are straight.
Eigen::Isometry3d frame_of(const Source& source, const XMLElement& element, const Robot& robot, std::size_t index) {
  const auto carrier = frame_on_body(robot, robot.joints[index].parent);
  if (!carrier) {
    source.fail(element.GetLineNum(), tag(element) + "joint '" + robot.joints[index].name +
                                          "' is not on the robot's body: a joint between them moves");
  }
  return *carrier * robot.joints[index].origin;
}

// The one wheel that a kingpin turns: a continuous joint about the body's y axis.
std::size_t wheel_on(const Source& source, const XMLElement& element, const Robot& robot, std::size_t kingpin) {
  std::vector<bool> carried(robot.links.size(), false);
  carried[robot.joints[kingpin].child] = true;
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {  // parents come first
    const Joint& joint = robot.joints[i];
    if (!carried[joint.parent]) continue;
    if (joint.kind == JointKind::fixed) carried[joint.child] = true;
    if (joint.kind == JointKind::continuous) found.push_back(i);
  }
  if (found.size() == 1) return found.front();
  source.fail(element.GetLineNum(),
              tag(element) + "joint '" + robot.joints[kingpin].name + "' carries " +
                  (found.empty() ? std::string("no wheel") : std::to_string(found.size()) + " wheels") +
                  "; expected one continuous joint on its link");
}

void check_kingpin(const Source& source, const XMLElement& element, const Robot& robot, std::size_t kingpin,
                   const Eigen::Isometry3d& frame, double y) {
  const Joint& joint = robot.joints[kingpin];
  const int line = element.GetLineNum();
  const std::string what = tag(element) + "joint '" + joint.name + "' ";
  if (joint.kind != JointKind::revolute && joint.kind != JointKind::continuous)
    source.fail(line, what + "is " + law_of(joint.kind).name + "; expected revolute or continuous: it steers");
  if (!(frame.linear() * joint.axis).cross(Vector3d::UnitZ()).isZero(axis_tolerance)) {
    refuse_degrees(source, *element.GetDocument()->RootElement(), robot, kingpin);
    source.fail(line, what + "does not turn about the body's z axis: it cannot steer");
  }
  if (std::abs(frame.translation().y() - y) > placement_tolerance) {
    source.fail(line, what + "is not half a kingpin_width from the body's x axis (left: +y, right: -y): it is at y = " +
                          print_number(frame.translation().y()) + " m, expected " + print_number(y) +
                          doubt_of_place(element, "kingpin_width", frame.translation().y(), y));
  }
}

// Requires that the wheels reach the angles of the steering's limit on both sides.
void check_limits(const Source& source, const XMLElement& element, const Robot& robot, const Steering& steering) {
  const double inner = steering.of_wheel(0, steering.limit), outer = -steering.of_wheel(0, -steering.limit);
  constexpr double rounded = 1e-3;  // [rad]
  for (const std::size_t index : steering.kingpins) {
    const Joint& joint = robot.joints[index];
    const double most = std::min(-joint.lower, joint.upper);
    if (joint.kind != JointKind::revolute || most >= inner - rounded) continue;
    source.fail(element.GetLineNum(), tag(element) + "steering_limit=\"" + element.Attribute("steering_limit") +
                                          "\" turns the inner wheel by " + print_number(inner) +
                                          " rad and the outer one by " + print_number(outer) +
                                          ", but the <limit> of joint '" + joint.name + "' is " + print_number(most) +
                                          " rad");
  }
}

Steering read_steering(const Source& source, const XMLElement& element, const DifferentialDrive& drive,
                       const Robot& robot) {
  const int line = element.GetLineNum();
  Steering steering;
  steering.kingpins = {find_joint(source, element, "left_steering", robot),
                       find_joint(source, element, "right_steering", robot)};
  steering.wheelbase = positive(source, element, "wheelbase");
  steering.kingpin_width = positive(source, element, "kingpin_width");
  steering.limit = positive(source, element, "steering_limit");
  if (element.Attribute("max_steering_rate")) steering.max_rate = positive(source, element, "max_steering_rate");
  if (steering.limit >= quarter_turn || steering.wheelbase <= std::tan(steering.limit) * steering.kingpin_width / 2) {
    source.fail(line, tag(element) + "steering_limit=\"" + element.Attribute("steering_limit") +
                          "\" is too much: the inner wheel would turn by a quarter turn or more; expected less than " +
                          print_number(std::atan(2 * steering.wheelbase / steering.kingpin_width)) + " rad");
  }
  const Joint& rear = robot.joints[drive.left];
  steering.rear_axle = (*frame_on_body(robot, rear.parent) * rear.origin).translation().x();
  for (std::size_t side = 0; side < 2; ++side) {
    const std::size_t kingpin = steering.kingpins[side];
    const Eigen::Isometry3d frame = frame_of(source, element, robot, kingpin);
    check_kingpin(source, element, robot, kingpin, frame, (side == 0 ? 0.5 : -0.5) * steering.kingpin_width);
    const std::size_t wheel = wheel_on(source, element, robot, kingpin);
    Robot straight = robot;
    straight.joints[kingpin].kind = JointKind::fixed;
    const Eigen::Isometry3d own = frame_of(source, element, straight, wheel);
    const Vector3d axis = own.linear() * robot.joints[wheel].axis, middle = own.translation();
    if (!axis.cross(Vector3d::UnitY()).isZero(axis_tolerance)) {
      refuse_degrees(source, *element.GetDocument()->RootElement(), robot, wheel);
      source.fail(line,
                  tag(element) + "joint '" + robot.joints[wheel].name + "' does not turn about the body's y axis");
    }
    if (std::abs(middle.x() - steering.rear_axle - steering.wheelbase) > placement_tolerance) {
      source.fail(line, tag(element) + "wheelbase=\"" + element.Attribute("wheelbase") +
                            "\" contradicts the joints: wheel '" + robot.joints[wheel].name + "' is " +
                            print_number(middle.x() - steering.rear_axle) + " m before the rear axle");
    }
    const double round = round_about_axle(robot, robot.joints[wheel]);
    steering.radius = round > 0 ? round : drive.wheel_radius;
    if (std::abs(frame.translation().x() - middle.x()) > placement_tolerance)
      source.fail(line, tag(element) + "wheel '" + robot.joints[wheel].name +
                            "' is not beside its kingpin: the axles would not meet in one point");
    steering.kingpin[side] = {frame.translation().x(), frame.translation().y(), middle.z()};
    steering.hub[side] = middle - steering.kingpin[side];
  }
  check_limits(source, element, robot, steering);
  return steering;
}

}  // namespace

DifferentialDrive read_ackermann(const Source& source, const XMLElement& element, Robot& robot) {
  only_attributes(source, element,
                  {"left", "right", "left_steering", "right_steering", "wheel_radius", "wheelbase", "wheel_separation",
                   "kingpin_width", "steering_limit", "max_steering_rate", "max_torque", "max_speed",
                   "max_acceleration", "friction"});
  DifferentialDrive drive;
  take_wheels({find_joint(source, element, "left", robot)}, {find_joint(source, element, "right", robot)}, drive);
  drive.wheel_radius = positive(source, element, "wheel_radius");
  drive.wheel_base = positive(source, element, "wheel_separation");
  read_motors(source, element, drive);
  complete_drive(source, element, drive, robot);
  drive.steering = read_steering(source, element, drive, robot);
  // The steering's angle is prescribed, and the wheels on it roll freely: to the engines both are parts of the body.
  for (const std::size_t kingpin : drive.steering->kingpins) {
    robot.joints[wheel_on(source, element, robot, kingpin)].kind = JointKind::fixed;
    robot.joints[kingpin].kind = JointKind::fixed;
  }
  return drive;
}

}  // namespace muster::description
