// Block Cholesky factorisation of a sparse symmetric positive definite system, with a square block per robot and per
// pair in contact.
#pragma once

#include <Eigen/Dense>
#include <utility>
#include <vector>

#include "block_kernel.hpp"
#include "blocks.hpp"

namespace muster::simbody {

// Unknowns of a robot: w and v in the body's frame, and the rates of its joints. Wheels: the left and the right one.
// Unused joints are idle ones of mass 1.
constexpr int unknowns = 8, unknowns_with_legs = 12;

template <int N>
using VelocityOf = Eigen::Matrix<double, N, 1>;
template <int N>
using MassMatrixOf = Eigen::Matrix<double, N, N>;
using Velocity = VelocityOf<unknowns>;
using MassMatrix = MassMatrixOf<unknowns>;

// A robot's legs are coupled through its body alone: a single robot then costs little more than its body. Limbs may be
// coupled with each other.
template <int N>
class BlockCholeskyOf {
 public:
  using Velocity = VelocityOf<N>;
  using MassMatrix = MassMatrixOf<N>;

  // `count` blocks on the diagonal, and one off it for each pair. Minimum-degree ordering (the smaller index where
  // degrees are equal), so the order depends on the pairs alone.
  void arrange(int count, const std::vector<std::pair<int, int>>& pairs);

  // Between arrange() or solve() and factor(): off-diagonal blocks begin at zero, diagonal ones are to be set.
  void clear_pairs();
  MassMatrix& diagonal(int i) { return diagonal_[i]; }
  // Adds a^T K b of each contact, as BlockArithmetic has it, at block (i, j), i != j, and its mirror image.
  void add_contacts(int i, int j, int count, const double* const* a, const double* const* b, const double* k);

  void factor();
  void solve(Blocks<Velocity>& x) const;

 private:
  struct alignas(cache_line) Below {
    MassMatrix block;
    int row;
  };

  static constexpr bool has_many_joints = N == unknowns_with_legs;
  using BodyBlock = Eigen::Matrix<double, 6, 6>;

  MassMatrix& below(int row, int column);
  bool couples_joints_by_body() const;
  void factor_alone();
  void solve_alone(Velocity& x) const;

  const BlockArithmetic<N>& of_robots_ = block_arithmetic<N>();
  const BlockArithmetic<6>& of_bodies_ = block_arithmetic<6>();

  Blocks<MassMatrix> diagonal_;
  std::vector<std::vector<Below>> columns_;         // blocks below the diagonal in elimination order
  std::vector<int> order_, place_;                  // of elimination, and its inverse
  Blocks<MassMatrix> inverse_;                      // of the transposed factors
  bool is_alone_ = false;                           // one robot whose joints are coupled through its body
  BodyBlock body_;                                  // the same for a single robot: Schur complement of its body
  Eigen::Matrix<double, 6, N - 6> body_by_joints_;  // and its coupling to the joints
};

using BlockCholesky = BlockCholeskyOf<unknowns>;

}  // namespace muster::simbody
