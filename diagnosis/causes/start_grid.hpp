// Start values of a search for a cause: every row with every place and every combination of axis values.
#pragma once

#include "diagnosis/causes/cause_shape.hpp"

namespace muster::diagnosis {

// Index of the row, entries of the place, values of the axes.
Eigen::VectorXd theta_of(std::size_t row, const Eigen::VectorXd& place, const std::vector<double>& axes);
// Cartesian product of the axes' values.
std::vector<std::vector<double>> products(const std::vector<Axis>& axes);
// All rows at all places and axis values. `places`: a single empty vector for a cause without a place.
std::vector<Eigen::VectorXd> start_grid(const CauseShape& shape, const std::vector<Eigen::VectorXd>& places);

}  // namespace muster::diagnosis
