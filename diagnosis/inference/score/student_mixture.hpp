// Mixture of multivariate Student t distributions, equally weighted: a proposal for importance sampling with tails
// heavier than any likelihood's.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "muster/random.hpp"

namespace muster::inference {

class StudentMixture {
 public:
  // One scale for all. Entries with zero variance in it are equal in all centres and all draws.
  StudentMixture(std::vector<Eigen::VectorXd> centres, const Eigen::MatrixXd& scale);

  Eigen::VectorXd draw(const Stream& stream, uint64_t number) const;
  double density(const Eigen::VectorXd& at) const;  // up to a factor that depends on the number of varying entries

 private:
  Eigen::VectorXd whitened(const Eigen::VectorXd& theta) const;

  std::vector<Eigen::VectorXd> centres_;
  std::vector<Eigen::Index> varying_;
  Eigen::MatrixXd root_;      // lower Cholesky factor of the scale of those
  Eigen::MatrixXd whitened_;  // the centres
};

}  // namespace muster::inference
