#include "diagnosis/inference/select/gain_by_row.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/thresholds.hpp"

namespace muster::inference {
namespace {

// Rows, the one that won most first.
std::vector<Index> by_gain(const Eigen::VectorXd& won) {
  std::vector<Index> rows(static_cast<std::size_t>(won.size()));
  std::iota(rows.begin(), rows.end(), 0);
  std::sort(rows.begin(), rows.end(), [&](Index a, Index b) { return won[a] > won[b]; });
  return rows;
}

// True if fewer than five readings carry half of the gain. `rows`: by gain.
bool from_few(const ModelState& state, const Eigen::VectorXd& won, const std::vector<Index>& rows) {
  double sum = 0, readings = 0;
  for (const Index row : rows) {
    if (sum >= won.sum() / 2) break;
    sum += won[row];
    readings += state.rows().count()[row];
  }
  return readings < thresholds::few_readings;
}

// Gain without these rows.
double gain_without(const ModelState& state, const WhitenedModel& model, const noise::Covariance& covariance,
                    const Eigen::MatrixXd& columns, const std::vector<Index>& rows) {
  return state.whitened_model(noise::hstack(model.design, state.units_of(rows)), covariance).gain(columns);
}

}  // namespace

GainByRow gain_by_row(const WhitenedModel& model, const Eigen::MatrixXd& columns) {
  const auto added = noise::basis_of(model.at.basis.rest(model.whitener(columns)));
  const Eigen::VectorXd &r = model.at.residual,
                        tame = r.cwiseMax(-thresholds::usual_errors).cwiseMin(thresholds::usual_errors);
  const Eigen::VectorXd along = added.q.transpose() * r, left = r - added.q * along;
  return {r.array().square() - left.array().square(), (added.q.transpose() * tame).squaredNorm() / along.squaredNorm()};
}

double share_of_others(const ModelState& state, const Eigen::VectorXd& won) {
  std::map<int, double> by_anchor;
  for (Index i = 0; i < won.size(); ++i) by_anchor[state.field().sites().group[static_cast<std::size_t>(i)]] += won[i];
  double most = 0;
  for (const auto& [anchor, sum] : by_anchor) most = std::max(most, sum);
  return 1 - most / won.sum();
}

bool of_outlier(const ModelState& state, const ScoredCandidate& lead, const WhitenedModel& model,
                const noise::Covariance& covariance, const GainByRow& gains_by_row) {
  std::vector<Index> rows = by_gain(gains_by_row.won);
  if (!from_few(state, gains_by_row.won, rows)) return false;
  const auto is_chance = [&](double gain) {
    return state.log_p(lead.candidate(), gain, lead.columns.cols(), true) > state.threshold();
  };
  if (gains_by_row.tame_share >= thresholds::tame_share && !is_chance(gains_by_row.tame_share * gains_by_row.won.sum()))
    return false;
  rows.resize(std::min(rows.size(), thresholds::rows_of_an_outlier));
  return is_chance(gain_without(state, model, covariance, lead.columns, rows));
}

std::vector<Index> outliers_among(const ModelState& state, const WhitenedModel& model, const GainByRow& gains_by_row) {
  std::set<Index> rows;
  for (const Eigen::VectorXd& large : {gains_by_row.won, Eigen::VectorXd(model.at.residual.cwiseAbs())}) {
    std::vector<Index> most = by_gain(large);
    most.resize(std::min(most.size(), thresholds::rows_of_an_outlier));
    rows.insert(most.begin(), most.end());
  }
  std::vector<Index> result;
  double readings = 0;
  for (WhitenedModel without = model;;) {
    double most = thresholds::outlying_errors * thresholds::outlying_errors;
    auto farthest = rows.end();
    for (auto row = rows.begin(); row != rows.end(); ++row) {
      const double off = without.gain(state.units_of({*row}));
      if (off <= most) continue;
      most = off;
      farthest = row;
    }
    if (farthest == rows.end()) return result;
    readings += state.rows().count()[*farthest];
    if (readings >= thresholds::few_readings) return result;
    result.push_back(*farthest);
    rows.erase(farthest);
    without = state.whitened_model(noise::hstack(model.design, state.units_of(result)), model.whitener.covariance());
  }
}

}  // namespace muster::inference
