// Coulomb's friction at one contact with a fixed bound, regularised: a sticking contact has an impulse in proportion to
// its slip.
#pragma once

#include <Eigen/Dense>
#include <array>

namespace muster::simbody {

inline Eigen::Vector2d within(const Eigen::Vector2d& v, double radius) {
  const double size = v.norm();
  return size > radius ? Eigen::Vector2d((radius / size) * v) : v;
}

// softness [m/s per N s], bound [N s]
inline bool sticks(double slip_speed, double bound, double softness) { return slip_speed <= softness * bound; }

inline Eigen::Vector2d grip_of(const Eigen::Vector2d& slip, double bound, double softness) {
  const double size = slip.norm();
  if (bound <= 0) return Eigen::Vector2d::Zero();
  return sticks(size, bound, softness) ? Eigen::Vector2d(-slip / softness) : Eigen::Vector2d(-(bound / size) * slip);
}

// Derivative of friction by slip, [xx, xy, yy].
using GripStiffness = std::array<double, 3>;

inline GripStiffness sticking(double softness) { return {1 / softness, 0, 1 / softness}; }

// For a contact that slides along `way` (unit): free along it, stiff against a turn of it.
inline GripStiffness across(const Eigen::Vector2d& way, double stiffness) {
  return {stiffness * way[1] * way[1], -stiffness * way[0] * way[1], stiffness * way[0] * way[0]};
}

}  // namespace muster::simbody
