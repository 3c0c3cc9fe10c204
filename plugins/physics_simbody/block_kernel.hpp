// Arithmetic on small square blocks, several lanes at a time: the part built for each instruction set. All kernels give
// the same bits: lanes are rows, whose sums have one order, and nothing is fused.
//
// Only plain data cross this border: the linker could replace a function that both sides compile by its newest form.
#pragma once

#include "contact_lanes.hpp"

namespace muster::simbody {

// Addresses of contacts' rows: three of the body and, `other` numbers on, three of the other body. `bodies` has the
// numbers of both, -1 for no other. Contacts are `stride` numbers apart.
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
  // and `k` has those four numbers.
  void (*add_contacts)(double* block, int count, const double* const* a, const double* const* b, const double* k);
  // add_speeds: the products of a contact's three rows with a velocity, added to `sums`. subtract_rows: to -= k_0 a_0 +
  // k_1 a_1 + k_2 a_2.
  void (*add_speeds)(double* sums, const double* a, const double* velocity);
  void (*subtract_rows)(double* to, const double* a, const double* k);
  // The same for all contacts: their speeds and slips ahead from the bodies' velocities, and their impulses subtracted
  // from the bodies' momenta. Velocities and momenta are contiguous.
  void (*look_ahead)(const ContactTable& table, const double* velocities, ContactLanes* contacts);
  void (*take_impulses)(const ContactTable& table, const ContactLanes* contacts, double* momenta);
  // Inverse of the transposed Cholesky factor, L^-T, of a symmetric positive definite block, of which it reads the
  // diagonal and below. NaN if not positive definite.
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

// The kernels that this machine can run, the best last; at least one.
struct BlockKernels {
  int number = 0;
  const BlockKernel* all[3] = {};
};
BlockKernels block_kernels();

// Arithmetic of the best kernel.
template <int N>
const BlockArithmetic<N>& block_arithmetic();
const LaneArithmetic& lane_arithmetic();

}  // namespace muster::simbody
