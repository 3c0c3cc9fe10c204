// One robot's step on the velocities: stiff normal contacts, Coulomb's isotropic cone, motors with a torque limit.
// With friction's bound held fixed the step minimises a convex energy; the bound is refreshed a few times until it
// agrees with the normal impulse. Found and measured in the project's trials; the ideas: Castro, Permenter, Han 2022
// (primal regularised Newton), Castro, Han, Masterjohn 2023 (lagged bound), Chan, Golub, Mulet 1999 (primal-dual sums
// of norms).
#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

namespace muster::simbody {

constexpr int unknowns = 8;  // w and v in the body's frame, rates of the left and right wheel
using Velocity = Eigen::Matrix<double, unknowns, 1>;
using MassMatrix = Eigen::Matrix<double, unknowns, unknowns>;

struct Contact {
  Velocity normal;                  // u -> normal speed
  std::array<Velocity, 2> tangent;  // u -> slip speed along the world's x and y
  double friction = 0;
  double softness = 0;  // [m/s per N s]
  double target = 0;    // normal speed below which it pushes [m/s]

  // Results, and where the search for a slipping step begins.
  double push = 0;                                 // normal impulse [N s]
  Eigen::Vector2d grip = Eigen::Vector2d::Zero();  // tangential impulse [N s]
};

struct Motor {
  double asked = 0;  // rate of the wheel [rad/s]
  double limit = 0;  // impulse: torque times step [N m s]
};

struct Problem {
  MassMatrix mass, inverse_mass;
  Velocity free;      // without contacts and motors
  Velocity previous;  // where the search for a slipping step begins
  std::vector<Contact> contacts;
  std::array<Motor, 2> motors;
};

struct Outcome {
  Velocity velocity;
  bool direct = false;    // everything stuck: one linear solve
  bool converged = true;  // the bound of friction agreed with the normal impulse to 1 %
};

// Solves the step and leaves the impulses in the problem's contacts.
Outcome solve(Problem& problem);

}  // namespace muster::simbody
