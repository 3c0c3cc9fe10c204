// Front wheels that steer as Ackermann's linkage has it: the axles of all wheels meet in one point of the rear axle's
// line, so that none slips sideways in a slow turn.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace muster::description {

struct Steering {
  std::array<std::size_t, 2> kingpins{};  // indices of joints, left and right; fixed: the steering is prescribed
  std::array<Eigen::Vector3d, 2>
      kingpin;                         // a point of each one's axis, at the height of the hub, in the body's frame [m]
  std::array<Eigen::Vector3d, 2> hub;  // the wheel's middle from there, while it is straight [m]
  double radius = 0;                   // of the front wheels [m]
  double wheelbase = 0;                // from the rear axle to the front one [m]
  double kingpin_width = 0;            // from kingpin to kingpin [m]
  double rear_axle = 0;                // where it is along the body's x axis [m]
  double limit = 0;                    // of the steering angle, that of a wheel in the middle of the front axle [rad]
  double max_rate = std::numeric_limits<double>::infinity();  // of the steering angle [rad/s]

  // Turn rate at a speed v of the rear axle's middle: a circle of radius wheelbase / tan(angle).
  double turn(double v, double angle) const { return v * std::tan(angle) / wheelbase; }
  // The steering angle of a turn rate w at a speed v, within a quarter turn. v must not be 0.
  double angle(double v, double w) const { return std::atan(w * wheelbase / v); }

  // Angle of the left (0) or right (1) front wheel: that of the inner one is larger.
  double of_wheel(int side, double angle) const {
    const double tangent = std::tan(angle), y = (side == 0 ? 0.5 : -0.5) * kingpin_width;
    return std::atan2(wheelbase * tangent, wheelbase - y * tangent);
  }
  // The wheel's middle, and the direction of its axle, in the body's frame.
  Eigen::Vector3d middle(int side, double angle) const {
    const double own = of_wheel(side, angle), c = std::cos(own), s = std::sin(own);
    const auto i = static_cast<std::size_t>(side);
    return kingpin[i] + Eigen::Vector3d(c * hub[i].x() - s * hub[i].y(), s * hub[i].x() + c * hub[i].y(), hub[i].z());
  }
  Eigen::Vector3d axle(int side, double angle) const {
    const double own = of_wheel(side, angle);
    return {-std::sin(own), std::cos(own), 0};
  }
};

}  // namespace muster::description
