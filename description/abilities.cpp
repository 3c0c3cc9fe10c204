#include "description/abilities.hpp"

namespace muster::description {

std::string lacking(const Robot& robot, Ability have) {
  std::string list;
  const auto need = [&](bool needed, Ability ability, const std::string& words) {
    if (!needed || (static_cast<unsigned>(have) & static_cast<unsigned>(ability))) return;
    list += (list.empty() ? "" : ", ") + words;
  };
  need(robot.drive.has_value(), Ability::wheels, "wheels (<differential>)");
  need(robot.quadrotor.has_value(), Ability::rotors, "rotors (<quadrotor>)");
  need(robot.quadrotor.has_value(), Ability::height, "changes of height");
  need(robot.quadrotor.has_value(), Ability::tilting, "roll and pitch");
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const bool is_wheel = robot.drive && (i == robot.drive->left || i == robot.drive->right);
    need(!is_wheel && robot.joints[i].kind != JointKind::fixed, Ability::joints,
         "joint '" + robot.joints[i].name + "' that moves");
  }
  if (!robot.drive && !robot.quadrotor) {
    list += std::string(list.empty() ? "" : ", ") +
            "motion without a drive (its model has no <muster><differential .../></muster> and no <quadrotor .../>)";
  }
  return list;
}

}  // namespace muster::description
