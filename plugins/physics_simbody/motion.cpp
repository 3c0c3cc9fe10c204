#include "motion.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace muster::simbody {

using Eigen::Vector3d;

namespace {

constexpr double fastest = 1e3;   // [m/s], [rad/s]: beyond, the motion has blown up
constexpr double nearby = 0.003;  // [m]

}  // namespace

double speed_of(const RobotModel& model, const RobotState& state) {
  double legs = 0;
  for (const double rate : state.leg_rate) legs = std::max(legs, 2 * model.leg_drive.radius * std::abs(rate));
  double limbs = 0;
  for (std::size_t i = 0; i < model.limbs.size(); ++i) {
    const double reach = model.limbs[i].reach;
    const Limb& limb = state.limbs.limb[i];
    if (reach > 0)
      limbs += std::abs(limb.speed) + reach * (std::abs(limb.rate) + std::hypot(limb.wx, limb.wy, limb.wz));
  }
  const Eigen::Quaterniond q(state.pose[3], state.pose[4], state.pose[5], state.pose[6]);
  const Vector3d rates = q.conjugate() * rates_of(state);
  return velocity_of(state).norm() + rates.cwiseAbs().dot(model.arm) + legs + limbs;
}

// Twice the path, since a contact may accelerate a robot, plus the fall.
double way_of(const RobotModel& model, const RobotState& state, double h) {
  return nearby + 2 * h * speed_of(model, state) + gravity * h * h;
}

void check_speed(const std::string& name, double largest) {
  if (!(largest < fastest)) throw std::runtime_error("robot '" + name + "': its motion blew up");
}

}  // namespace muster::simbody
