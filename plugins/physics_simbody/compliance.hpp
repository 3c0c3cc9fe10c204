// Compliance of contacts: of bodies, and of legs on springs.
#pragma once

#include <algorithm>

#include "description/robot.hpp"

namespace muster::simbody {

// Stiffness and damping of a normal contact, by the robot's weight: a Scarab of 8 kg sinks by 0.03 mm in all.
constexpr double stiffness_per_mass = 125000;  // [1/s2]
constexpr double damping_per_mass = 2500;      // [1/s]
constexpr double push_out = 0.2;               // highest speed out of penetrations [m/s]

struct Compliance {
  Compliance(double mass, double h) {
    const double stiffness = stiffness_per_mass * mass, damping = damping_per_mass * mass;
    share = h * stiffness / (h * stiffness + damping);
    softness = 1 / (h * (h * stiffness + damping));
  }
  // Normal speed below which a contact pushes, with the gap at the step's start: separate surfaces may close the gap
  // only.
  double target(double gap, double h) const { return gap > 0 ? -gap / h : std::min(-share * gap / h, push_out); }

  double share;  // of a penetration corrected in one step
  double softness;
};

// A leg as a spring and a damper. Its force is that at the step's start, between the velocities half a step before and
// after it: second order, and stable for any step.
struct Spring {
  Spring(const description::LegDrive& drive, double h)
      : stiffness(drive.stiffness),
        ahead(0.25 * h * drive.stiffness + 0.5 * drive.damping),
        behind(0.25 * h * drive.stiffness - 0.5 * drive.damping),
        softness(1 / (h * ahead)) {}
  // `previous`: the normal speed half a step before.
  double target(double gap, double previous) const { return (behind * previous - stiffness * gap) / ahead; }

  double stiffness, ahead, behind, softness;
};

}  // namespace muster::simbody
