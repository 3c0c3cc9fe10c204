// Response of contacts at given velocities, their friction bounds fixed, eight contacts at a time: the part of Newton's
// method that is built for each instruction set as block_kernel.hpp is, with the same bits. friction.hpp has the same
// for one contact.
#pragma once

namespace muster::simbody {

// Eight contacts side by side; unused lanes of the last ones are zero, without effect.
struct alignas(64) ContactLanes {
  static constexpr int width = 8;
  using Lane = double[width];

  Lane target;         // normal speed below which they push [m/s]
  Lane hardness;       // of the normal [N s per m/s]
  Lane grip_softness;  // [m/s per N s]
  Lane bound;          // of friction [N s]
  Lane dual[2];        // estimate of the friction impulse, kept for a better Hessian [N s]

  Lane speed, slip[2];              // normal and tangential [m/s]
  Lane speed_ahead, slip_ahead[2];  // their change along the search direction

  // Results of respond().
  Lane push, grip[2];              // [N s]
  Lane stiffness;                  // of the normal [N s per m/s]
  Lane grip_xx, grip_xy, grip_yy;  // friction's response to slip: the primal-dual Hessian
};

struct LaneArithmetic {
  // Impulses at the present speeds, and their derivatives.
  void (*respond)(ContactLanes* contacts, int count);
  // Updates the duals for a full step.
  void (*move_duals)(ContactLanes* contacts, int count);
  // Contribution of the impulses to the energy's slope at the fraction `a` of the search step.
  double (*slope)(const ContactLanes* contacts, int count, double a);
  // Updates the speeds by the fraction `a` of the step.
  void (*go_ahead)(ContactLanes* contacts, int count, double a);
};

}  // namespace muster::simbody
