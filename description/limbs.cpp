#include <algorithm>

#include "description/robot.hpp"

namespace muster::description {
namespace {

bool is_driven(const Robot& robot, std::size_t joint) {
  if (robot.drive && robot.drive->side_of(joint) >= 0) return true;
  return robot.legs && std::any_of(robot.legs->legs.begin(), robot.legs->legs.end(),
                                   [&](const LegDrive::Leg& leg) { return leg.joint == joint; });
}

}  // namespace

std::vector<LimbJoint> limbs_of(const Robot& robot) {
  std::vector<LimbJoint> result;
  std::vector<int> carrier = {LimbJoint::body};                            // of each link
  std::vector<Eigen::Isometry3d> frame = {Eigen::Isometry3d::Identity()};  // of each link in its carrier
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {                  // parents come first
    const Joint& joint = robot.joints[i];
    const LimbJoint here{i, carrier[joint.parent], frame[joint.parent] * joint.origin};
    const bool is_fixed = joint.kind == JointKind::fixed;
    frame.push_back(is_fixed ? here.frame : Eigen::Isometry3d::Identity());
    if (is_fixed) {
      carrier.push_back(here.carrier);
    } else if (is_driven(robot, i)) {
      carrier.push_back(LimbJoint::driven);
    } else {
      carrier.push_back(static_cast<int>(result.size()));
      result.push_back(here);
    }
  }
  return result;
}

LimbModel limb_model(const Robot& robot, const LimbJoint& limb) {
  const Joint& joint = robot.joints[limb.joint];
  return {joint.kind,  limb.carrier, limb.frame,    joint.axis,    rigid_mass(robot, joint.child),
          joint.lower, joint.upper,  joint.damping, joint.friction};
}

std::string unmodelled(const Joint& joint) {
  if (joint.kind == JointKind::planar || joint.kind == JointKind::floating) return "is no hinge, slider or ball";
  if (joint.kind == JointKind::ball && joint.friction > 0) return "has a friction; a damping is modelled";
  if (joint.lower > 0 || joint.upper < 0) return "does not have 0 within its limits";
  return "";
}

}  // namespace muster::description
