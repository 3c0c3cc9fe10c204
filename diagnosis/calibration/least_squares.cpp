#include "diagnosis/calibration/least_squares.hpp"

#include <cmath>

#include "diagnosis/inference/noise/dense_solvers.hpp"

namespace muster::diagnosis {
namespace {

constexpr double least_sigma = 1e-9;  // dB, for data with an exact fit

// One damped Gauss-Newton step (active set): parameters at a bound that blocks descent are held.
Eigen::VectorXd damped_step(const Eigen::MatrixXd& normal, const Eigen::VectorXd& gradient, double damping,
                            const Eigen::VectorXd& at, const Box& box) {
  const auto held = [&](Eigen::Index j) {
    return (at[j] <= box.lower[j] && gradient[j] < 0) || (at[j] >= box.upper[j] && gradient[j] > 0);
  };
  Eigen::MatrixXd a = normal;
  Eigen::VectorXd b = gradient;
  a.diagonal() *= 1 + damping;
  for (Eigen::Index j = 0; j < at.size(); ++j) {
    if (!held(j)) continue;
    a.row(j).setZero();
    a.col(j).setZero();
    a(j, j) = 1;
    b[j] = 0;
  }
  return box.inside(at + noise::solve_symmetric(a, b)) - at;
}

std::vector<bool> bounds_met(const Eigen::VectorXd& at, const Box& box) {
  std::vector<bool> result;
  for (Eigen::Index j = 0; j < at.size(); ++j)
    result.push_back(std::min(at[j] - box.lower[j], box.upper[j] - at[j]) <= 1e-9 * box.width()[j]);
  return result;
}

}  // namespace

Minimum least_squares(const Readings& readings, const Mean& mean, const Eigen::VectorXd& start, const Box& box) {
  constexpr int most = 500;
  constexpr double enough = 1e-11;  // of the box
  Minimum best{.parameters = box.inside(start)};
  Eigen::VectorXd at_best = mean(best.parameters);
  best.evaluations = 1;
  best.sigma = 10;
  for (int i = 0; i < 3; ++i) best.sigma = std::max(next_sigma(readings, at_best, best.sigma), least_sigma);
  double damping = 0;
  Eigen::MatrixXd slopes;
  for (int iteration = 0; iteration < most && !best.converged; ++iteration) {
    if (iteration < 5 || iteration % 10 == 0) {
      slopes = jacobian(readings, mean, best.parameters, box);
      best.evaluations += 2 * static_cast<int>(best.parameters.size());
    }
    best.deviance = deviance(readings, at_best, best.sigma);
    const Eigen::VectorXd gradient = slopes.transpose() * residuals(readings, at_best, best.sigma);
    const Eigen::VectorXd step = damped_step(slopes.transpose() * slopes, gradient, damping, best.parameters, box);
    const Eigen::VectorXd trial = best.parameters + step;
    const Eigen::VectorXd at_trial = mean(trial);
    ++best.evaluations;
    const double size = step.cwiseQuotient(box.width()).cwiseAbs().maxCoeff();
    if (deviance(readings, at_trial, best.sigma) > best.deviance * (1 + 1e-13) + 1e-12 && size > enough) {
      damping = std::max(10 * damping, 1e-3);
      if (damping > 1e12) break;
      continue;
    }
    best.parameters = trial;
    at_best = at_trial;
    const double sigma = std::max(next_sigma(readings, at_best, best.sigma), least_sigma);
    best.converged = size <= enough && std::abs(sigma - best.sigma) <= 1e-10 * sigma;
    best.sigma = sigma;
    damping = damping < 1e-6 ? 0 : damping / 10;
  }
  best.deviance = deviance(readings, at_best, best.sigma);
  best.at_bound = bounds_met(best.parameters, box);
  return best;
}

}  // namespace muster::diagnosis
