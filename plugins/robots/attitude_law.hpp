// Attitude controller on board a quadrotor: rotors' rates from the body's attitude and turn rate.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <muster/tables.hpp>

#include "description/robot.hpp"

namespace muster {

// Body to world. Turned about z, then the new y, then the new x (REP-103).
inline Eigen::Quaterniond turned(double roll, double pitch, double yaw) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  return AngleAxisd(yaw, Vector3d::UnitZ()) * AngleAxisd(pitch, Vector3d::UnitY()) *
         AngleAxisd(roll, Vector3d::UnitX());
}

struct Angles {
  double roll, pitch, yaw;  // [rad], pitch within a quarter turn
};

inline Angles angles_of(const Eigen::Quaterniond& q) {
  const double sine = std::clamp(2 * (q.w() * q.y() - q.z() * q.x()), -1.0, 1.0);
  return {std::atan2(2 * (q.w() * q.x() + q.y() * q.z()), 1 - 2 * (q.x() * q.x() + q.y() * q.y())), std::asin(sine),
          std::atan2(2 * (q.w() * q.z() + q.x() * q.y()), 1 - 2 * (q.y() * q.y() + q.z() * q.z()))};
}

// The shortest turn from q to goal as a vector in q's frame [rad].
inline Eigen::Vector3d turn_between(const Eigen::Quaterniond& q, const Eigen::Quaterniond& goal) {
  Eigen::Quaterniond error = q.conjugate() * goal;
  if (error.w() < 0) error.coeffs() *= -1;
  const double sine = error.vec().norm();
  return (sine > 1e-9 ? 2 * std::atan2(sine, error.w()) / sine : 2) * error.vec();
}

// A PID on roll and pitch, a PI on the turn rate, as angular acceleration; torque by the body's inertia.
struct AttitudeLaw {
  const description::Quadrotor& drive;
  const Eigen::Matrix3d& inertia;  // about the centre of mass, in the body's frame [kg m2]

  // Limit of each integral: its effect is at most that of an error of this size [rad], [rad/s].
  static constexpr double wound_up = 0.2;

  // `w` in the body's frame [rad/s]; `integral` of the errors of roll, pitch [rad s] and turn rate [rad], advanced by
  // `dt` [s].
  description::RotorRates step(const AttitudeThrust& asked, const Eigen::Quaterniond& q, const Eigen::Vector3d& w,
                               Eigen::Vector3d& integral, double dt) const {
    if (!(asked.thrust > 0)) {
      integral.setZero();
      return {};
    }
    const Eigen::Vector3d error = turn_between(q, turned(asked.roll, asked.pitch, angles_of(q).yaw));
    const double turn_error = asked.yaw_rate - w.z();
    // Rates of a body that turns about the vertical at constant roll and pitch: these are not to be damped.
    const Eigen::Vector3d up = q.conjugate() * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d even = up.z() > 0.1 ? Eigen::Vector3d(w.z() / up.z() * up) : Eigen::Vector3d::Zero();
    const Eigen::Vector3d acceleration(
        drive.attitude_p * error.x() + drive.attitude_i * integral.x() - drive.attitude_d * (w.x() - even.x()),
        drive.attitude_p * error.y() + drive.attitude_i * integral.y() - drive.attitude_d * (w.y() - even.y()),
        drive.yaw_p * turn_error + drive.yaw_i * integral.z());
    const auto moved = [&](double sum, double by, double p, double i) {
      return i > 0 ? std::clamp(sum + by * dt, -wound_up * p / i, wound_up * p / i) : 0;
    };
    integral = {moved(integral.x(), error.x(), drive.attitude_p, drive.attitude_i),
                moved(integral.y(), error.y(), drive.attitude_p, drive.attitude_i),
                moved(integral.z(), turn_error, drive.yaw_p, drive.yaw_i)};
    return drive.rates_for(asked.thrust, inertia * acceleration + w.cross(inertia * w));
  }
};

}  // namespace muster
