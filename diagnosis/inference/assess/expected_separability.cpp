#include "diagnosis/inference/assess/expected_separability.hpp"

#include <algorithm>
#include <stdexcept>

#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/score/marginal_p_value.hpp"

namespace muster::inference {
namespace {

const Candidate& planned(const Plan& plan, const std::string& id) {
  for (const Candidate& c : plan.candidates) {
    if (c.id == id) return c;
  }
  throw std::invalid_argument(plan.say + ": the plan has no candidate " + id);
}

const Entry& entry_of(const ModelState& state, const Plan& plan, const std::string& id) {
  for (const Entry& e : state.entries()) {
    if (e.candidate->id == id) return e;
  }
  throw std::invalid_argument(plan.say + ": the problem has no candidate " + id);
}

}  // namespace

bool Plan::knows(const std::string& id) const {
  return std::any_of(candidates.begin(), candidates.end(), [&](const Candidate& c) { return c.id == id; });
}

ExpectedSeparability::ExpectedSeparability(const ModelState& state, const Plan& plan)
    : state_(state),
      plan_(plan),
      rows_(plan.layout->rows()),
      field_(state.field().sites().with(plan.layout->sites(rows_)), {.seed = state.options().seed}),
      whitener_(field_, state.fit.covariance) {}

Eigen::MatrixXd ExpectedSeparability::whitened(const Eigen::MatrixXd& here, const Eigen::MatrixXd& at_readings) const {
  Eigen::MatrixXd both(field_.size(), here.cols());
  both << here, rows_.mean(at_readings);
  return whitener_(both);
}

std::vector<double> ExpectedSeparability::separability(const Term& term,
                                                       const std::vector<std::string>& alternatives) const {
  Eigen::MatrixXd here = state_.base(), there = plan_.base;
  for (const Term& other : state_.terms) {
    if (&other == &term || other.smooth()) continue;  // a smooth predicts nothing for readings elsewhere
    here = noise::hstack(here, other.columns);
    there = noise::hstack(there, planned(plan_, other.candidate->id).design.columns(other.theta));
  }
  const auto basis = noise::basis_of(whitened(here, there));
  const Eigen::MatrixXd design = noise::hstack(state_.design_without(term), term.columns);
  const Eigen::VectorXd coefficients =
      state_.whitened_model(design).coefficients(design.cols()).tail(term.columns.cols());
  const Eigen::VectorXd effect = basis.rest(whitened(
      term.columns * coefficients, planned(plan_, term.candidate->id).design.columns(term.theta) * coefficients));
  std::vector<double> result;
  for (const std::string& alternative : alternatives) {
    const Candidate& other = planned(plan_, alternative);
    const Entry& entry = entry_of(state_, plan_, alternative);
    double& least = result.emplace_back(effect.squaredNorm());
    for (Index k = 0; k < entry.count(); ++k) {
      const Eigen::VectorXd& theta = entry.candidate->design.grid[static_cast<std::size_t>(k)];
      const auto of_rival = noise::basis_of(basis.rest(whitened(entry.atom(k), other.design.columns(theta))));
      least = std::min(least, residual_energy(effect, (of_rival.q.transpose() * effect).squaredNorm()));
    }
  }
  return result;
}

}  // namespace muster::inference
