// Dead reckoning on two wheels that roll without slip.
#pragma once

#include <cmath>
#include <muster/tables.hpp>

namespace muster {

// Along the circular arc of `forward` [m] that turns by `turned` [rad]: exact for wheels whose rates keep their ratio.
inline void roll(Odometry& at, double forward, double turned) {
  const double half = turned / 2;
  const double chord = std::abs(half) < 1e-4 ? forward * (1 - half * half / 6) : forward * std::sin(half) / half;
  at.x += chord * std::cos(at.yaw + half);
  at.y += chord * std::sin(at.yaw + half);
  at.yaw += turned;
}

// The same where the robot also goes to its left by `sideways` [m].
inline void roll(Odometry& at, double forward, double sideways, double turned) {
  Odometry across = at;
  across.yaw += 1.5707963267948966;
  roll(across, sideways, turned);
  const double dx = across.x - at.x, dy = across.y - at.y;
  roll(at, forward, turned);
  at.x += dx;
  at.y += dy;
}

inline double yaw_of(const Pose& p) {
  return std::atan2(2 * (p.qw * p.qz + p.qx * p.qy), 1 - 2 * (p.qy * p.qy + p.qz * p.qz));
}

}  // namespace muster
