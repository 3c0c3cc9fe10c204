#include "diagnosis/inference/score/refine.hpp"

#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>

#include "muster/random.hpp"

namespace muster::inference {
namespace {

// Free entries of theta, for NLopt; exceptions of a candidate are rethrown after NLopt has returned.
struct Climb {
  const Value& value;
  std::vector<Index> free;
  Eigen::VectorXd best;
  double highest;
  std::exception_ptr thrown = nullptr;
  nlopt_opt optimiser = nullptr;

  static double step(unsigned, const double* x, double*, void* data) {
    Climb& self = *static_cast<Climb*>(data);
    Eigen::VectorXd theta = self.best;
    for (std::size_t k = 0; k < self.free.size(); ++k) theta[self.free[k]] = x[k];
    if (theta == self.best) return self.highest;  // as the start is, with which NLopt begins
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

Optimum by_simplex(const Candidate& candidate, const Eigen::VectorXd& start, int evaluations, const Value& value) {
  Climb climb{value, {}, start, value(start)};
  for (Index k = 0; k < candidate.refinement.step.size(); ++k) {
    if (candidate.refinement.step[k] != 0) climb.free.push_back(k);
  }
  if (climb.free.empty()) return {climb.best, climb.highest};
  std::vector<double> x, low, high, step;
  for (const Index k : climb.free) {
    low.push_back(candidate.refinement.lower[k]);
    high.push_back(candidate.refinement.upper[k]);
    x.push_back(std::min(std::max(start[k], candidate.refinement.lower[k]), candidate.refinement.upper[k]));
    step.push_back(candidate.refinement.step[k]);
  }
  const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> optimiser(
      nlopt_create(NLOPT_LN_NELDERMEAD, static_cast<unsigned>(x.size())), nlopt_destroy);
  climb.optimiser = optimiser.get();
  nlopt_set_max_objective(climb.optimiser, Climb::step, &climb);
  nlopt_set_lower_bounds(climb.optimiser, low.data());
  nlopt_set_upper_bounds(climb.optimiser, high.data());
  nlopt_set_initial_step(climb.optimiser, step.data());
  nlopt_set_maxeval(climb.optimiser, evaluations);
  std::vector<double> close;  // walls cause plateaus: a stop by value would come too early
  for (const double s : step) close.push_back(std::abs(s) / 20);
  nlopt_set_xtol_abs(climb.optimiser, close.data());
  double reached = 0;
  nlopt_optimize(climb.optimiser, x.data(), &reached);
  if (climb.thrown) std::rethrow_exception(climb.thrown);
  return {climb.best, climb.highest};
}

// A random step along one move, or along a mixture of all.
Eigen::VectorXd stride(const Eigen::MatrixXd& moves, const Stream& stream, uint64_t k, double length) {
  const auto among = static_cast<double>(moves.cols());
  if (stream.uniform(k, 0) < 0.5) {
    const auto one = static_cast<Index>(stream.uniform(k, 1) * among);
    return moves.col(one) * (length * stream.normal(k, 2));
  }
  Eigen::VectorXd mix(moves.cols());
  for (Index j = 0; j < mix.size(); ++j) mix[j] = stream.normal(k, 3 + static_cast<uint64_t>(j));
  return moves * mix * (length / std::sqrt(among));
}

Optimum by_strides(const Candidate& candidate, Optimum top, uint64_t salt, int evaluations, double longest,
                   const Value& value) {
  constexpr double shortest = 0.04, longer = 1.5, shorter = 0.9;
  const Stream stream(combined(key_of("strides"), salt));
  double length = longest;
  for (int k = 0; k < evaluations; ++k) {
    Eigen::VectorXd theta =
        top.first + stride(moves_at(candidate, top.first), stream, static_cast<uint64_t>(k), length);
    theta = theta.cwiseMax(candidate.refinement.lower).cwiseMin(candidate.refinement.upper);
    const double reached = value(theta);
    length *= reached > top.second ? longer : shorter;
    length = length < shortest ? longest : std::min(length, longest);
    if (reached > top.second) top = {std::move(theta), reached};
  }
  return top;
}

// The better half, in which optima within a step of each other are merged.
std::vector<Optimum> better_half(std::vector<Optimum> tops, const Candidate& candidate) {
  std::stable_sort(tops.begin(), tops.end(), [](const Optimum& a, const Optimum& b) { return a.second > b.second; });
  tops.resize((tops.size() + 1) / 2);
  std::vector<Optimum> result;
  for (Optimum& top : tops) {
    const bool known = std::any_of(result.begin(), result.end(), [&](const Optimum& better) {
      return ((better.first - top.first).array().abs() <= candidate.refinement.step.array().abs()).all();
    });
    if (!known) result.push_back(std::move(top));
  }
  return result;
}

}  // namespace

Eigen::MatrixXd moves_at(const Candidate& candidate, const Eigen::VectorXd& theta) {
  if (candidate.refinement.moves) return candidate.refinement.moves(theta);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(theta.size(), (candidate.refinement.step.array() != 0).count());
  for (Index k = 0, j = 0; k < theta.size(); ++k) {
    if (candidate.refinement.step[k] != 0) result(k, j++) = candidate.refinement.step[k];
  }
  return result;
}

Optimum local_search(const Candidate& candidate, const Eigen::VectorXd& start, int evaluations, const Value& value) {
  if (candidate.refinement.starts < 2) return by_simplex(candidate, start, evaluations, value);
  return by_strides(candidate, {start, value(start)}, 0, evaluations, 1, value);
}

Optimum successive_halving(const Candidate& candidate, const std::vector<Eigen::VectorXd>& starts,
                           const std::vector<Value>& laps) {
  std::vector<Optimum> tops;
  for (const Eigen::VectorXd& start : starts) tops.emplace_back(start, 0.0);
  int evaluations = candidate.refinement.evaluations / 3;
  for (std::size_t lap = 0; lap < laps.size(); ++lap) {
    const double longest = lap == 0 ? 2 : 1;
    for (Optimum& top : tops) {
      top.second = laps[lap](top.first);
      top = by_strides(candidate, std::move(top), 1 + lap, evaluations, longest, laps[lap]);
    }
    tops = better_half(std::move(tops), candidate);
    evaluations = std::min(2 * evaluations, 2 * candidate.refinement.evaluations);
  }
  return tops[0];
}

}  // namespace muster::inference
