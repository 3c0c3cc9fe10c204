// Joints that ROS drives and muster does not: those of an arm, a gripper, a camera's tilt.
#include <algorithm>
#include <string>

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

}  // namespace

void warn_of_undriven(const Source& source, const XMLElement& root, Robot& robot) {
  for (const auto* each = root.FirstChildElement(); each; each = each->NextSiblingElement()) {
    const std::string name = each->Name();
    if (name == "transmission") warn_of_joints_in(source, *each, false, robot);
    if (name == "ros2_control") warn_of_joints_in(source, *each, true, robot);
  }
}

}  // namespace muster::description
