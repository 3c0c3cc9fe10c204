#include "diagnosis/inference/select/alternatives.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/score/marginal_p_value.hpp"
#include "diagnosis/inference/score/refine.hpp"

namespace muster::inference {
namespace {

constexpr double near_gap = 3;         // nats
constexpr double worth_refining = 15;  // nats

// The term's fitted effect at rows, dB.
Eigen::VectorXd effect_of(const Bench& bench, const Term& term) {
  const Eigen::MatrixXd design = noise::hstack(bench.design_without(term), term.columns);
  return term.columns * bench.stand(design).coefficients(design.cols()).tail(term.columns.cols());
}

// How much of the whitened effect the rival explains at its best theta. `by_atom`: at those of its grid.
std::pair<Eigen::VectorXd, double> explained_by(const Bench& bench, const Stand& rest, const Candidate& c,
                                                const Eigen::VectorXd& by_atom, const Eigen::VectorXd& effect) {
  Index at = 0;
  const double best = by_atom.maxCoeff(&at);
  const Eigen::VectorXd& start = c.grid[static_cast<std::size_t>(at)];
  if (!c.refinable()) return {start, best};
  const auto share = [&](const Eigen::VectorXd& theta, const Eigen::MatrixXd& columns) {
    const double admitted = c.admitted ? c.admitted(theta) : 1;
    const auto added = noise::basis_of(rest.at.basis.rest(rest.whitener(columns)));
    return admitted * (added.q.transpose() * effect).squaredNorm();
  };
  const auto exact = [&](const Eigen::VectorXd& theta) { return share(theta, bench.columns_of(c, theta)); };
  const int evaluations = std::min(60, c.evaluations);
  if (!c.sketch) return climbed(c, start, evaluations, exact);
  Top top = climbed(c, start, evaluations,
                    [&](const Eigen::VectorXd& theta) { return share(theta, bench.sketch_of(c, theta)); });
  top.second = exact(top.first);
  return top;
}

// From its best atom, if that is worth it, and from where it explains the effect, if it does: of a strong effect even
// the nearest atom may miss much.
Lead at_its_best(const Bench& bench, const Stand& rest, const Lead& plain, const Eigen::VectorXd* explaining,
                 double worth) {
  const Candidate& c = plain.candidate();
  if (!c.refinable()) return plain;
  Lead best = plain.evidence > worth ? refined(bench, rest, plain, true) : plain;
  if (!explaining) return best;
  Lead other = plain;
  other.theta = *explaining;
  other = refined(bench, rest, other, true);
  return other.gain > best.gain ? other : best;
}

// The same cause of other rows, the likest first: of two receivers one that reads high is the other one that reads low.
// Where one radio hears all that is heard, it and all radios are one. `by_atom`: how much of the effect each place
// of its grid explains.
std::vector<Rival> of_other_rows(const Bench& bench, const Term& term, const Eigen::VectorXd& by_atom,
                                 const Eigen::VectorXd& effect) {
  constexpr std::size_t most = 3;
  const Candidate& own = *term.candidate;
  if (own.kind != Kind::named || own.refinable() || own.whole) return {};
  const std::string label = own.label_of(term.theta);
  const Eigen::MatrixXd columns = bench.columns_of(own, term.theta);
  std::vector<Rival> result;
  for (std::size_t k = 0; k < own.grid.size(); ++k) {
    const double separability = left_of(effect, by_atom[static_cast<Index>(k)]);
    if (separability < inseparable && own.label_of(own.grid[k]) != label &&
        !bench.columns_of(own, own.grid[k]).isApprox(columns, 1e-9))
      result.push_back({own.id, own.label_of(own.grid[k]), own.grid[k], 0, separability});
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const Rival& a, const Rival& b) { return a.separability < b.separability; });
  if (result.size() > most) result.resize(most);
  return result;
}

// Of several ways to look along one covariate the likest stays.
void keep_likest(std::vector<Rival>& rivals, Rival rival) {
  const auto known = std::find_if(rivals.begin(), rivals.end(), [&](const Rival& r) { return r.id == rival.id; });
  if (known == rivals.end())
    rivals.push_back(std::move(rival));
  else if (rival.evidence_gap < known->evidence_gap)
    *known = std::move(rival);
}

}  // namespace

double left_of(const Eigen::VectorXd& effect, double explained) {
  return std::max(0.0, effect.squaredNorm() - explained);
}

bool left_open(const Rival& rival) {
  return rival.evidence_gap < near_gap || (rival.separability < inseparable && rival.by_readings < near_gap);
}

double standing(const Bench& bench, const Eigen::MatrixXd& design, const Candidate& c, const Eigen::MatrixXd& columns) {
  const Eigen::MatrixXd both = noise::hstack(design, columns);
  const noise::Fit fit = bench.fitted(both, bench.fit.covariance, 4);
  const Stand rest = bench.stand(design, fit.covariance);
  const double by_a_multiple = rest.gain(columns) - gain_of(c, rest, columns);
  return bench.stand(both, fit.covariance).at.basis.log_determinant() - fit.value - by_a_multiple / 2 +
         bench.evidence(c, 0, columns.cols(), c.refinable());
}

std::vector<Rival> rivals_of(Bench& bench, const Term& term) {
  const Stand rest = bench.stand(bench.design_without(term));
  const Eigen::VectorXd effect = rest.at.basis.rest(rest.whitener(effect_of(bench, term)));
  const Candidate& own = *term.candidate;
  const double evidence = bench.evidence(own, rest.gain(term.columns), term.columns.cols(), own.refinable());
  std::optional<double> stands;
  const auto hold = [&](Rival& rival, const Candidate& c, const Eigen::MatrixXd& columns) {
    if (!stands) stands = standing(bench, rest.design, own, term.columns);
    rival.evidence_gap = *stands - standing(bench, rest.design, c, columns);
    rival.by_readings = rival.evidence_gap - bench.evidence(own, 0, term.columns.cols(), own.refinable()) +
                        bench.evidence(c, 0, columns.cols(), c.refinable());
  };
  std::vector<Rival> result;
  std::map<std::string, Eigen::VectorXd> by_atom;  // of what each explains of the effect
  const auto also = [&](const Candidate& c, const UnitAtoms& unit) { by_atom[c.id] = gains(c, unit, effect); };
  for (const Lead& plain : leads(bench, rest, also)) {
    const Candidate& c = plain.candidate();
    if (c.id == own.id) {
      for (Rival& other : of_other_rows(bench, term, by_atom.at(c.id), effect)) {
        hold(other, own, bench.columns_of(own, other.theta));
        result.push_back(std::move(other));
      }
      continue;
    }
    const bool smooth = c.kind == Kind::smooth;
    if (smooth && c.own() == own.own() && (c.observed || own.kind == Kind::smooth)) continue;
    const auto [theta, explained] = explained_by(bench, rest, c, by_atom.at(c.id), effect);
    const double separability = left_of(effect, explained);
    const bool confused = c.kind == Kind::named && separability < inseparable;
    const Lead lead = at_its_best(bench, rest, plain, confused ? &theta : nullptr, evidence - worth_refining);
    Rival rival{smooth ? "~" + c.own() : c.id, "", lead.theta, evidence - lead.evidence, separability};
    if (confused) hold(rival, c, lead.columns);
    if (rival.evidence_gap >= near_gap) rival.theta = theta;  // what it can be mistaken for, not what it is best at
    rival.label = c.label_of(rival.theta);
    if (rival.evidence_gap >= near_gap && !confused) continue;
    smooth ? keep_likest(result, std::move(rival)) : result.push_back(std::move(rival));
  }
  return result;
}

}  // namespace muster::inference
