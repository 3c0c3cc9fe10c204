#include "model.hpp"

namespace muster::ode {

RobotModel model_of(const description::Robot& robot) {
  using description::JointKind;
  constexpr double half_turn = 3.14159265358979323846;
  std::vector<std::string> reasons = rigid::lacks(robot, [](const description::Joint& joint) {
    const bool is_wide = joint.kind == JointKind::revolute && (joint.lower <= -half_turn || joint.upper >= half_turn);
    return std::string(is_wide ? "has limits beyond half a turn, which ODE does not see" : "");
  });
  if (robot.restitution > 0 && robot.drive) reasons.push_back("it bounces on wheels, where ODE's impacts gain energy");
  rigid::refuse(robot, "physics.ode", reasons);
  return RobotModel(robot);
}

}  // namespace muster::ode
