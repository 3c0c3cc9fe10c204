// A robot's state as vectors, and bounds of its speed and path.
#pragma once

#include "model.hpp"
#include "state.hpp"

namespace muster::simbody {

inline Eigen::Quaterniond attitude_of(const RobotState& s) { return {s.pose[3], s.pose[4], s.pose[5], s.pose[6]}; }
inline Eigen::Matrix3d matrix_of(const RobotState& s) { return attitude_of(s).toRotationMatrix(); }
inline Eigen::Vector3d velocity_of(const RobotState& s) { return {s.twist[0], s.twist[1], s.twist[2]}; }
inline Eigen::Vector3d rates_of(const RobotState& s) { return {s.twist[3], s.twist[4], s.twist[5]}; }

// The matrix of v x.
inline Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

// Upper bound of the speed of the robot's parts [m/s].
double speed_of(const RobotModel& model, const RobotState& state);

// Distance [m] beyond which nothing is met within h [s].
double way_of(const RobotModel& model, const RobotState& state, double h);

// Throws std::runtime_error naming the robot if a speed is beyond the limit, or not finite.
void check_speed(const std::string& name, double largest);

}  // namespace muster::simbody
