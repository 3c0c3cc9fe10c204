// Rotations of rigid bodies over a tick.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <muster/tables.hpp>

namespace muster {

inline Eigen::Quaterniond attitude_of(const Pose& p) { return Eigen::Quaterniond(p.qw, p.qx, p.qy, p.qz).normalized(); }

// The turn from one attitude to another, about an axis of the first one's, at most half a turn [rad].
inline Eigen::Vector3d turn_between(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) {
  Eigen::Quaterniond by = from.conjugate() * to;
  if (by.w() < 0) by.coeffs() = -by.coeffs();
  const double sine = by.vec().norm();
  if (sine == 0) return Eigen::Vector3d::Zero();
  return 2 * std::atan2(sine, by.w()) / sine * by.vec();
}

// What a second difference of places would be without the `turn` of each of its two steps: an acceleration that turns
// with the body leaves, across the axis of the turn, the share (sin(a/2) / (a/2))^2 of itself.
inline Eigen::Vector3d unrolled(const Eigen::Vector3d& difference, const Eigen::Vector3d& turn) {
  const double half = turn.norm() / 2;
  if (half == 0) return difference;
  const Eigen::Vector3d axis = turn.normalized(), along = difference.dot(axis) * axis;
  const double left = std::sin(half) / half;
  return along + (difference - along) / (left * left);
}

}  // namespace muster
