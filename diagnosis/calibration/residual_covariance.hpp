// Shared errors of readings: shadowing by place and by path, and offsets of radios. Variance components by restricted
// likelihood (REML) on clusters (Patterson and Thompson 1971); docs/explanation/fit_method.md gives the reasons.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "diagnosis/calibration/reading_clusters.hpp"

namespace muster::diagnosis {

// Covariances between clusters for one decorrelation distance and unit variance.
struct Kernels {
  double decorrelation = 0;             // m
  std::vector<Eigen::MatrixXd> shapes;  // by place, by path, and by radio if there are many pairs
};

// Kernels for a range of decorrelation distances.
std::vector<Kernels> kernels_of(const Clusters& clusters);

// One model of the errors: a choice of kinds and of a decorrelation distance, and its posterior weight.
struct Components {
  std::size_t kernels = 0;      // index of the kernels, one for each decorrelation distance
  std::vector<bool> kinds;      // true for shapes with a variance
  Eigen::VectorXd variances;    // dB^2, one a shape
  Eigen::MatrixXd uncertainty;  // covariance of the variances
  double belief = 0;
};

class ErrorModel {
 public:
  ErrorModel(const Clusters& clusters, const std::vector<Kernels>& kernels) : clusters_(clusters), kernels_(kernels) {}

  // Fits to residuals of ordinary least squares on these columns, one row a reading.
  void fit(const Eigen::VectorXd& residual, const Eigen::MatrixXd& columns);

  // The same for independent errors, if the world declares none to be shared.
  void fit_white(const Eigen::VectorXd& residual, const Eigen::MatrixXd& columns);

  // Covariance of columns^T error.
  Eigen::MatrixXd of_sums(const Eigen::MatrixXd& columns) const;

  // Distribution of a sum of errors: a mixture of Student's t over the models, degrees of freedom after Satterthwaite
  // (1946).
  struct Spread {
    struct Part {
      double belief, sd, freedom;
    };
    std::vector<Part> parts;
    double variance = 0, freedom = 0;  // of the whole mixture
    // Half-width of the interval with this probability.
    double reach(double share) const;
  };
  // Distribution of a weighted sum of the errors, weights^T error.
  Spread of_sum(const Eigen::VectorXd& weights) const;

  const std::vector<Components>& components() const { return components_; }
  // sd in dB of the independent part of a reading's error.
  double white_sd() const { return std::sqrt(white_.mean()); }
  // sd in dB of the shared part, its decorrelation distance in m, and twice the log-likelihood that it gains.
  double shared_sd() const;
  double decorrelation() const;
  double shared_evidence() const { return evidence_; }

 private:
  struct Likelihood;
  Eigen::MatrixXd cluster_sums(const Eigen::MatrixXd& columns) const;
  void share_belief();
  void measure_white(const Eigen::VectorXd& residual, const Eigen::VectorXd& means, Eigen::Index columns);
  Eigen::VectorXd white_of_rows() const;

  const Clusters& clusters_;
  const std::vector<Kernels>& kernels_;
  std::vector<Components> components_;
  Eigen::VectorXd white_;  // dB^2, one a cluster
  double white_freedom_ = 1, evidence_ = 0;
};

}  // namespace muster::diagnosis
