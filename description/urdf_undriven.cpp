// Joints that ROS drives and muster does not: those of an arm, a gripper, a camera's tilt; and wheels that cannot turn.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <string>

#include "description/file_text.hpp"
#include "description/urdf_check.hpp"

namespace muster::description {

using tinyxml2::XMLElement;

namespace {

// Joints of <transmission>, and those of <ros2_control> that take commands.
void warn_of_joints_in(const Source& source, const XMLElement& group, bool only_commanded, Robot& robot) {
  const std::vector<LimbJoint> limbs = limbs_of(robot);
  for (const auto* named = group.FirstChildElement("joint"); named; named = named->NextSiblingElement("joint")) {
    const char* name = named->Attribute("name");
    if (!name || (only_commanded && !named->FirstChildElement("command_interface"))) continue;
    const bool hangs = std::any_of(limbs.begin(), limbs.end(),
                                   [&](const LimbJoint& limb) { return robot.joints[limb.joint].name == name; });
    if (!hangs) continue;
    robot.warnings.push_back(source.file + ":" + std::to_string(named->GetLineNum()) + ": joint '" + name + "': <" +
                             group.Name() +
                             "> drives it in ROS, and nothing drives it here: it moves freely; expected it among the "
                             "joints of <differential> or <legs>, or type=\"fixed\" where it is to hold");
  }
}

// The joint, or the first above it, whose angles look like degrees; null where there is none.
const Joint* joint_in_degrees(const Robot& robot, const Joint& joint) {
  for (const Joint* one = &joint;; one = &robot.joints[one->parent - 1]) {
    if (one->is_in_degrees) return one;
    if (one->parent == 0) return nullptr;
  }
}

// What a wheel turns about instead of the robot's y axis.
std::string axis_in_words(const Eigen::Vector3d& axis) {
  constexpr double degree = 0.017453292519943295, skew = 0.1;
  int nearest = 0;
  axis.cwiseAbs().maxCoeff(&nearest);
  if (axis.cross(Eigen::Vector3d::Unit(nearest)).norm() < skew)
    return std::string("the robot's ") + "xyz"[nearest] + " axis";
  const double off = std::atan2(axis.cross(Eigen::Vector3d::UnitY()).norm(), std::abs(axis.y()));
  return "an axis " + print_number(off / degree) + " degrees off the robot's y axis";
}

}  // namespace

bool is_named_wheel(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return c < 128 ? std::tolower(c) : c; });
  return name.find("wheel") != std::string::npos && name.find("caster") == std::string::npos;
}

std::string wheels_that_stand(const Robot& robot) {
  std::string result;
  if (std::filesystem::path(robot.file).extension() == ".xml") return result;  // MJCF has other words for joints
  for (const Joint& joint : robot.joints) {
    const Link& wheel = robot.links[joint.child];
    if (joint.kind == JointKind::continuous || (!is_named_wheel(joint.name) && !is_named_wheel(wheel.name))) continue;
    result += (result.empty() ? "joint '" : ", joint '") + joint.name + "' of link '" + wheel.name + "' (" +
              robot.file + ":" + std::to_string(wheel.line) + ") is " + law_of(joint.kind).name;
  }
  return result;
}

std::string wheels_about_others(const Robot& robot) {
  constexpr double skew = 0.1;  // of the sine of an angle
  std::string result;
  if (std::filesystem::path(robot.file).extension() == ".xml") return result;
  for (const Joint& joint : robot.joints) {
    const Link& wheel = robot.links[joint.child];
    const auto carrier = frame_on_body(robot, joint.parent);
    const bool is_wheel = is_named_wheel(joint.name) || is_named_wheel(wheel.name);
    if (joint.kind != JointKind::continuous || !carrier || !is_wheel) continue;
    const Eigen::Matrix3d turned = (*carrier * joint.origin).linear();
    const Eigen::Vector3d axis = turned * joint.axis;
    if (axis.cross(Eigen::Vector3d::UnitY()).norm() < skew) continue;
    result += (result.empty() ? "joint '" : ", joint '") + joint.name + "' of link '" + wheel.name + "' (" +
              robot.file + ":" + std::to_string(wheel.line) + ") turns about " + axis_in_words(axis);
    if (const Joint* doubtful = joint_in_degrees(robot, joint)) {
      result += ", by the angles in the <origin> of joint '" + doubtful->name +
                "', which look like degrees: expected them in radians";
      continue;  // an axis that follows from them is none to write
    }
    const Eigen::Vector3d own = turned.transpose() * Eigen::Vector3d::UnitY();
    const auto number = [](double value) { return print_number(std::abs(value) < 1e-6 ? 0 : value); };
    result += ", and a wheel about y: expected <axis xyz=\"" + number(own.x()) + ' ' + number(own.y()) + ' ' +
              number(own.z()) + "\"/>";
  }
  return result;
}

void warn_of_undriven(const Source& source, const XMLElement& root, Robot& robot) {
  for (const auto* each = root.FirstChildElement(); each; each = each->NextSiblingElement()) {
    const std::string name = each->Name();
    if (name == "transmission") warn_of_joints_in(source, *each, false, robot);
    if (name == "ros2_control") warn_of_joints_in(source, *each, true, robot);
  }
}

}  // namespace muster::description
