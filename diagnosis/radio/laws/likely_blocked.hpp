// Readings of a link during which somebody stood in the way.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace muster::diagnosis {

// How people cross a link: `loss` in dB, for a share of the time, of a mean `duration` in s.
struct Crossings {
  double loss, share, duration;
};

// Of each reading of one link, in order of time [s], the probability that it was blocked: a hidden Markov chain of two
// states in continuous time (Rabiner 1989, forward and backward), whose readings are normal about a running median of
// `residual` [dB], and the loss below it while blocked. A change of level over many crossings is no crossing.
std::vector<double> probability_blocked(const std::vector<double>& time, const Eigen::VectorXd& residual,
                                        const Crossings& crossings);

}  // namespace muster::diagnosis
