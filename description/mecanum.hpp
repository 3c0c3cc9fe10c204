// Four wheels with rollers at 45 degrees, which hold the ground along the rollers' axles only: the robot goes sideways
// as it goes ahead. Kinematics of Muir and Neuman (1987).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace muster::description {

using MecanumRates = std::array<double, 4>;  // of the wheels: front left, front right, rear left, rear right [rad/s]

// Velocity of the robot's middle in its own frame.
struct PlanarMotion {
  double vx = 0, vy = 0, w = 0;  // [m/s], [rad/s]
};

struct Mecanum {
  double wheelbase = 0;   // between the axles [m]
  double separation = 0;  // between the wheels' middles, left to right [m]
  double radius = 0;      // [m]

  // A turn by w asks as much of each wheel as a speed of arm() w.
  double arm() const { return (wheelbase + separation) / 2; }

  MecanumRates rates(const PlanarMotion& m) const {
    const double turn = arm() * m.w;
    return {(m.vx - m.vy - turn) / radius, (m.vx + m.vy + turn) / radius, (m.vx + m.vy - turn) / radius,
            (m.vx - m.vy + turn) / radius};
  }
  // The motion that four rates make; where no motion has these rates, that of the nearest ones.
  PlanarMotion motion(const MecanumRates& rates) const {
    const auto& [fl, fr, rl, rr] = rates;
    return {radius * (fl + fr + rl + rr) / 4, radius * (fr + rl - fl - rr) / 4,
            radius * (fr + rr - fl - rl) / (4 * arm())};
  }

  // Direction in the body's frame along which a wheel holds the ground: the axle of the roller below.
  static Eigen::Vector3d hold(std::size_t wheel) {
    constexpr double half = 0.70710678118654752;  // sqrt(1/2)
    return {half, wheel == 0 || wheel == 3 ? -half : half, 0};
  }
};

}  // namespace muster::description
