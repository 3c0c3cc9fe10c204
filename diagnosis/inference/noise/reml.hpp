// Minus the log restricted posterior of theta: Vecchia's likelihood of y with the design projected out (REML:
// Patterson and Thompson 1971), and a prior of theta.
#pragma once

#include "diagnosis/inference/noise/basis.hpp"
#include "diagnosis/inference/noise/vecchia.hpp"
#include "diagnosis/inference/thresholds.hpp"

namespace muster::noise {

struct Prior {
  static constexpr double usual_range = 2.4;  // of the logarithm, from the mean to the longest field

  double log_decorrelation = inference::thresholds::prior_log_decorrelation;
  double decorrelation_spread = inference::thresholds::prior_decorrelation_spread;
  double log_longest = log_decorrelation + usual_range;  // ln m
  double logit_shared = inference::thresholds::prior_logit_shared;
  double shared_spread = inference::thresholds::prior_shared_spread;
  double log_least_variance = inference::thresholds::log_least_variance;  // of the field, and of one reading

  Theta lower() const { return {log_least_variance, log_decorrelation - 3, log_least_variance, logit_shared - 4}; }
  Theta upper() const { return {9, log_longest, 9, logit_shared + 4}; }
  Theta inside(const Theta& theta) const { return theta.cwiseMax(lower()).cwiseMin(upper()); }
  bool allows_long() const { return log_longest > log_decorrelation + usual_range; }
  double log_long() const { return (log_decorrelation + usual_range + log_longest) / 2; }  // a long field, ln m
};

// What the prior adds to the objective.
double prior_nats(const Covariance& covariance, const Prior& prior);

struct Objective {
  double value = 0;
  Theta gradient = Theta::Zero();
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();  // Fisher information, with the prior's curvature
  double log_determinant = 0;                             // of the whitened design's triangle
};

// y and the design, whitened.
struct Whitened {
  Basis basis;
  Eigen::VectorXd y, residual;
  double value = 0;  // of the objective
};

Whitened whitened(const Whitener& whitener, const Eigen::VectorXd& y, const Eigen::MatrixXd& design,
                  const Prior& prior);

// With the derivatives for Fisher scoring.
Objective objective(const WhitenerSlopes& slopes, const Eigen::VectorXd& y, const Eigen::MatrixXd& design,
                    const Prior& prior);
inline Objective objective(const Field& field, const Covariance& covariance, const Eigen::VectorXd& y,
                           const Eigen::MatrixXd& design, const Prior& prior) {
  return objective(WhitenerSlopes(field, covariance), y, design, prior);
}

}  // namespace muster::noise
