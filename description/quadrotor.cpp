#include "description/quadrotor.hpp"

#include <algorithm>
#include <cmath>

namespace muster::description {

using Eigen::Vector3d;

RotorDecay Quadrotor::decay(double time) const { return {std::exp(-time / lag_up), std::exp(-time / lag_down)}; }

RotorRates Quadrotor::later(const RotorRates& now, const RotorRates& asked, const RotorDecay& decay) const {
  RotorRates result;
  for (std::size_t i = 0; i < 4; ++i) {
    const double goal = std::clamp(asked[i], 0.0, max_speed);
    result[i] = goal + (now[i] - goal) * (goal > now[i] ? decay.up : decay.down);
  }
  return result;
}

Wrench Quadrotor::wrench(const RotorRates& rates, const Vector3d& v, const Vector3d& w) const {
  RotorRates squares;
  for (std::size_t i = 0; i < 4; ++i) squares[i] = rates[i] * rates[i];
  return wrench(rates, squares, v, w);
}

RotorRates Quadrotor::rates_for(double thrust, const Vector3d& of_body) const {
  if (!(thrust > 0)) return {};
  const Vector3d torque = rotor_angle == 0 ? of_body : along_arms(of_body);
  const double most = thrust_factor * max_speed * max_speed;  // of one rotor
  const double roll = std::clamp(torque.x() / (2 * arm), -most / 2, most / 2);
  const double pitch = std::clamp(torque.y() / (2 * arm), -most / 2, most / 2);
  const double larger = std::max(std::abs(roll), std::abs(pitch));
  const double yaw = std::clamp(torque.z() * thrust_factor / (4 * torque_factor), larger - most / 2, most / 2 - larger);
  const double above = std::max(std::abs(pitch) - yaw, std::abs(roll) + yaw);  // so that no rotor would need to turn
                                                                               // backwards
  const double below = most - std::max(std::abs(pitch) + yaw, std::abs(roll) - yaw);
  const double mean = std::clamp(thrust / 4, above, std::max(above, below));
  const double thrusts[] = {mean - pitch + yaw, mean + roll - yaw, mean + pitch + yaw, mean - roll - yaw};
  RotorRates rates;
  for (std::size_t i = 0; i < 4; ++i) rates[i] = std::sqrt(std::max(0.0, thrusts[i]) / thrust_factor);
  return rates;
}

double Quadrotor::hover_drag(double thrust) const { return 2 * drag_factor * std::sqrt(thrust / thrust_factor); }

}  // namespace muster::description
