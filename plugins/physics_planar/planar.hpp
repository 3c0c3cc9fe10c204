// A robot on wheels as a point with a heading: exact arcs, and a bound on its acceleration.
#pragma once

#include <algorithm>
#include <cmath>
#include <muster/ground_drives.hpp>
#include <muster/tables.hpp>

#include "description/robot.hpp"

namespace muster::planar {

struct Body {
  Pose pose;
  Twist twist;
  Wheels wheels;
  Wheels rear{};  // of a mecanum drive
};

// Commands of a tick: of wheels, of a mecanum drive's rear ones, and of a car's steering.
struct Asked {
  Drive drive;
  Drive rear{0, 0, 0, 0};
  SteeringAngle steering{0, 0};
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

// The motion that wheels make which do not slip, in the body's frame, with the commands half a step ahead.
inline description::PlanarMotion rolled(const Asked& asked, const description::DifferentialDrive& drive, double dt) {
  const auto rate = [&](double start, double slope) { return drive.limited_rate(start + 0.5 * dt * slope); };
  const double left = rate(asked.drive.left, asked.drive.left_rate);
  const double right = rate(asked.drive.right, asked.drive.right_rate);
  if (drive.mecanum) {
    return drive.mecanum->motion(
        {left, right, rate(asked.rear.left, asked.rear.left_rate), rate(asked.rear.right, asked.rear.right_rate)});
  }
  const double v = drive.forward(left, right);
  if (!drive.steering) return {v, 0, drive.turn(left, right)};
  const double w = drive.steering->turn(v, asked.steering.angle + 0.5 * dt * asked.steering.rate);
  return {v, -drive.steering->rear_axle * w, w};  // the rear axle does not go sideways
}

// Turns wheels with the body's motion for dt [s].
inline void turn_wheels(const description::PlanarMotion& motion, const description::DifferentialDrive& drive, double dt,
                        Body& b) {
  const auto turn = [dt](Wheels& wheels, double left, double right) {
    wheels.left_rate = left, wheels.right_rate = right;
    wheels.left += dt * left;
    wheels.right += dt * right;
  };
  if (drive.mecanum) {
    const auto rates = drive.mecanum->rates(motion);
    turn(b.wheels, rates[0], rates[1]);
    turn(b.rear, rates[2], rates[3]);
  } else {
    turn(b.wheels, drive.left_rate(motion.vx, motion.w), drive.right_rate(motion.vx, motion.w));
  }
}

// One step of dt [s] with the commands at its middle. The velocity approaches that of wheels that do not slip, changing
// by at most acceleration [m/s2] times dt. The bound on the turn rate is that of a wheel on its circle about the body's
// middle.
inline Body stepped(Body b, const Asked& asked, const description::DifferentialDrive& drive, double acceleration,
                    double dt) {
  const description::PlanarMotion goal = rolled(asked, drive, dt);
  const double most_turn = acceleration * dt / (drive.wheel_base / 2);
  const double w = b.twist.wz + std::clamp(goal.w - b.twist.wz, -most_turn, most_turn);
  const double middle = heading(b.pose) + 0.5 * dt * w;
  const double ex = std::cos(middle), ey = std::sin(middle);

  double dx = goal.vx * ex - goal.vy * ey - b.twist.vx, dy = goal.vx * ey + goal.vy * ex - b.twist.vy;
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
  turn_wheels({vx * ex + vy * ey, vy * ex - vx * ey, w}, drive, dt, b);  // the wheels roll
  return b;
}

}  // namespace muster::planar
