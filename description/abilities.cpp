#include "description/abilities.hpp"

namespace muster::description {
namespace {

Ability ability_of(JointKind kind) {
  switch (kind) {
    case JointKind::revolute:
    case JointKind::continuous:
      return Ability::hinges;
    case JointKind::prismatic:
      return Ability::sliders;
    case JointKind::ball:
      return Ability::balls;
    default:
      return Ability::loose;
  }
}

}  // namespace

std::string lacking(const Robot& robot, Ability have) {
  std::string list;
  const auto need = [&](bool needed, Ability ability, const std::string& words) {
    if (!needed || (static_cast<unsigned>(have) & static_cast<unsigned>(ability))) return;
    list += (list.empty() ? "" : ", ") + words;
  };
  const bool steers = robot.drive && robot.drive->steering, rolls_sideways = robot.drive && robot.drive->mecanum;
  need(robot.drive && !steers && !rolls_sideways, Ability::wheels, "wheels (<differential>)");
  need(steers, Ability::steering, "wheels that steer (<ackermann>)");
  need(rolls_sideways, Ability::mecanum, "wheels with rollers (<mecanum>)");
  need(robot.quadrotor.has_value(), Ability::rotors, "rotors (<quadrotor>)");
  need(robot.legs.has_value(), Ability::legs, "legs (<legs>)");
  const bool leaves_the_plane = robot.quadrotor || robot.legs;
  need(leaves_the_plane, Ability::height, "changes of height");
  need(leaves_the_plane, Ability::tilting, "roll and pitch");
  need(robot.restitution > 0, Ability::bouncing, "bouncing (<muster restitution=...>)");
  for (const LimbJoint& limb : limbs_of(robot)) {
    const Joint& joint = robot.joints[limb.joint];
    need(true, ability_of(joint.kind), "joint '" + joint.name + "' (" + law_of(joint.kind).name + ") without a motor");
  }
  need(!robot.is_driven(), Ability::pushed,
       "motion without a drive (its model has no <muster><differential .../></muster>, <quadrotor .../> or <legs>)");
  return list;
}

}  // namespace muster::description
