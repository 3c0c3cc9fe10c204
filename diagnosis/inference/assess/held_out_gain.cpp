#include "diagnosis/inference/assess/held_out_gain.hpp"

#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/score/marginal_p_value.hpp"

namespace muster::inference {
namespace {

// Errors of the base model and some of the terms beside it.
class Errors {
 public:
  Errors(const Bench& bench, const Folds& folds) : bench_(bench), folds_(folds) {
    for (const Term& term : bench.terms) at_readings_.push_back(term.candidate->columns(term.theta));
  }

  template <class Has>
  Eigen::VectorXd with(const Has& has) const {
    Sample rows{bench_.y(), bench_.base()}, readings{bench_.measured(), bench_.problem().base};
    for (std::size_t k = 0; k < at_readings_.size(); ++k) {
      if (!has(k)) continue;
      rows.design = noise::hstack(rows.design, bench_.terms[k].columns);
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
  const Bench& bench_;
  const Folds& folds_;
  std::vector<Eigen::MatrixXd> at_readings_;
};

Folds folds_of(const Bench& bench, const Result& result, const std::vector<int>& parts) {
  return {bench.field().sites(), parts, bench.rows().row_of(), result.noise.covariance, bench.options().seed};
}

void hold_out_blocks(const Bench& bench, Result& result) {
  const Folds folds = folds_of(bench, result, blocks_of(bench.field().sites(), result.noise.covariance));
  if (!folds.possible()) return;
  const Errors errors(bench, folds);
  const Eigen::VectorXd base = errors.first(0);
  Eigen::VectorXd full = base;
  result.stairs.push_back(stair_of(folds.unseen(base, base)));
  for (std::size_t many = 1; many <= bench.terms.size(); ++many) {
    full = errors.first(many);
    result.stairs.push_back(stair_of(folds.unseen(full, full)));
  }
  result.unseen = folds.unseen(base, full);
  result.held_out = compared(*result.unseen);
  for (std::size_t one = 0; one < bench.terms.size(); ++one) {
    result.findings[one].unseen_without = errors.without(one);
    result.findings[one].held_out = folds.compared(result.findings[one].unseen_without, full);
  }
}

// Whether a column of the term is about more than one part: of one alone the others tell nothing.
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

void hold_out_parts(const Bench& bench, Part part, const std::vector<int>& parts, Result& result) {
  const Folds folds = folds_of(bench, result, parts);
  if (!folds.possible()) return;
  const Errors errors(bench, folds);
  const auto elsewhere = [&](const Eigen::VectorXd& before, const Eigen::VectorXd& after) {
    return Elsewhere{part, folds.compared(before, after)};
  };
  const Eigen::VectorXd full = errors.first(bench.terms.size());
  result.elsewhere.push_back(elsewhere(errors.first(0), full));
  for (std::size_t one = 0; one < bench.terms.size(); ++one) {
    if (concerns_several(bench.terms[one], parts))
      result.findings[one].elsewhere.push_back(elsewhere(errors.without(one), full));
  }
}

// The run of each row.
std::vector<int> runs_of(const Bench& bench) {
  std::vector<int> result;
  for (Index i = 0; i < bench.rows().size(); ++i)
    result.push_back(bench.problem().run[static_cast<std::size_t>(bench.rows().example(i))]);
  return result;
}

}  // namespace

void hold_out(const Bench& bench, Result& result) {
  hold_out_blocks(bench, result);
  hold_out_parts(bench, Part::radio, radios_of(bench.rows(), bench.field().sites(), bench.problem().readings), result);
  if (!bench.problem().run.empty()) hold_out_parts(bench, Part::run, runs_of(bench), result);
}

}  // namespace muster::inference
