#include "description/urdf_guess.hpp"

#include <algorithm>
#include <cmath>

#include "description/file_text.hpp"

namespace muster::description {

using Eigen::Vector3d;
using tinyxml2::XMLElement;

namespace {

// Defaults where a URDF says nothing. Friction is that of rubber on a dry floor, as the Scarab's; the speed and
// acceleration of a wheel's rim are those of small indoor robots; a motor can use all the grip of its side.
constexpr double friction = 0.8;
constexpr double rim_speed = 1, rim_acceleration = 1;  // [m/s], [m/s2]
constexpr double gravity = 9.81;                       // [m/s2]

// [m] Wheels belong to one drive where heights, radii and distances from the middle are that near. Below half of the
// tolerance of complete_drive(), so that what is guessed is never refused.
constexpr double alike = 5e-5;

struct Wheel {
  std::size_t joint;
  double radius;
  Vector3d middle;  // in the robot's frame [m]
};

bool is_about_y(const Vector3d& axis) { return axis.cross(Vector3d::UnitY()).norm() < 1e-6; }

// Joints that look like driven wheels: continuous, about the body's y axis, with a round shape about it.
std::vector<Wheel> wheels_of(const Robot& robot) {
  std::vector<Wheel> result;
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const Joint& joint = robot.joints[i];
    const auto carrier = frame_on_body(robot, joint.parent);
    if (joint.kind != JointKind::continuous || !carrier) continue;
    const Eigen::Isometry3d frame = *carrier * joint.origin;
    const double radius = round_about_axle(robot, joint);
    if (radius > 0 && is_about_y(frame.linear() * joint.axis)) result.push_back({i, radius, frame.translation()});
  }
  return result;
}

// True if the wheels stand on the ground as one robot's do: as many on the left as on the right, at the same places.
bool is_one_drive(const std::vector<Wheel>& left, const std::vector<Wheel>& right) {
  if (left.empty() || left.size() != right.size()) return false;
  const Wheel& first = left[0];
  for (std::size_t i = 0; i < left.size(); ++i) {
    for (const Wheel& wheel : {left[i], right[i]}) {
      if (std::abs(wheel.radius - first.radius) > alike || std::abs(wheel.middle.z() - first.middle.z()) > alike ||
          std::abs(std::abs(wheel.middle.y()) - first.middle.y()) > alike ||
          std::abs(wheel.middle.x() - left[i].middle.x()) > alike)
        return false;
    }
  }
  return true;
}

std::string names_of(const std::vector<std::size_t>& joints, const Robot& robot) {
  std::string result;
  for (const std::size_t joint : joints) result += (result.empty() ? "" : " ") + robot.joints[joint].name;
  return result;
}

std::string written(const DriveGuess& guess, const DifferentialDrive& drive, const Robot& robot) {
  const auto attribute = [](const char* name, const std::string& value) {
    return std::string(" ") + name + "=\"" + value + "\"";
  };
  const auto number = [&](const char* name, double value) { return attribute(name, print_number(value)); };
  std::string text = "<differential" + attribute("left", names_of(guess.left, robot)) +
                     attribute("right", names_of(guess.right, robot)) + number("wheel_radius", drive.wheel_radius) +
                     number("wheel_base", drive.wheel_base);
  if (drive.effective_base != drive.wheel_base) text += number("effective_base", drive.effective_base);
  return text + number("max_torque", drive.max_torque) + number("max_speed", drive.max_speed) +
         number("max_acceleration", drive.max_acceleration) + number("friction", drive.friction) + "/>";
}

}  // namespace

void DriveGuess::take(const Source& source, const XMLElement& element, const std::string& source_of_it, Robot& robot) {
  const Joint& first = robot.joints[left.front()];
  const auto carrier = frame_on_body(robot, first.parent);
  DifferentialDrive drive;
  take_wheels(left, right, drive);
  drive.wheel_radius = wheel_radius > 0 ? wheel_radius : round_about_axle(robot, first);
  if (!(drive.wheel_radius > 0)) {
    source.fail(element.GetLineNum(), tag(element) + "the wheel of joint '" + first.name +
                                          "' has no radius: neither <wheel_diameter> nor a round collision shape");
  }
  drive.wheel_base = carrier ? 2 * std::abs((*carrier * first.origin).translation().y()) : 0;
  constexpr double rounded = 1e-3;  // [m]: a base in millimetres is that of the joints
  if (effective_base > 0 && std::abs(effective_base - drive.wheel_base) > rounded)
    drive.effective_base = effective_base;
  drive.friction = friction;
  drive.max_torque = max_torque > 0 ? max_torque : first.max_effort;
  if (!std::isfinite(drive.max_torque)) {
    const double grip = friction * gravity * whole_mass(robot).mass / 2;
    drive.max_torque = grip * drive.wheel_radius;
  }
  drive.max_speed = std::isfinite(first.max_speed) ? first.max_speed : rim_speed / drive.wheel_radius;
  drive.max_acceleration = rim_acceleration / drive.wheel_radius;
  complete_drive(source, element, drive, robot);
  robot.drive = drive;
  robot.warnings.push_back(source.file + ":" + std::to_string(element.GetLineNum()) + ": its drive " + source_of_it +
                           ", with defaults for what is not there; to set it, write <muster>" +
                           written(*this, drive, robot) + "</muster>");
}

void derive_drive(const Source& source, const XMLElement& root, Robot& robot) {
  if (robot.is_driven()) return;
  refuse_exchanged(source, root, robot);
  if (root.FirstChildElement("muster")) return;  // who writes it without a drive means a robot without one
  warn_of_shapeless_wheels(source, root, robot);
  const std::vector<Wheel> wheels = wheels_of(robot);
  if (wheels.empty()) return;
  std::vector<Wheel> left, right;
  for (const Wheel& wheel : wheels) (wheel.middle.y() > 0 ? left : right).push_back(wheel);
  for (auto* side : {&left, &right})
    std::sort(side->begin(), side->end(), [](const Wheel& a, const Wheel& b) { return a.middle.x() > b.middle.x(); });
  if (!is_one_drive(left, right)) return;
  DriveGuess guess;
  for (const Wheel& wheel : left) guess.left.push_back(wheel.joint);
  for (const Wheel& wheel : right) guess.right.push_back(wheel.joint);
  guess.take(source, root, "is taken from its wheels' joints", robot);
}

}  // namespace muster::description
