#include "world.hpp"

#include <cmath>

#include "midpoint.hpp"
#include "stock.hpp"

namespace muster::simbody {

std::unique_ptr<Engine> make_engine(const std::vector<NamedRobot>& robots, Integrator integrator, double step) {
  if (integrator == Integrator::midpoint) return std::make_unique<Midpoint>(robots, step);
  return std::make_unique<Stock>(robots, integrator, step);
}

RobotState at_rest(double x, double y, double yaw) {
  RobotState state{};
  state.pose = {x, y, 0, std::cos(yaw / 2), 0, 0, std::sin(yaw / 2)};
  return state;
}

// Along the ground only the wheels' friction acts, and in sum it is at most friction times the weight.
double max_acceleration(const description::Robot& robot) { return robot.drive ? robot.drive->friction * gravity : 0; }

}  // namespace muster::simbody
