// Robots as ODE simulates them.
#pragma once

#include "plugins/rigid_parts.hpp"

namespace muster::ode {

using rigid::Ball;
using rigid::Block;
using rigid::RobotModel;
using rigid::Wheel;

// Throws std::runtime_error with everything that this backend lacks for the robot.
RobotModel model_of(const description::Robot& robot);

}  // namespace muster::ode
