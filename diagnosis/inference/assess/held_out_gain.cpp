#include "diagnosis/inference/assess/held_out_gain.hpp"

#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/score/marginal_p_value.hpp"

namespace muster::inference {
namespace {

// Cross-validation errors of the base model with some of the terms.
class Errors {
 public:
  Errors(const ModelState& state, const Folds& folds) : state_(state), folds_(folds) {
    for (const Term& term : state.terms) at_readings_.push_back(term.candidate->design.columns(term.theta));
  }

  template <class Has>
  Eigen::VectorXd with(const Has& has) const {
    Sample rows{state_.y(), state_.base()}, readings{state_.measured(), state_.problem().base};
    for (std::size_t k = 0; k < at_readings_.size(); ++k) {
      if (!has(k)) continue;
      rows.design = noise::hstack(rows.design, state_.terms[k].columns);
      readings.design = noise::hstack(readings.design, at_readings_[k]);
    }
    return folds_.squared_errors(rows, readings);
  }
  Eigen::VectorXd without(std::size_t one) const {
    return with([=](std::size_t k) { return k != one; });
  }
  Eigen::VectorXd first(std::size_t many) const {
    return with([=](std::size_t k) { return k < many; });
  }

 private:
  const ModelState& state_;
  const Folds& folds_;
  std::vector<Eigen::MatrixXd> at_readings_;
};

Folds folds_of(const ModelState& state, const Result& result, const std::vector<int>& parts) {
  return {state.field().sites(), parts, state.rows().row_of(), result.noise.covariance, state.options().seed};
}

void add_gains_of_blocks(const ModelState& state, Result& result) {
  const Folds folds = folds_of(state, result, blocks_of(state.field().sites(), result.noise.covariance));
  if (!folds.possible()) return;
  const Errors errors(state, folds);
  const Eigen::VectorXd base = errors.first(0);
  Eigen::VectorXd full = base;
  result.stairs.push_back(stair_of(folds.unseen(base, base)));
  for (std::size_t many = 1; many <= state.terms.size(); ++many) {
    full = errors.first(many);
    result.stairs.push_back(stair_of(folds.unseen(full, full)));
  }
  result.unseen = folds.unseen(base, full);
  result.held_out = compared(*result.unseen);
  for (std::size_t one = 0; one < state.terms.size(); ++one) {
    result.findings[one].unseen_without = errors.without(one);
    result.findings[one].held_out = folds.compared(result.findings[one].unseen_without, full);
  }
}

// True if some column of the term is non-zero in several parts: the others hold no information on one part alone.
bool concerns_several(const Term& term, const std::vector<int>& parts) {
  for (Index j = 0; j < term.columns.cols(); ++j) {
    int first = -1;
    for (Index i = 0; i < term.columns.rows(); ++i) {
      const int part = parts[static_cast<std::size_t>(i)];
      if (term.columns(i, j) == 0 || part == first) continue;
      if (first >= 0) return true;
      first = part;
    }
  }
  return false;
}

void add_gains_of_groups(const ModelState& state, const Grouping& grouping, Result& result) {
  const std::vector<int>& parts = grouping.of_row;
  const Folds folds = folds_of(state, result, parts);
  if (!folds.possible()) return;
  const Errors errors(state, folds);
  const auto elsewhere = [&](const Eigen::VectorXd& before, const Eigen::VectorXd& after) {
    return Elsewhere{grouping.name, folds.compared(before, after)};
  };
  const Eigen::VectorXd full = errors.first(state.terms.size());
  result.elsewhere.push_back(elsewhere(errors.first(0), full));
  for (std::size_t one = 0; one < state.terms.size(); ++one) {
    if (concerns_several(state.terms[one], parts))
      result.findings[one].elsewhere.push_back(elsewhere(errors.without(one), full));
  }
}

}  // namespace

void add_held_out_gains(const ModelState& state, Result& result) {
  add_gains_of_blocks(state, result);
  for (const Grouping& grouping : state.problem().layout->groupings(state.rows(), state.field().sites()))
    add_gains_of_groups(state, grouping, result);
}

}  // namespace muster::inference
