// A robot on two wheels as a point with a heading: exact arcs, and a bound on its acceleration.
#pragma once

#include <algorithm>
#include <cmath>
#include <muster/tables.hpp>

#include "description/robot.hpp"

namespace muster::planar {

struct Body {
  Pose pose;
  Twist twist;
  Wheels wheels;
};

// Heading of the body's x axis, from east to north [rad].
inline double heading(const Pose& p) {
  return std::atan2(2 * (p.qw * p.qz + p.qx * p.qy), 1 - 2 * (p.qy * p.qy + p.qz * p.qz));
}

// Turns the pose about the world's vertical; its tilt stays.
inline void turn(Pose& p, double angle) {
  const double c = std::cos(angle / 2), s = std::sin(angle / 2);
  const double q[] = {c * p.qw - s * p.qz, c * p.qx - s * p.qy, c * p.qy + s * p.qx, c * p.qz + s * p.qw};
  const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  p.qw = q[0] / size, p.qx = q[1] / size, p.qy = q[2] / size, p.qz = q[3] / size;
}

// One step of dt [s] with the commanded wheel rates at its middle. The velocity approaches theirs, changing by at most
// acceleration [m/s2] times dt. The bound on the turn rate is that of a wheel on its circle about the body's middle.
inline Body stepped(Body b, const Drive& asked, const description::DifferentialDrive& drive, double acceleration,
                    double dt) {
  const double left = drive.limited_rate(asked.left + 0.5 * dt * asked.left_rate);
  const double right = drive.limited_rate(asked.right + 0.5 * dt * asked.right_rate);

  const double most_turn = acceleration * dt / (drive.wheel_base / 2);
  const double w = b.twist.wz + std::clamp(drive.turn(left, right) - b.twist.wz, -most_turn, most_turn);
  const double middle = heading(b.pose) + 0.5 * dt * w;
  const double ex = std::cos(middle), ey = std::sin(middle);

  double dx = drive.forward(left, right) * ex - b.twist.vx, dy = drive.forward(left, right) * ey - b.twist.vy;
  const double change = std::hypot(dx, dy);
  const double share = change > acceleration * dt ? acceleration * dt / change : 1;
  const double vx = b.twist.vx + share * dx, vy = b.twist.vy + share * dy;

  // The chord of an arc is shorter than the arc.
  const double half = 0.5 * dt * w;
  const double chord = half == 0 ? 1 : std::sin(half) / half;
  b.pose.x += dt * chord * vx;
  b.pose.y += dt * chord * vy;
  turn(b.pose, dt * w);
  b.twist = {vx, vy, 0, 0, 0, w};

  const double v = vx * ex + vy * ey;  // the wheels roll: speed of the body along its heading
  b.wheels.left_rate = drive.left_rate(v, w);
  b.wheels.right_rate = drive.right_rate(v, w);
  b.wheels.left += dt * b.wheels.left_rate;
  b.wheels.right += dt * b.wheels.right_rate;
  return b;
}

}  // namespace muster::planar
