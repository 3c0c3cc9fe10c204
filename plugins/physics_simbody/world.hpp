// Robots that move, as a function of inputs: pose, twist, wheels, memory and commands. An instance keeps only data
// derived from the robots' descriptions, so a remade one does the same arithmetic, bit for bit.
#pragma once

#include "engine.hpp"

namespace muster::simbody {

// Throws std::runtime_error for a robot that it cannot model.
std::unique_ptr<Engine> make_engine(const std::vector<NamedRobot>& robots, Integrator integrator, Steps longest,
                                    LegModel legs = LegModel::as_described);

// A robot at rest on the ground, its frame at x, y [m] and turned by yaw [rad].
RobotState at_rest(double x, double y, double yaw);

// Bound on the acceleration of the centre of mass along the ground while wheels or legs carry the robot [m/s2].
double max_acceleration(const description::Robot& robot);

}  // namespace muster::simbody
