#include "diagnosis/calibration/censored_likelihood.hpp"

#include <cmath>
#include <numbers>

namespace muster::diagnosis {
namespace {

using std::numbers::pi;

double below(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

// phi(z) / Phi(z), by its continued fraction where Phi would underflow.
double hazard(double z) {
  if (z < -30) return -z - 1 / z;
  return std::exp(-z * z / 2) / std::sqrt(2 * pi) / below(z);
}

double log_below(double z) {
  if (z < -30) return -z * z / 2 - std::log(-z * std::sqrt(2 * pi));
  return std::log(below(z));
}

}  // namespace

Eigen::VectorXd residuals(const Readings& readings, const Eigen::VectorXd& mean, double sigma) {
  Eigen::VectorXd result(readings.used());
  Eigen::Index k = 0;
  for (const auto i : readings.heard) result[k++] = readings.rssi[i] - mean[i];
  for (const auto i : readings.censored) result[k++] = -sigma * hazard((readings.floor_of(i) - mean[i]) / sigma);
  return result;
}

double deviance(const Readings& readings, const Eigen::VectorXd& mean, double sigma) {
  double squares = 0, log_tail = 0;
  for (const auto i : readings.heard) squares += std::pow(readings.rssi[i] - mean[i], 2);
  for (const auto i : readings.censored) log_tail += log_below((readings.floor_of(i) - mean[i]) / sigma);
  return squares / (sigma * sigma) + 2 * static_cast<double>(readings.heard.size()) * std::log(sigma) - 2 * log_tail;
}

double next_sigma(const Readings& readings, const Eigen::VectorXd& mean, double sigma) {
  double squares = 0;
  for (const auto i : readings.heard) squares += std::pow(readings.rssi[i] - mean[i], 2);
  for (const auto i : readings.censored) {
    const double z = (readings.floor_of(i) - mean[i]) / sigma;
    squares += sigma * sigma * (1 - z * hazard(z));  // E[(y - mean)^2 | y < floor]
  }
  return std::sqrt(squares / static_cast<double>(readings.used()));
}

Eigen::MatrixXd jacobian(const Readings& readings, const Mean& mean, const Eigen::VectorXd& at, const Box& box) {
  constexpr double step = 1e-4;  // of the box: exact for linear parameters, and far above rounding
  Eigen::MatrixXd result(readings.used(), at.size());
  for (Eigen::Index j = 0; j < at.size(); ++j) {
    Eigen::VectorXd low = at, high = at;
    low[j] = std::max(box.lower[j], at[j] - step * box.width()[j]);
    high[j] = std::min(box.upper[j], at[j] + step * box.width()[j]);
    const Eigen::VectorXd slope = (mean(high) - mean(low)) / (high[j] - low[j]);
    Eigen::Index k = 0;
    for (const auto i : readings.heard) result(k++, j) = slope[i];
    for (const auto i : readings.censored) result(k++, j) = slope[i];
  }
  return result;
}

}  // namespace muster::diagnosis
