// What errors of readings have in common: shadowing that belongs to places and to ways, and offsets of radios. Its
// variances by restricted likelihood on clusters (Patterson and Thompson 1971); docs/explanation/fit_method.md says why
// it is so.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "diagnosis/calibration/reading_clusters.hpp"

namespace muster::diagnosis {

// Covariances between clusters for one decorrelation distance and unit variance.
struct Kernels {
  double decorrelation = 0;             // m
  std::vector<Eigen::MatrixXd> shapes;  // by place, by way, and by radio where there are many pairs
};

// For a range of decorrelation distances.
std::vector<Kernels> kernels_of(const Clusters& clusters);

// What a fit's errors may be made of: one choice of kinds and of a decorrelation distance, and its share of belief
// among the others.
struct Components {
  std::size_t kernels = 0;      // whose decorrelation distance
  std::vector<bool> kinds;      // of shapes that may have a variance
  Eigen::VectorXd variances;    // dB^2, one a shape
  Eigen::MatrixXd uncertainty;  // covariance of the variances
  double belief = 0;
};

class ErrorModel {
 public:
  ErrorModel(const Clusters& clusters, const std::vector<Kernels>& kernels) : clusters_(clusters), kernels_(kernels) {}

  // From residuals of ordinary least squares on these columns, one row a reading.
  void fit(const Eigen::VectorXd& residual, const Eigen::MatrixXd& columns);

  // The same where readings share nothing, by the world's own word.
  void fit_white(const Eigen::VectorXd& residual, const Eigen::MatrixXd& columns);

  // Covariance of columns^T error.
  Eigen::MatrixXd of_sums(const Eigen::MatrixXd& columns) const;

  // How a sum of errors is spread: by Student's t for each belief, its degrees of freedom after Satterthwaite (1946).
  struct Spread {
    struct Part {
      double belief, sd, freedom;
    };
    std::vector<Part> parts;
    double variance = 0, freedom = 0;  // of all together
    // Half the length of the interval that holds this share.
    double reach(double share) const;
  };
  // Of a weighted sum of the errors: weights^T error.
  Spread of_sum(const Eigen::VectorXd& weights) const;

  const std::vector<Components>& components() const { return components_; }
  // sd in dB of what a reading shares with no other.
  double white_sd() const { return std::sqrt(white_.mean()); }
  // sd in dB of what readings share, its decorrelation distance in m, and twice the log-likelihood that it gains.
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
