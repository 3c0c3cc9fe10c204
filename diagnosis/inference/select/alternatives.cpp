#include "diagnosis/inference/select/alternatives.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/score/marginal_p_value.hpp"
#include "diagnosis/inference/score/refine.hpp"
#include "diagnosis/inference/thresholds.hpp"

namespace muster::inference {
namespace {

// The term's fitted effect on rows, in units of a reading.
Eigen::VectorXd effect_of(const ModelState& state, const Term& term) {
  const Eigen::MatrixXd design = noise::hstack(state.design_without(term), term.columns);
  return term.columns * state.whitened_model(design).coefficients(design.cols()).tail(term.columns.cols());
}

// Best theta of the alternative for the whitened effect, and the energy explained there. `by_atom`: that at its grid.
std::pair<Eigen::VectorXd, double> explained_by(const ModelState& state, const WhitenedModel& rest, const Candidate& c,
                                                const Eigen::VectorXd& by_atom, const Eigen::VectorXd& effect) {
  Index at = 0;
  const double best = by_atom.maxCoeff(&at);
  const Eigen::VectorXd& start = c.design.grid[static_cast<std::size_t>(at)];
  if (!c.refinement.any()) return {start, best};
  const auto share = [&](const Eigen::VectorXd& theta, const Eigen::MatrixXd& columns) {
    const double admitted = c.refinement.admitted ? c.refinement.admitted(theta) : 1;
    const auto added = noise::basis_of(rest.at.basis.rest(rest.whitener(columns)));
    return admitted * (added.q.transpose() * effect).squaredNorm();
  };
  const auto exact = [&](const Eigen::VectorXd& theta) { return share(theta, state.columns_of(c, theta)); };
  const int evaluations = std::min(60, c.refinement.evaluations);
  if (!c.design.sketch) return local_search(c, start, evaluations, exact);
  Optimum top = local_search(c, start, evaluations,
                             [&](const Eigen::VectorXd& theta) { return share(theta, state.sketch_of(c, theta)); });
  top.second = exact(top.first);
  return top;
}

// Refines from the best atom, if its evidence suffices, and from the theta that explains the effect, if there is one.
// For a strong effect even the nearest atom may miss much.
ScoredCandidate at_its_best(const ModelState& state, const WhitenedModel& rest, const ScoredCandidate& plain,
                            const Eigen::VectorXd* explaining, double least_evidence) {
  const Candidate& c = plain.candidate();
  if (!c.refinement.any()) return plain;
  ScoredCandidate best = plain.evidence > least_evidence ? refined(state, rest, plain, true) : plain;
  if (!explaining) return best;
  ScoredCandidate other = plain;
  other.theta = *explaining;
  other = refined(state, rest, other, true);
  return other.gain > best.gain ? other : best;
}

// The same cause on other rows, the likeliest first: one of two groups too high equals the other one too low. A world
// row that concerns all readings, and all rows together, are one. `by_atom`: energy of the effect that each atom
// explains.
std::vector<Alternative> of_other_rows(const ModelState& state, const Term& term, const Eigen::VectorXd& by_atom,
                                       const Eigen::VectorXd& effect) {
  const Candidate& own = *term.candidate;
  if (own.kind != Kind::named || own.refinement.any() || own.design.whole) return {};
  const std::string label = own.label_of(term.theta);
  const Eigen::MatrixXd columns = state.columns_of(own, term.theta);
  std::vector<Alternative> result;
  for (std::size_t k = 0; k < own.design.grid.size(); ++k) {
    const double separability = residual_energy(effect, by_atom[static_cast<Index>(k)]);
    if (separability < thresholds::inseparable && own.label_of(own.design.grid[k]) != label &&
        !state.columns_of(own, own.design.grid[k]).isApprox(columns, 1e-9))
      result.push_back({own.id, own.label_of(own.design.grid[k]), own.design.grid[k], 0, separability});
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const Alternative& a, const Alternative& b) { return a.separability < b.separability; });
  if (result.size() > thresholds::most_other_rows) result.resize(thresholds::most_other_rows);
  return result;
}

// Keeps the likeliest of several smooths along one covariate.
void keep_likest(std::vector<Alternative>& alternatives, Alternative alternative) {
  const auto known = std::find_if(alternatives.begin(), alternatives.end(),
                                  [&](const Alternative& r) { return r.id == alternative.id; });
  if (known == alternatives.end())
    alternatives.push_back(std::move(alternative));
  else if (alternative.evidence_gap < known->evidence_gap)
    *known = std::move(alternative);
}

}  // namespace

double residual_energy(const Eigen::VectorXd& effect, double explained) {
  return std::max(0.0, effect.squaredNorm() - explained);
}

bool left_open(const Alternative& alternative) {
  return alternative.evidence_gap < thresholds::open_nats ||
         (alternative.separability < thresholds::inseparable && alternative.by_readings < thresholds::open_nats);
}

double evidence_beside(const ModelState& state, const Eigen::MatrixXd& design, const Candidate& c,
                       const Eigen::MatrixXd& columns) {
  const Eigen::MatrixXd both = noise::hstack(design, columns);
  const noise::Fit fit = state.fitted(both, state.fit.covariance, 4);
  const WhitenedModel rest = state.whitened_model(design, fit.covariance);
  const double by_a_multiple = rest.gain(columns) - gain_of(c, rest, columns);
  return fit.log_likelihood() - by_a_multiple / 2 + state.evidence(c, 0, columns.cols(), c.refinement.any());
}

std::vector<Alternative> alternatives_of(ModelState& state, const Term& term) {
  const WhitenedModel rest = state.whitened_model(state.design_without(term));
  const Eigen::VectorXd effect = rest.at.basis.rest(rest.whitener(effect_of(state, term)));
  const Candidate& own = *term.candidate;
  const double evidence = state.evidence(own, rest.gain(term.columns), term.columns.cols(), own.refinement.any());
  std::optional<double> stands;
  const auto hold = [&](Alternative& alternative, const Candidate& c, const Eigen::MatrixXd& columns) {
    if (!stands) stands = evidence_beside(state, rest.design, own, term.columns);
    alternative.evidence_gap = *stands - evidence_beside(state, rest.design, c, columns);
    alternative.by_readings = alternative.evidence_gap -
                              state.evidence(own, 0, term.columns.cols(), own.refinement.any()) +
                              state.evidence(c, 0, columns.cols(), c.refinement.any());
  };
  std::vector<Alternative> result;
  std::map<std::string, Eigen::VectorXd> by_atom;  // energy of the effect that each atom explains
  const auto also = [&](const Candidate& c, const OrthonormalAtoms& unit) { by_atom[c.id] = gains(c, unit, effect); };
  for (const ScoredCandidate& plain : scored_candidates(state, rest, also)) {
    const Candidate& c = plain.candidate();
    if (c.id == own.id) {
      for (Alternative& other : of_other_rows(state, term, by_atom.at(c.id), effect)) {
        hold(other, own, state.columns_of(own, other.theta));
        result.push_back(std::move(other));
      }
      continue;
    }
    const bool smooth = c.kind == Kind::smooth;
    if (smooth && c.own() == own.own() && (c.role.observed || own.kind == Kind::smooth)) continue;
    const auto [theta, explained] = explained_by(state, rest, c, by_atom.at(c.id), effect);
    const double separability = residual_energy(effect, explained);
    const bool confused = c.kind == Kind::named && separability < thresholds::inseparable;
    const ScoredCandidate lead =
        at_its_best(state, rest, plain, confused ? &theta : nullptr, evidence - thresholds::worth_refining_nats);
    Alternative alternative{smooth ? "~" + c.own() : c.id, "", lead.theta, evidence - lead.evidence, separability};
    if (confused) hold(alternative, c, lead.columns);
    if (alternative.evidence_gap >= thresholds::open_nats)
      alternative.theta = theta;  // the theta that is mistaken for the finding, not the candidate's own best
    alternative.label = c.label_of(alternative.theta);
    if (alternative.evidence_gap >= thresholds::open_nats && !confused) continue;
    smooth ? keep_likest(result, std::move(alternative)) : result.push_back(std::move(alternative));
  }
  return result;
}

}  // namespace muster::inference
