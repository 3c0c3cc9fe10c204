// The covariance of a row and its neighbours, factorised for eight rows side by side: every operation works on all
// lanes alike, so the compiler's vectors change no bit.
#pragma once

#include "diagnosis/noise/vecchia.hpp"

namespace muster::noise {

using Lanes = Eigen::Array<double, Field::lanes, 1>;

class Neighbourhood {
 public:
  Neighbourhood(const Field& field, const Covariance& covariance);

  // The rows of one group. Slots without a neighbour hold an independent value of variance one and get weight zero.
  void factorise(Index group);
  // One value a slot, then the row's own: minus the weights of the best prediction and one, over its standard
  // deviation.
  const std::vector<Lanes>& combination() const { return combination_; }

  // After factorise(): derivatives by the four parameters of theta.
  void differentiate(Index group);
  const std::vector<Lanes>& slope(std::size_t parameter) const { return slope_[parameter]; }
  const Lanes& log_slope(std::size_t parameter) const { return log_slope_[parameter]; }
  Lanes information(std::size_t p, std::size_t q) const;

 private:
  using Table = std::vector<double>;
  Lanes looked_up(const Table& near, const Table& joint, Index group, Index pair) const;
  void own_variances(Index group);
  void times_derivative(const Table& near, const Table& joint, Index group, std::vector<Lanes>& out) const;
  void solve_forward(std::vector<Lanes>& x) const;
  void solve_backward(const std::vector<Lanes>& x, std::vector<Lanes>& out) const;
  Lanes& root(Index a, Index b) { return root_[static_cast<std::size_t>(a * slots_ + b)]; }
  const Lanes& root(Index a, Index b) const { return root_[static_cast<std::size_t>(a * slots_ + b)]; }

  const Field& field_;
  Index slots_;
  double field_variance_, reading_variance_;
  // Covariance of two places: near + joint; and their derivatives by log decorrelation distance and by logit rho.
  Table near_, joint_, near_by_distance_, joint_by_distance_, near_by_share_, joint_by_share_;
  std::vector<Lanes> root_;     // lower triangle; the diagonal holds its inverse
  std::vector<Lanes> cross_;    // the last row of the factor that has the row itself at the end
  Lanes inverse_sd_;            // of the row given its neighbours
  std::vector<Lanes> nugget_;   // reading variance over count, a slot, then the row
  std::vector<Lanes> present_;  // 1 where a slot has a neighbour
  std::vector<Lanes> combination_;
  std::array<std::vector<Lanes>, 4> turned_;  // last row of L^-1 dC L^-T
  std::array<std::vector<Lanes>, 4> slope_;
  std::array<Lanes, 4> log_slope_;
};

}  // namespace muster::noise
