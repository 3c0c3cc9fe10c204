// A sparse symmetric positive definite system whose entries are the square blocks of robots that touch.
#pragma once

#include <Eigen/Dense>
#include <utility>
#include <vector>

namespace muster::simbody {

// Unknowns of a robot: w and v in the body's frame, and the rates of its joints. Wheels: the left and the right one. A
// robot with fewer joints than there is room for has idle ones of mass 1.
constexpr int unknowns = 8, unknowns_with_legs = 12;

template <int N>
using VelocityOf = Eigen::Matrix<double, N, 1>;
template <int N>
using MassMatrixOf = Eigen::Matrix<double, N, N>;
using Velocity = VelocityOf<unknowns>;
using MassMatrix = MassMatrixOf<unknowns>;

// Joints of one robot are coupled through its body alone: with many of them a robot by itself costs little more than
// its body.
template <int N>
class BlockCholeskyOf {
 public:
  using Velocity = VelocityOf<N>;
  using MassMatrix = MassMatrixOf<N>;

  // `count` blocks on the diagonal, and one for each pair beside it. The order of elimination is that of least degree
  // (the smaller index where degrees are equal), so it depends on nothing but the pairs.
  void arrange(int count, const std::vector<std::pair<int, int>>& pairs);

  // Between arrange() or solve() and factor(): blocks beside the diagonal begin at zero, those on it are to be set.
  void clear_pairs();
  MassMatrix& diagonal(int i) { return diagonal_[i]; }
  // Adds k a b^T at block (i, j), i != j, and its mirror image.
  void add(int i, int j, double k, const Velocity& a, const Velocity& b);

  void factor();
  void solve(std::vector<Velocity>& x) const;

 private:
  struct Below {
    int row;
    MassMatrix block;
  };

  static constexpr bool has_many_joints = N > unknowns;
  using BodyBlock = Eigen::Matrix<double, 6, 6>;

  MassMatrix& below(int row, int column);
  bool is_alone() const { return has_many_joints && order_.size() == 1; }

  std::vector<MassMatrix> diagonal_;
  std::vector<std::vector<Below>> columns_;  // what stands below the diagonal once the order is applied
  std::vector<int> order_, place_;           // of elimination, and its inverse
  std::vector<Eigen::LLT<MassMatrix>> factor_;
  std::vector<MassMatrix> inverse_;                 // of the factors' triangles, where there are several
  Eigen::LLT<BodyBlock> body_;                      // of one alone: what its joints leave of the body
  Eigen::Matrix<double, N - 6, 6> joints_by_body_;  // and how they follow it
};

using BlockCholesky = BlockCholeskyOf<unknowns>;

}  // namespace muster::simbody
