#include "diagnosis/causes/start_grid.hpp"

#include <algorithm>

#include "diagnosis/causes/thresholds.hpp"

namespace muster::diagnosis {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd theta_of(std::size_t row, const VectorXd& place, const std::vector<double>& axes) {
  std::vector<double> theta{static_cast<double>(row)};
  theta.insert(theta.end(), place.begin(), place.end());
  theta.insert(theta.end(), axes.begin(), axes.end());
  return Eigen::Map<const VectorXd>(theta.data(), static_cast<Index>(theta.size()));
}

std::vector<std::vector<double>> products(const std::vector<Axis>& axes) {
  std::vector<std::vector<double>> result{{}};
  for (const Axis& axis : axes) {
    std::vector<std::vector<double>> longer;
    for (const auto& begun : result) {
      for (const double value : axis.values) {
        longer.push_back(begun);
        longer.back().push_back(value);
      }
    }
    result = std::move(longer);
  }
  return result;
}

namespace {

// Of many rows each has few readings, and only the first values of a long axis: slow swings.
bool too_fine(const CauseShape& shape, std::size_t row, const std::vector<double>& values) {
  if (shape.rows.size() <= thresholds::few_rows || shape.row_label(theta_of(row, VectorXd(), {})).empty()) return false;
  for (std::size_t k = 0; k < shape.axes.size(); ++k) {
    const std::vector<double>& all = shape.axes[k].values;
    if (all.size() > thresholds::most_values_of_many_rows &&
        std::find(all.begin(), all.end(), values[k]) - all.begin() >=
            static_cast<std::ptrdiff_t>(thresholds::most_values_of_many_rows))
      return true;
  }
  return false;
}

}  // namespace

std::vector<VectorXd> start_grid(const CauseShape& shape, const std::vector<VectorXd>& places) {
  std::vector<VectorXd> result;
  // Shapes outermost, rows innermost: rows at one shape cost one evaluation.
  for (const VectorXd& place : places) {
    for (const auto& values : products(shape.axes)) {
      for (std::size_t row = 0; row < shape.rows.size(); ++row) {
        if (!too_fine(shape, row, values)) result.push_back(theta_of(row, place, values));
      }
    }
  }
  return result;
}

}  // namespace muster::diagnosis
