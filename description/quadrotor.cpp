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
  const auto& [front, left, back, right] = rates;
  const double f2 = front * front, l2 = left * left, b2 = back * back, r2 = right * right;
  // Sums over rotors of their rates, and of these times their places.
  const double sum = front + left + back + right, along = arm * (front - back), across = arm * (left - right);
  const double vx = v.x() + height * w.y(), vy = v.y() - height * w.x();  // of the middle of the rotors
  const double drag_x = -drag_factor * (sum * vx - across * w.z());
  const double drag_y = -drag_factor * (sum * vy + along * w.z());
  const double drag_z = -drag_factor * (along * vy - across * vx + arm * arm * sum * w.z());
  return {{drag_x, drag_y, thrust_factor * (f2 + l2 + b2 + r2)},
          {thrust_factor * arm * (l2 - r2) - height * drag_y, thrust_factor * arm * (b2 - f2) + height * drag_x,
           torque_factor * (f2 + b2 - l2 - r2) + drag_z}};
}

RotorRates Quadrotor::rates_for(double thrust, const Vector3d& torque) const {
  if (!(thrust > 0)) return {};
  const double most = thrust_factor * max_speed * max_speed;  // of one rotor
  const double roll = std::clamp(torque.x() / (2 * arm), -most / 2, most / 2);
  const double pitch = std::clamp(torque.y() / (2 * arm), -most / 2, most / 2);
  const double larger = std::max(std::abs(roll), std::abs(pitch));
  const double yaw = std::clamp(torque.z() * thrust_factor / (4 * torque_factor), larger - most / 2, most / 2 - larger);
  const double above = std::max(std::abs(pitch) - yaw, std::abs(roll) + yaw);  // so that no rotor would turn backwards
  const double below = most - std::max(std::abs(pitch) + yaw, std::abs(roll) - yaw);
  const double mean = std::clamp(thrust / 4, above, std::max(above, below));
  const double thrusts[] = {mean - pitch + yaw, mean + roll - yaw, mean + pitch + yaw, mean - roll - yaw};
  RotorRates rates;
  for (std::size_t i = 0; i < 4; ++i) rates[i] = std::sqrt(std::max(0.0, thrusts[i]) / thrust_factor);
  return rates;
}

double Quadrotor::hover_drag(double thrust) const { return 2 * drag_factor * std::sqrt(thrust / thrust_factor); }

}  // namespace muster::description
