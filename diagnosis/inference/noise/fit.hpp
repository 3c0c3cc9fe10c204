// Fits the covariance by Fisher scoring on the restricted posterior (REML), selects the family by its value, and
// draws theta around the fit.
#pragma once

#include "diagnosis/inference/noise/reml.hpp"
#include "diagnosis/inference/thresholds.hpp"

namespace muster::noise {

struct Fit {
  Covariance covariance;
  double value = 0;                                         // of the objective
  Eigen::Matrix4d curvature = Eigen::Matrix4d::Identity();  // of the objective
  double log_determinant = 0;                               // of the whitened design's triangle

  // nats, with the design's coefficients at their best; the prior of theta included.
  double log_likelihood() const { return log_determinant - value; }
};

// Start of a fit without prior knowledge: seven tenths of the least-squares variance belong to the field.
Covariance default_start(const Eigen::VectorXd& y, const Eigen::MatrixXd& design, Family family);

// `moves`: 1 for entries of theta that are fitted, 0 for those held at the start.
Fit fit(const Field& field, const Eigen::VectorXd& y, const Eigen::MatrixXd& design, const Prior& prior,
        const Covariance& start, int steps = 12, const Theta& moves = Theta::Ones());
// The same from a start within the prior's limits at which the field is factorised.
Fit fit(const Field& field, const Eigen::VectorXd& y, const Eigen::MatrixXd& design, const Prior& prior,
        const WhitenerSlopes& start, int steps);
// The same from a long field, too, where the prior allows it: between it and a short one the likelihood may have a
// valley.
Fit fit_long_too(const Field& field, const Eigen::VectorXd& y, const Eigen::MatrixXd& design, const Prior& prior,
                 const Covariance& start, int steps);
// The same over the start's fixed share and the shares beside it, as far as the value falls. As fit() without one.
Fit fit_over_shares(const Field& field, const Eigen::VectorXd& y, const Eigen::MatrixXd& design, const Prior& prior,
                    const WhitenerSlopes& start, int steps);
// Entries of theta that no model states: the variance of one reading, and the correlation between groups.
inline const Theta unstated{0, 0, 1, 1};

// Every family's fit, the best one first. Leaving the stated family, or else the exponential one, takes `advantage`
// nats.
std::vector<Fit> fit_families(const Field& field, const Eigen::VectorXd& y, const Eigen::MatrixXd& design,
                              const Prior& prior, double advantage = inference::thresholds::leave_exponential_nats);

struct Draw {
  Theta theta;
  double log_density;  // of the proposal, up to a constant; 0 at the fit
};

// Draws around a fit from a t distribution with 6 degrees of freedom, in antithetic pairs.
std::vector<Draw> draws(const Fit& fit, int count, uint64_t seed);

}  // namespace muster::noise
