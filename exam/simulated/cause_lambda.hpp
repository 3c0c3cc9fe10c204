// Lambda of causes planted in the simulator's worlds.
#pragma once

#include "exam/reading_law.hpp"
#include "exam/simulated/link_covariance.hpp"
#include "exam/simulated/planted_cause.hpp"

namespace muster::exam::simulated {

// Mean and variance of a Rician fade in dB (Rice 1945), by quadrature; -40 dB is Rayleigh's law.
Moments rician_moments(double k_db);

// 2 x the Kullback-Leibler divergence of one reading under `cause` from the world's law. That may be blurred by a
// Gaussian up to the same variance, since no world states all the error of a reading.
double reading_divergence(const PlantedCause& cause, double rician_k, bool has_fading, double step);

// Whitened energy of blockage as it happened, less twice the logarithm of the number of times at which each passage may
// have been, where that is less.
double blockage_lambda(const Eigen::VectorXd& loss, const Setting& setting, const LinkCovariance& covariance,
                       const Eigen::MatrixXd& others, double duration);

// 2 x the log-likelihood ratio of the pattern of readings below a silent floor against random loss, once a spot.
double silence_lambda(const Setting& setting, double floor, double sd);

// Squared length of a whitened effect that no combination of whitened columns reaches.
double unexplained(const Eigen::VectorXd& effect, const Eigen::MatrixXd& others);

}  // namespace muster::exam::simulated
