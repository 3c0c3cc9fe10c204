#include "diagnosis/inference/assess/held_out_gain.hpp"

#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/score/marginal_p_value.hpp"
#include "diagnosis/inference/thresholds.hpp"

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

Folds folds_of(const ModelState& state, const std::vector<int>& parts) {
  return {state.field().sites(), parts, state.rows().row_of(), state.fit.covariance, state.options().seed};
}

std::vector<int> blocks_of(const ModelState& state) {
  return inference::blocks_of(state.field().sites(), state.fit.covariance);
}

void add_gains_of_blocks(const ModelState& state, Result& result) {
  const Folds folds = folds_of(state, blocks_of(state));
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
  const Folds folds = folds_of(state, parts);
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

// The worst of the terms that `refuted` says are so, by what their removal gains in mean squared error.
template <class Concerns, class Refuted>
std::optional<std::size_t> worst_of(const ModelState& state, const Folds& folds, const Concerns& concerns,
                                    const Refuted& refuted) {
  const Errors errors(state, folds);
  const Eigen::VectorXd full = errors.first(state.terms.size());
  const bool all = refuted(errors.first(0), full);
  std::optional<std::size_t> worst;
  double least = 0;
  for (std::size_t one = 0; one < state.terms.size(); ++one) {
    if (!concerns(state.terms[one])) continue;
    const Eigen::VectorXd without = errors.without(one);
    const double gain = (without - full).mean();
    if (gain >= least || !(all || refuted(without, full))) continue;
    least = gain;
    worst = one;
  }
  return worst;
}

}  // namespace

std::optional<std::size_t> most_refuted(const ModelState& state) {
  if (state.terms.empty()) return {};
  const Folds blocks = folds_of(state, blocks_of(state));
  if (blocks.blocks() >= thresholds::fewest_refuting_blocks) {
    const auto refuted = [&](const Eigen::VectorXd& before, const Eigen::VectorXd& after) {
      const HeldOutGain gain = blocks.compared(before, after);
      // A term may fail in few blocks and badly: the interval then includes 0.
      return gain.upper95 < 0 || gain.gain < -thresholds::refuting_growth * before.mean();
    };
    if (const auto worst = worst_of(
            state, blocks, [](const Term&) { return true; }, refuted))
      return worst;
  }
  // A name in time says what happens at other times: it must not be worse there than no name.
  const auto in_time = [](const Term& term) { return !term.smooth() && term.candidate->role.time_like; };
  if (std::none_of(state.terms.begin(), state.terms.end(), in_time)) return {};
  const std::vector<int> parts = state.problem().layout->parts_of_time(state.rows());
  if (parts.empty()) return {};
  const Folds times = folds_of(state, parts);
  const auto worse = [](const Eigen::VectorXd& before, const Eigen::VectorXd& after) {
    return after.mean() > before.mean();
  };
  return times.possible() ? worst_of(state, times, in_time, worse) : std::nullopt;
}

void add_held_out_gains(const ModelState& state, Result& result) {
  add_gains_of_blocks(state, result);
  for (const Grouping& grouping : state.problem().layout->groupings(state.rows(), state.field().sites()))
    add_gains_of_groups(state, grouping, result);
}

}  // namespace muster::inference
