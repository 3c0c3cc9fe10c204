// Weights of draws: what they are worth, and who is drawn by them.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace muster::inference {

// As many independent draws of equal weight (Kong 1992).
double worth(const Eigen::VectorXd& weights);

// Where hardly any have all of the weight they tell too little by far; the roots of the weights err to the wide side.
// Sum 1.
Eigen::VectorXd softened(Eigen::VectorXd weights);

// So many indices, each as often as its weight asks for; weights have sum 1.
std::vector<std::size_t> resampled(const Eigen::VectorXd& weights, int count);

}  // namespace muster::inference
