// Means over bins of a covariate, with intervals from a block bootstrap.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace muster::report {

struct Bin {
  double at = 0, mean = 0, low = 0, high = 0;  // middle of the bin; mean and its 95 % interval
  double rows = 0;
};

// `edges`: ascending. Bins with fewer than `least` rows are left out. Values outside or NaN are in no bin.
std::vector<Bin> means_over(const std::vector<double>& edges, const Eigen::VectorXd& x, const Eigen::VectorXd& y,
                            const std::vector<int>& block, int least = 5);

// For independent rows of unit variance.
std::vector<Bin> whitened_means_over(const std::vector<double>& edges, const Eigen::VectorXd& x,
                                     const Eigen::VectorXd& y, int least = 5);

// `count` bins between the smallest and the largest value, equal in length or, with `log`, in ratio.
std::vector<double> edges_of(const Eigen::VectorXd& x, int count, bool log = false);
// One bin for each index 0 ... names - 1.
std::vector<double> edges_of_names(std::size_t names);

}  // namespace muster::report
