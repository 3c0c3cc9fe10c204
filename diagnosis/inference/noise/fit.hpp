// The covariance that the rows speak for: Fisher scoring on the restricted posterior, the family by its value, and
// draws of theta around the fit.
#pragma once

#include "diagnosis/inference/noise/reml.hpp"

namespace muster::noise {

struct Fit {
  Covariance covariance;
  double value = 0;                                         // of the objective
  Eigen::Matrix4d curvature = Eigen::Matrix4d::Identity();  // of the objective
};

// Before anything is known of theta: seven tenths of what least squares leaves belong to the field.
Covariance default_start(const Eigen::VectorXd& y, const Eigen::MatrixXd& design, Family family);

// `moves`: 1 for what is fitted of theta, 0 for what is held at the start.
Fit fit(const Field& field, const Eigen::VectorXd& y, const Eigen::MatrixXd& design, const Prior& prior,
        const Covariance& start, int steps = 12, const Theta& moves = Theta::Ones());
// What of theta no world states: the variance of one reading and what rows of different groups share.
inline const Theta unstated{0, 0, 1, 1};

// Every family's fit, the best one first. Leaving the exponential family takes `advantage` nats.
std::vector<Fit> fit_families(const Field& field, const Eigen::VectorXd& y, const Eigen::MatrixXd& design,
                              const Prior& prior, double advantage = 2);

struct Draw {
  Theta theta;
  double log_density;  // of the proposal, but for a constant; at the fit 0
};

// Around a fit from a t distribution with 6 degrees of freedom, in pairs opposite to each other.
std::vector<Draw> draws(const Fit& fit, int count, uint64_t seed);

}  // namespace muster::noise
