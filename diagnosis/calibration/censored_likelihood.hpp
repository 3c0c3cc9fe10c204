// Tobit likelihood of readings given a model's mean (Tobin 1958): squared residuals of received ones, the probability
// of a level below the floor for censored ones.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

namespace muster::diagnosis {

struct Readings {
  Eigen::VectorXd rssi;                  // dBm, one a row; NaN: not received
  std::vector<Eigen::Index> heard{};     // rows
  std::vector<Eigen::Index> censored{};  // rows with a level below `floor`; none where losses are random
  double floor = 0;                      // dBm, of what was received
  Eigen::VectorXd referred{};            // dB, taken off each row to refer it to one power; empty: nothing was

  // A level that was received in that row, referred to the one power.
  double referred_to(double level, Eigen::Index row) const { return referred.size() ? level - referred[row] : level; }
  double floor_of(Eigen::Index row) const { return referred_to(floor, row); }
  // Referred levels as they were received.
  Eigen::VectorXd received(const Eigen::VectorXd& levels) const {
    return referred.size() ? Eigen::VectorXd(levels + referred) : levels;
  }

  Eigen::Index used() const { return static_cast<Eigen::Index>(heard.size() + censored.size()); }
};

// The expected reading of every row, dBm, as a function of the free parameters.
using Mean = std::function<Eigen::VectorXd(const Eigen::VectorXd& parameters)>;

struct Box {
  Eigen::VectorXd lower, upper;
  Eigen::VectorXd width() const { return upper - lower; }
  Eigen::VectorXd inside(const Eigen::VectorXd& x) const { return x.cwiseMax(lower).cwiseMin(upper); }
};

// Residuals, received rows first, then censored ones with their expectation below the floor.
Eigen::VectorXd residuals(const Readings& readings, const Eigen::VectorXd& mean, double sigma);

// Minus twice the log-likelihood, up to constants; without censored rows the sum of squares over sigma^2.
double deviance(const Readings& readings, const Eigen::VectorXd& mean, double sigma);

// One EM step from `sigma` towards the maximum-likelihood standard deviation of residuals.
double next_sigma(const Readings& readings, const Eigen::VectorXd& mean, double sigma);

// Rows as in residuals(): derivatives of the mean by central differences inside the box.
Eigen::MatrixXd jacobian(const Readings& readings, const Mean& mean, const Eigen::VectorXd& at, const Box& box);

}  // namespace muster::diagnosis
