#include "diagnosis/inference/assess/held_out_gain.hpp"

#include <algorithm>

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
    Sample rows{state_.y(), state_.base()};
    Sample readings{state_.problem().measured, state_.problem().base, &state_.problem().bounds};
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

std::vector<int> blocks_of(const ModelState& state) {
  return inference::blocks_of(state.field().sites(), state.fit.covariance);
}

void add_gains_of_blocks(const ModelState& state, KeptFolds& kept, Result& result) {
  const Folds& folds = kept.of(state, blocks_of(state));
  if (!folds.possible()) return;
  const Errors errors(state, folds);
  const Eigen::VectorXd base = errors.first(0);
  Eigen::VectorXd full = base;
  result.stairs.push_back(stair_of(folds.unseen(base, base)));
  for (std::size_t many = 1; many <= state.terms.size(); ++many) {
    full = errors.first(many);
    result.stairs.push_back(stair_of(folds.unseen(full, full)));
    const Term& term = state.terms[many - 1];
    result.stairs.back().with = term.smooth() ? "~" + term.candidate->own() : term.id();
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

void add_gains_of_groups(const ModelState& state, const Grouping& grouping, KeptFolds& kept, Result& result) {
  const std::vector<int>& parts = grouping.of_row;
  const Folds& folds = kept.of(state, parts);
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

// The term whose removal lowers the error most, of those that `refuted` by it; nothing if there is none.
template <class Without, class Refuted>
std::optional<std::size_t> worst_of(const ModelState& state, const Eigen::VectorXd& full, const Without& without,
                                    const Refuted& refuted) {
  std::optional<std::size_t> worst;
  double least = 0;
  for (std::size_t one = 0; one < state.terms.size(); ++one) {
    if (!refuted(one)) continue;
    const double gain = (without(one) - full).mean();
    if (gain >= least) continue;
    least = gain;
    worst = one;
  }
  return worst;
}

// Squared whitened errors of rows whose part is left out of the fit: of rows given their neighbours, so that a field
// over places does not drown what happens in time, or in one direction.
Eigen::VectorXd white_errors(const noise::Whitener& whitener, const Eigen::MatrixXd& design, const Eigen::VectorXd& y,
                             const std::vector<int>& parts) {
  const Eigen::MatrixXd x = whitener(design);
  const Eigen::VectorXd z = whitener(y);
  Eigen::VectorXd result(z.size());
  const int last = *std::max_element(parts.begin(), parts.end());
  for (int part = 0; part <= last; ++part) {
    std::vector<Index> in, out;
    for (Index i = 0; i < z.size(); ++i) (parts[static_cast<std::size_t>(i)] == part ? out : in).push_back(i);
    const auto basis = noise::basis_of(x(in, Eigen::all));
    const Eigen::VectorXd coefficients = basis.coefficients(basis.q.transpose() * z(in), x.cols());
    result(out) = (z(out) - x(out, Eigen::all) * coefficients).cwiseAbs2();
  }
  return result;
}

// True if the other parts know the term's size, too: what lies in one of them alone is not foretold by the rest.
bool known_elsewhere(const Term& term, const std::vector<int>& parts) {
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(*std::max_element(parts.begin(), parts.end()) + 1);
  for (Index i = 0; i < term.columns.rows(); ++i)
    squares[parts[static_cast<std::size_t>(i)]] += term.columns.row(i).squaredNorm();
  return squares.maxCoeff() < thresholds::most_in_one_part * squares.sum();
}

std::optional<std::size_t> refuted_at_places(const ModelState& state, KeptFolds& kept) {
  const std::vector<int> blocks = blocks_of(state);
  const Folds& folds = kept.of(state, blocks);
  if (!folds.possible()) return {};
  const bool many = folds.blocks() >= thresholds::fewest_refuting_blocks;
  const Errors errors(state, folds);
  const Eigen::VectorXd full = errors.first(state.terms.size());
  const noise::Whitener whitener(state.field(), state.fit.covariance);
  const Eigen::VectorXd white = white_errors(whitener, state.design(), state.y(), blocks);
  // A small offset moves levels by less than the field does: it may raise the error where the field happens to lie on
  // its side. Given their neighbours the readings still tell.
  const auto borne_out = [&](std::size_t one) {
    const Term& term = state.terms[one];
    const Eigen::VectorXd without = white_errors(whitener, state.design_without(term), state.y(), blocks);
    return (without - white).sum() > thresholds::borne_out_share * term.gain;
  };
  const auto grows = [&](std::size_t one, const HeldOutGain& gain, const Eigen::VectorXd& before) {
    const bool sure = state.terms[one].gain > thresholds::sure_of_growth || borne_out(one);
    return gain.gain < -(sure ? thresholds::refuting_growth_of_sure : thresholds::refuting_growth) * before.mean();
  };
  // A term may fail in few blocks and badly: the interval then includes 0.
  const Eigen::VectorXd base = errors.first(0);
  const HeldOutGain all = folds.compared(base, full);
  const auto without = [&](std::size_t one) { return errors.without(one); };
  return worst_of(state, full, without, [&](std::size_t one) {
    if (!known_elsewhere(state.terms[one], blocks)) return false;
    const Eigen::VectorXd before = without(one);
    const HeldOutGain gain = folds.compared(before, full);
    if (grows(one, gain, before) || grows(one, all, base)) return true;
    return many && (all.upper95 < 0 || gain.upper95 < 0) && !borne_out(one);
  });
}

// A term that makes predictions at left-out groups wild: a few causes with numbers enough fit each of ten sites, and a
// group left out tells that none of them is there.
std::optional<std::size_t> refuted_at_groups(const ModelState& state) {
  for (const Grouping& grouping : state.problem().layout->groupings(state.rows(), state.field().sites())) {
    KeptFolds own;
    const Folds& folds = own.of(state, grouping.of_row);
    if (!folds.possible()) continue;
    const Errors errors(state, folds);
    const Eigen::VectorXd full = errors.first(state.terms.size()), base = errors.first(0);
    if (full.mean() < (1 + thresholds::refuting_growth_of_sure) * base.mean()) continue;
    const auto worst = worst_of(
        state, full, [&](std::size_t one) { return errors.without(one); },
        [&](std::size_t one) { return concerns_several(state.terms[one], grouping.of_row); });
    if (worst) return worst;
  }
  return {};
}

// A name in time says what happens at other times: it must not be worse there than no name.
std::optional<std::size_t> refuted_at_times(const ModelState& state) {
  const auto in_time = [](const Term& term) { return !term.smooth() && term.candidate->role.time_like; };
  if (std::none_of(state.terms.begin(), state.terms.end(), in_time)) return {};
  const std::vector<int> parts = state.problem().layout->parts_of_time(state.rows());
  if (parts.empty()) return {};
  const noise::Whitener whitener(state.field(), state.fit.covariance);
  const auto without = [&](std::size_t one) {
    return white_errors(whitener, state.design_without(state.terms[one]), state.y(), parts);
  };
  return worst_of(state, white_errors(whitener, state.design(), state.y(), parts), without,
                  [&](std::size_t one) { return in_time(state.terms[one]); });
}

}  // namespace

const Folds& KeptFolds::of(const ModelState& state, const std::vector<int>& parts) {
  const noise::Covariance& at = state.fit.covariance;
  if (folds_ && parts == parts_ && state.rows().row_of() == row_of_) {
    if (at == covariance_) return *folds_;
    folds_.emplace(Folds(*folds_, at));
  } else {
    parts_ = parts;
    row_of_ = state.rows().row_of();
    folds_.emplace(state.field().sites(), parts, row_of_, at, state.options().seed);
  }
  covariance_ = at;
  return *folds_;
}

std::optional<std::size_t> most_refuted(const ModelState& state, KeptFolds& kept) {
  if (state.terms.empty()) return {};
  if (const auto at_places = refuted_at_places(state, kept)) return at_places;
  if (const auto at_groups = refuted_at_groups(state)) return at_groups;
  return refuted_at_times(state);
}

void add_held_out_gains(const ModelState& state, KeptFolds& kept, Result& result) {
  add_gains_of_blocks(state, kept, result);
  for (const Grouping& grouping : state.problem().layout->groupings(state.rows(), state.field().sites()))
    add_gains_of_groups(state, grouping, kept, result);
}

}  // namespace muster::inference
