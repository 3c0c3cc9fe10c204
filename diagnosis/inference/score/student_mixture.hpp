// Multivariate Student t distributions about several centres, equally likely: what to draw from where a likelihood has
// any shape, and which no likelihood's tails outlast.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "muster/random.hpp"

namespace muster::inference {

class StudentMixture {
 public:
  // All of one scale. Entries whose variance in it is zero are the same in all centres and in all draws.
  StudentMixture(std::vector<Eigen::VectorXd> centres, const Eigen::MatrixXd& scale);

  Eigen::VectorXd draw(const Stream& stream, uint64_t number) const;
  double density(const Eigen::VectorXd& at) const;  // up to a factor, that of how many entries vary

 private:
  Eigen::VectorXd whitened(const Eigen::VectorXd& theta) const;

  std::vector<Eigen::VectorXd> centres_;
  std::vector<Eigen::Index> varying_;
  Eigen::MatrixXd root_;      // of the scale of those, lower triangular
  Eigen::MatrixXd whitened_;  // the centres
};

}  // namespace muster::inference
