#include "diagnosis/prediction/sensitivities.hpp"

#include <algorithm>
#include <cmath>

namespace muster::diagnosis {
namespace {

Eigen::VectorXd slope(MeasuredWorld& model, const std::string& path, double lower, double upper, double at) {
  const double step = std::min(1e-4 * (1 + std::abs(at)), (upper - lower) / 4);
  const double low = std::max(at - step, lower), high = std::min(at + step, upper);
  ParameterGuard moved(model);
  moved.set(path, high);
  const Eigen::VectorXd above = model.expected();
  moved.set(path, low);
  const Eigen::VectorXd below = model.expected();
  return (above - below) / (high - low);
}

}  // namespace

Sensitivities sensitivities(MeasuredWorld& model, const std::vector<FitParameter>& free) {
  Sensitivities result;
  const auto n = static_cast<Eigen::Index>(model.rows());
  Eigen::MatrixXd basis(n, 0);
  result.slopes.resize(n, 0);
  // Identifiable parameters first; of the others those that add a direction.
  std::vector<const FitParameter*> order;
  for (const FitParameter& p : free) order.push_back(&p);
  std::stable_partition(order.begin(), order.end(), [](const FitParameter* p) { return p->identifiable; });
  std::vector<double> values, lower, upper;
  for (const FitParameter* p : order) {
    const double at = model.parameter(p->path).value;
    const Eigen::VectorXd column = slope(model, p->path, p->lower, p->upper, at);
    Eigen::VectorXd rest = column;
    for (int twice = 0; twice < 2; ++twice) rest -= basis * (basis.transpose() * rest);
    if (!(rest.norm() > 1e-6 * column.norm()) || column.norm() == 0) continue;
    basis.conservativeResize(Eigen::NoChange, basis.cols() + 1);
    basis.rightCols(1) = rest / rest.norm();
    result.slopes.conservativeResize(Eigen::NoChange, basis.cols());
    result.slopes.rightCols(1) = column;
    result.paths.push_back(p->path);
    values.push_back(at);
    lower.push_back(p->lower);
    upper.push_back(p->upper);
  }
  const auto vector = [](const std::vector<double>& v) {
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size())));
  };
  result.values = vector(values);
  result.lower = vector(lower);
  result.upper = vector(upper);
  result.mean = model.expected();
  return result;
}

Eigen::MatrixXd slopes_at(MeasuredWorld& model, const Sensitivities& base) {
  const auto count = static_cast<Eigen::Index>(base.paths.size());
  for (Eigen::Index j = 0; j < count; ++j) model.set(base.paths[static_cast<std::size_t>(j)], base.values[j]);
  Eigen::MatrixXd result(static_cast<Eigen::Index>(model.rows()), count);
  for (Eigen::Index j = 0; j < count; ++j)
    result.col(j) = slope(model, base.paths[static_cast<std::size_t>(j)], base.lower[j], base.upper[j], base.values[j]);
  return result;
}

}  // namespace muster::diagnosis
