// Generic smooths along everything that a reading has: distance, bearings, time, place, each column, each factor, and
// products. What is left after the named causes shows in one of them, whatever its reason.
#pragma once

#include "diagnosis/inference/state/problem.hpp"

namespace muster::inference {

std::vector<Candidate> smooths_of(const Problem& problem);

// Cosines of a covariate over its range; may grow.
Candidate smooth_of(const std::string& name, const Eigen::VectorXd& values, int functions);
// Harmonics of an angle [rad]; may grow.
Candidate smooth_of_angle(const std::string& name, const Eigen::VectorXd& angle, int harmonics);

}  // namespace muster::inference
