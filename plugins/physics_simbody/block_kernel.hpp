// Arithmetic on square blocks of few unknowns, several lanes at a time: the part that is built for each instruction
// set. All kernels give the same bits: lanes are rows, whose sums have one order, and nothing is fused.
//
// Only plain data cross this border: a function that both sides compile could be linked in its newest form everywhere.
#pragma once

#include "contact_lanes.hpp"

namespace muster::simbody {

// Rows of contacts where they lie: of each three of its body and, `other` numbers on, three of the other; both by
// number in `bodies`, -1 where there is no other. Contacts stand `stride` numbers apart.
struct ContactTable {
  int count;
  const double* rows;
  long stride, other;
  const int* bodies;
};

// Matrices are N x N by columns, rows of contacts N numbers each, one after the other.
template <int N>
struct BlockArithmetic {
  static constexpr int most_contacts = 8;

  void (*copy)(double* to, const double* from);
  // block += a^T K b for each of at most so many contacts: a and b are its three rows, K is [n 0 0; 0 xx xy; 0 xy yy],
  // of which `k` has those four.
  void (*add_contacts)(double* block, int count, const double* const* a, const double* const* b, const double* k);
  // What each of a contact's three rows makes of a velocity, added to `sums`; and to -= k_0 a_0 + k_1 a_1 + k_2 a_2.
  void (*add_speeds)(double* sums, const double* a, const double* velocity);
  void (*subtract_rows)(double* to, const double* a, const double* k);
  // The same of all contacts: what the bodies' velocities make of their speeds and slips ahead, and what their impulses
  // take from the bodies' momenta. Both stand one after the other.
  void (*look_ahead)(const ContactTable& table, const double* velocities, ContactLanes* contacts);
  void (*take_impulses)(const ContactTable& table, const ContactLanes* contacts, double* momenta);
  // Of a symmetric positive definite block, of which only what is on and below the diagonal counts: the inverse of the
  // transposed Cholesky factor, L^-T. No numbers where it is not positive definite.
  void (*invert_factor)(const double* block, double* inverse);
  // a := a u, where u is an upper triangle.
  void (*multiply)(double* a, const double* u);
  // to -= a b^T.
  void (*subtract)(double* to, const double* a, const double* b);
  // to -= a x; to -= a^T x.
  void (*subtract_product)(double* to, const double* a, const double* x);
  void (*subtract_transposed)(double* to, const double* a, const double* x);
  // x := a x; x := a^T x.
  void (*apply)(double* x, const double* a);
  void (*apply_transposed)(double* x, const double* a);
};

struct BlockKernel {
  const char* name;
  BlockArithmetic<6> six;
  BlockArithmetic<8> eight;
  BlockArithmetic<12> twelve;
  LaneArithmetic lanes;
};

// Those that this machine can run, the best last; at least one.
struct BlockKernels {
  int number = 0;
  const BlockKernel* all[3] = {};
};
BlockKernels block_kernels();

// Of the best.
template <int N>
const BlockArithmetic<N>& block_arithmetic();
const LaneArithmetic& lane_arithmetic();

}  // namespace muster::simbody
