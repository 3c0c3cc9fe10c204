// What a contact does at some velocity, its friction's bound held fixed, of eight contacts at a time: the part of
// Newton's method that is built for each instruction set as block_kernel.hpp is, with the same bits. grip.hpp says the
// same of one contact.
#pragma once

namespace muster::simbody {

// Eight contacts side by side; places of the last ones that nobody takes are zero, and do nothing.
struct alignas(64) ContactLanes {
  static constexpr int width = 8;
  using Lane = double[width];

  Lane target;         // normal speed below which they push [m/s]
  Lane hardness;       // of the normal [N s per m/s]
  Lane grip_softness;  // [m/s per N s]
  Lane bound;          // of friction [N s]
  Lane dual[2];        // estimate of the grip, kept for a better Hessian [N s]

  Lane speed, slip[2];              // normal and tangential [m/s]
  Lane speed_ahead, slip_ahead[2];  // what the direction of a search adds to them

  // What respond() finds.
  Lane push, grip[2];              // [N s]
  Lane stiffness;                  // of the normal [N s per m/s]
  Lane grip_xx, grip_xy, grip_yy;  // and how the grip answers slip: the primal-dual Hessian
};

struct LaneArithmetic {
  // Impulses at the speeds that stand, and how they answer changes.
  void (*respond)(ContactLanes* contacts, int count);
  // The duals after a step ahead, whole.
  void (*move_duals)(ContactLanes* contacts, int count);
  // What impulses take from the energy's slope along a search at the share `a` of it.
  double (*slope)(const ContactLanes* contacts, int count, double a);
  // Speeds after the share `a` of the step ahead.
  void (*go_ahead)(ContactLanes* contacts, int count, double a);
};

}  // namespace muster::simbody
