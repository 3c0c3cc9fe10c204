// Importance weights of draws: effective sample size, tempering and resampling.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace muster::inference {

// Number of independent draws of equal weight with the same variance (Kong 1992).
double effective_sample_size(const Eigen::VectorXd& weights);

// Square roots of the weights, repeated until the effective sample size is sufficient. Few dominant weights
// understate the spread by far; tempered ones err to the wide side. Sum 1.
Eigen::VectorXd tempered(Eigen::VectorXd weights);

// Systematic resampling: `count` indices, each in proportion to its weight; weights have sum 1.
std::vector<std::size_t> resampled(const Eigen::VectorXd& weights, int count);

}  // namespace muster::inference
