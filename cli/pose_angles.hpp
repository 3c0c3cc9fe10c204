// Angles between poses, for people: heading in the plane, and how far a body leans.
#pragma once

#include <cmath>
#include <muster/tables.hpp>

namespace muster {

// Of the body's x axis, from east to north [rad].
inline double yaw_of(const Pose& p) {
  return std::atan2(2 * (p.qw * p.qz + p.qx * p.qy), 1 - 2 * (p.qy * p.qy + p.qz * p.qz));
}

// How far q's heading is turned from p's [rad], from -pi to pi.
inline double turned(const Pose& p, const Pose& q) {
  constexpr double full_turn = 6.283185307179586;
  return std::remainder(yaw_of(q) - yaw_of(p), full_turn);
}

// The angle between the upward axes of two bodies [rad].
inline double tilted(const Pose& p, const Pose& q) {
  const auto up = [](const Pose& b, double* z) {
    z[0] = 2 * (b.qx * b.qz + b.qw * b.qy);
    z[1] = 2 * (b.qy * b.qz - b.qw * b.qx);
    z[2] = 1 - 2 * (b.qx * b.qx + b.qy * b.qy);
  };
  double a[3], b[3];
  up(p, a), up(q, b);
  const double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
  return std::atan2(std::sqrt(x * x + y * y + z * z), a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}

}  // namespace muster
