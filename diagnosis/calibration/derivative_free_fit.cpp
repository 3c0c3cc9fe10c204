#include <nlopt.h>

#include <cmath>
#include <memory>

#include "diagnosis/calibration/least_squares.hpp"

namespace muster::diagnosis {
namespace {

// Variables of the search: parameters relative to `centre`, scaled by the box; with censored rows also log sigma.
struct Task {
  const Readings& readings;
  const Mean& mean;
  const Box& box;
  Eigen::VectorXd centre, scale;
  double log_sigma = 0;
  Eigen::VectorXd reference;  // residuals at the centre
  int evaluations = 0;

  bool fits_sigma() const { return !readings.censored.empty(); }
  std::size_t size() const { return static_cast<std::size_t>(centre.size()) + (fits_sigma() ? 1 : 0); }
  Eigen::VectorXd parameters(const double* u) const {
    return box.inside(centre + scale.cwiseProduct(Eigen::Map<const Eigen::VectorXd>(u, centre.size())));
  }
  double sigma(const double* u) const { return std::exp(log_sigma + (fits_sigma() ? 0.1 * u[centre.size()] : 0)); }

  // Sum of squares relative to the centre's, row by row: near the minimum the sums agree to 12 digits and more.
  double operator()(const double* u) {
    ++evaluations;
    const Eigen::VectorXd at = mean(parameters(u));
    if (fits_sigma()) return deviance(readings, at, sigma(u));
    const Eigen::VectorXd r = residuals(readings, at, 1);
    return (r - reference).dot(r + reference);
  }
};

double evaluate(unsigned, const double* u, double*, void* task) { return (*static_cast<Task*>(task))(u); }

// Searches once from the centre with steps of `reach` and moves the centre to the best point. Returns the distance
// moved, in steps.
double search(Task& task, double reach) {
  const Eigen::VectorXd at = task.mean(task.centre);
  task.reference = residuals(task.readings, at, std::exp(task.log_sigma));
  const auto n = static_cast<Eigen::Index>(task.size());
  const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> search(
      nlopt_create(NLOPT_LN_BOBYQA, static_cast<unsigned>(n)), nlopt_destroy);
  Eigen::VectorXd low = Eigen::VectorXd::Constant(n, -100), high = -low, u = Eigen::VectorXd::Zero(n);
  low.head(task.centre.size()) = (task.box.lower - task.centre).cwiseQuotient(task.scale);
  high.head(task.centre.size()) = (task.box.upper - task.centre).cwiseQuotient(task.scale);
  nlopt_set_lower_bounds(search.get(), low.data());
  nlopt_set_upper_bounds(search.get(), high.data());
  nlopt_set_min_objective(search.get(), evaluate, &task);
  nlopt_set_initial_step1(search.get(), reach);
  nlopt_set_xtol_abs1(search.get(), 1e-10);
  nlopt_set_maxeval(search.get(), 400 * static_cast<int>(n));
  double least = 0;
  nlopt_optimize(search.get(), u.data(), &least);  // rounding errors may stop it, at its best attainable precision
  const Eigen::VectorXd found = task.parameters(u.data());
  task.log_sigma = std::log(task.sigma(u.data()));
  task.centre = found;
  return u.cwiseAbs().maxCoeff();
}

}  // namespace

Minimum derivative_free_fit(const Readings& readings, const Mean& mean, const Eigen::VectorXd& start, const Box& box) {
  constexpr int most = 12;
  Task task{.readings = readings,
            .mean = mean,
            .box = box,
            .centre = box.inside(start),
            .scale = 0.05 * box.width(),
            .reference = {}};
  double sigma = 10;
  for (int i = 0; i < 3; ++i) sigma = std::max(next_sigma(readings, mean(task.centre), sigma), 1e-9);
  task.log_sigma = std::log(sigma);
  Minimum best;
  double reach = 1;
  for (int i = 0; i < most && !best.converged; ++i) {
    best.converged = search(task, reach) < 1e-8;
    reach = std::max(reach / 30, 1e-5);
  }
  best.parameters = task.centre;
  const Eigen::VectorXd at = mean(best.parameters);
  best.sigma = task.fits_sigma() ? std::exp(task.log_sigma) : next_sigma(readings, at, 1);
  best.deviance = deviance(readings, at, best.sigma);
  best.evaluations = task.evaluations;
  for (Eigen::Index j = 0; j < best.parameters.size(); ++j)
    best.at_bound.push_back(std::min(best.parameters[j] - box.lower[j], box.upper[j] - best.parameters[j]) <=
                            1e-9 * box.width()[j]);
  return best;
}

}  // namespace muster::diagnosis
