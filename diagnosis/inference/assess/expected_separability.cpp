#include "diagnosis/inference/assess/expected_separability.hpp"

#include <algorithm>
#include <stdexcept>

#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/score/candidate_scores.hpp"

namespace muster::inference {
namespace {

constexpr Index at_once = 64;  // atoms: the neighbours of a row are read once for all of them

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

double ExpectedSeparability::most_explained(const Entry& entry, const Candidate& planned, const noise::Basis& basis,
                                            const Eigen::VectorXd& effect) const {
  Candidate plain;  // either sign of the rival
  plain.design.width = entry.candidate->design.width;
  const Index width = plain.design.width;
  double most = 0;
  for (Index first = 0; first < entry.count(); first += at_once) {
    const Index count = std::min(at_once, entry.count() - first);
    Eigen::MatrixXd there(plan_.layout->size(), count * width);
    for (Index k = 0; k < count; ++k)
      there.middleCols(k * width, width) =
          planned.design.columns(entry.candidate->design.grid[static_cast<std::size_t>(first + k)]);
    noise::Sheet both(field_.size(), count * width);
    both << entry.atoms->middleCols(first * width, count * width), rows_.mean(there).cast<float>();
    noise::Sheet atoms = whitener_.sheet(both);
    basis.take_out_of(atoms);
    most = std::max(most, gains(plain, {std::move(atoms), width}, effect).maxCoeff());
  }
  return most;
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
    result.push_back(residual_energy(effect, most_explained(entry, other, basis, effect)));
  }
  return result;
}

}  // namespace muster::inference
