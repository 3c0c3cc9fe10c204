#include "diagnosis/search/refine.hpp"

#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>

namespace muster::search {
namespace {

// The free entries of theta, as NLopt sees them; what a candidate throws waits until NLopt has returned.
struct Climb {
  const std::function<double(const Eigen::VectorXd&)>& value;
  std::vector<Index> free;
  Eigen::VectorXd best;
  double highest;
  std::exception_ptr thrown = nullptr;
  nlopt_opt optimiser = nullptr;

  static double step(unsigned, const double* x, double*, void* data) {
    Climb& self = *static_cast<Climb*>(data);
    Eigen::VectorXd theta = self.best;
    for (std::size_t k = 0; k < self.free.size(); ++k) theta[self.free[k]] = x[k];
    try {
      const double value = self.value(theta);
      if (value > self.highest) {
        self.highest = value;
        self.best = theta;
      }
      return value;
    } catch (...) {
      self.thrown = std::current_exception();
      nlopt_force_stop(self.optimiser);
      return 0;
    }
  }
};

}  // namespace

std::pair<Eigen::VectorXd, double> climbed(const Candidate& candidate, const Eigen::VectorXd& start, int evaluations,
                                           const std::function<double(const Eigen::VectorXd&)>& value) {
  Climb climb{value, {}, start, value(start)};
  for (Index k = 0; k < candidate.step.size(); ++k) {
    if (candidate.step[k] != 0) climb.free.push_back(k);
  }
  if (climb.free.empty()) return {climb.best, climb.highest};
  std::vector<double> x, low, high, step;
  for (const Index k : climb.free) {
    low.push_back(candidate.lower[k]);
    high.push_back(candidate.upper[k]);
    x.push_back(std::min(std::max(start[k], candidate.lower[k]), candidate.upper[k]));
    step.push_back(candidate.step[k]);
  }
  const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> optimiser(
      nlopt_create(NLOPT_LN_NELDERMEAD, static_cast<unsigned>(x.size())), nlopt_destroy);
  climb.optimiser = optimiser.get();
  nlopt_set_max_objective(climb.optimiser, Climb::step, &climb);
  nlopt_set_lower_bounds(climb.optimiser, low.data());
  nlopt_set_upper_bounds(climb.optimiser, high.data());
  nlopt_set_initial_step(climb.optimiser, step.data());
  nlopt_set_maxeval(climb.optimiser, evaluations);
  std::vector<double> close;  // walls give plateaus: a stop by value would come too early
  for (const double s : step) close.push_back(std::abs(s) / 20);
  nlopt_set_xtol_abs(climb.optimiser, close.data());
  double reached = 0;
  nlopt_optimize(climb.optimiser, x.data(), &reached);
  if (climb.thrown) std::rethrow_exception(climb.thrown);
  return {climb.best, climb.highest};
}

}  // namespace muster::search
