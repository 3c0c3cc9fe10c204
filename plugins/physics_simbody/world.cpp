#include "world.hpp"

#include <cmath>

#include "midpoint_engine.hpp"
#include "simbody_integrators.hpp"

namespace muster::simbody {

std::unique_ptr<Engine> make_engine(const std::vector<NamedRobot>& robots, Integrator integrator, Steps longest,
                                    LegModel legs) {
  if (integrator == Integrator::midpoint) return std::make_unique<MidpointEngine>(robots, longest, legs);
  return std::make_unique<SimbodyIntegrators>(robots, integrator, longest.of_all);
}

void one_by_one(std::size_t count, const std::function<void(std::size_t)>& call) {
  for (std::size_t i = 0; i < count; ++i) call(i);
}

RobotState at_rest(double x, double y, double yaw) {
  RobotState state{};
  state.pose = {x, y, 0, std::cos(yaw / 2), 0, 0, std::sin(yaw / 2)};
  return state;
}

// Along the ground only the friction of wheels or legs acts, and in sum it is at most friction times the weight.
double max_acceleration(const description::Robot& robot) {
  return gravity * (robot.drive ? robot.drive->friction : robot.legs ? robot.legs->friction : 0);
}

}  // namespace muster::simbody
