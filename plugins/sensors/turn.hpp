// Rotations of rigid bodies over a tick.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <muster/tables.hpp>

namespace muster {

inline Eigen::Quaterniond attitude_of(const Pose& p) { return Eigen::Quaterniond(p.qw, p.qx, p.qy, p.qz).normalized(); }

inline Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d result;
  result << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return result;
}

// The turn from one attitude to another, about an axis of the first one's, at most half a turn [rad].
inline Eigen::Vector3d turn_between(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) {
  Eigen::Quaterniond by = from.conjugate() * to;
  if (by.w() < 0) by.coeffs() = -by.coeffs();
  const double sine = by.vec().norm();
  if (sine == 0) return Eigen::Vector3d::Zero();
  return 2 * std::atan2(sine, by.w()) / sine * by.vec();
}

// Mean of the rotations from 0 to `turn`: what a vector that turns with a body adds up to, in the body's first axes.
inline Eigen::Matrix3d mean_rotation(const Eigen::Vector3d& turn) {
  const double a2 = turn.squaredNorm(), a = std::sqrt(a2);
  const double b = a < 1e-4 ? 0.5 - a2 / 24 : (1 - std::cos(a)) / a2;
  const double c = a < 1e-2 ? 1.0 / 6 - a2 / 120 + a2 * a2 / 5040 : (a - std::sin(a)) / (a2 * a);
  const Eigen::Matrix3d by = cross_matrix(turn);
  return Eigen::Matrix3d::Identity() + b * by + c * by * by;
}

}  // namespace muster
