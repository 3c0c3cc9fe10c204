#include "diagnosis/inference/score/candidate_scores.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "diagnosis/inference/score/refine.hpp"
#include "diagnosis/inference/score/sparse_columns.hpp"
#include "diagnosis/inference/state/null_tail.hpp"
#include "diagnosis/inference/thresholds.hpp"

namespace muster::inference {
namespace {

enum class Columns { exact = 1, sketched };

// Objective of refinement.
class Objective {
 public:
  Objective(const ModelState& state, const WhitenedModel& model, const Candidate& candidate, Columns columns)
      : state_(state),
        model_(model),
        candidate_(candidate),
        sketched_(columns == Columns::sketched && candidate.design.sketch) {}

  SparseColumns& thin() {
    if (!thin_) thin_.emplace(state_, model_);
    return *thin_;
  }

  // Fall of the deviance plus twice the log prior. Impossible thetas get the lowest value, since a whole column may
  // well have a negative gain.
  double operator()(const Eigen::VectorXd& theta) {
    const double admitted = candidate_.refinement.admitted ? candidate_.refinement.admitted(theta) : 1;
    if (admitted <= 0) return lowest;
    return explained(theta, admitted) + (candidate_.refinement.belief ? 2 * candidate_.refinement.belief(theta) : 0);
  }

 private:
  static constexpr double lowest = -1e9;

  double explained(const Eigen::VectorXd& theta, double admitted) {
    const Eigen::MatrixXd columns =
        sketched_ ? state_.sketch_of(candidate_, theta) : state_.columns_of(candidate_, theta);
    if (candidate_.design.width > 1 || candidate_.design.sign == 0) return admitted * model_.gain(columns);
    const auto [along, length] = measured(columns.col(0));
    if (length < 1e-6 || along * candidate_.design.sign <= 0) return 0;
    return admitted * (candidate_.design.whole ? 2 * along - length : along * along / length);
  }

  // Product with the residual, and squared length, of a column with the design projected out.
  std::pair<double, double> measured(const Eigen::Ref<const Eigen::VectorXd>& column) {
    if (thin().take(column)) return {thin().along(), thin().length()};
    const Eigen::VectorXd left = model_.at.basis.rest(model_.whitener(column));
    return {left.dot(model_.at.residual), left.squaredNorm()};
  }

  const ModelState& state_;
  const WhitenedModel& model_;
  const Candidate& candidate_;
  bool sketched_;
  std::optional<SparseColumns> thin_;  // made on first use: columns of two directions need none
};

bool far_from(const Candidate& candidate, const Eigen::VectorXd& theta, const std::vector<Eigen::VectorXd>& others) {
  return std::all_of(others.begin(), others.end(), [&](const Eigen::VectorXd& other) {
    for (Index k = 0; k < theta.size(); ++k) {
      const double step = candidate.refinement.step[k];
      if (step == 0 ? theta[k] != other[k]
                    : std::abs(theta[k] - other[k]) >= thresholds::start_distance * std::abs(step))
        return true;
    }
    return false;
  });
}

// Adds the atoms with the largest gains that are apart from each other and from the given starts.
void add_starts(const Candidate& c, const Eigen::VectorXd& gains, int count, std::vector<Eigen::VectorXd>& starts) {
  std::vector<Index> order(static_cast<std::size_t>(gains.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return gains[a] > gains[b]; });
  const std::size_t enough = starts.size() + static_cast<std::size_t>(count);
  for (std::size_t k = 0; k < std::min<std::size_t>(order.size(), 160) && starts.size() < enough; ++k) {
    const Eigen::VectorXd& theta = c.design.grid[static_cast<std::size_t>(order[k])];
    if (far_from(c, theta, starts)) starts.push_back(theta);
  }
}

// Moves variance from the field to the readings; the total stays. Whitening leaves little of a shadow but its edges,
// so a misplacement beyond their width gains nothing. In white noise the overlap counts.
WhitenedModel with_less_field(const ModelState& state, const WhitenedModel& model, double share) {
  noise::Covariance c = model.whitener.covariance();
  const double moved = (1 - share) * c.field_variance() * state.rows().count().mean();
  c.theta[2] = std::log(c.reading_variance() + moved);
  c.theta[0] += std::log(share);
  return state.whitened_model(model.design, c);
}

Eigen::VectorXd gains_of(const Entry& entry, const WhitenedModel& model) {
  return gains(*entry.candidate, unit_atoms(entry, model), model.at.residual);
}

// Restores a start if it is better at exact columns: sketches may miss a narrow optimum.
Optimum best_of(const std::vector<Eigen::VectorXd>& starts, Optimum reached, Objective exact) {
  reached.second = exact(reached.first);
  for (const Eigen::VectorXd& start : starts) {
    const double there = exact(start);
    if (there > reached.second) reached = {start, there};
  }
  return reached;
}

// Successive halving from many starts.
Optimum raced_to(const ModelState& state, const WhitenedModel& model, const ScoredCandidate& lead) {
  const Candidate& c = lead.candidate();
  Objective height(state, model, c, Columns::sketched);
  const auto value = [&](const Eigen::VectorXd& theta) { return height(theta); };
  std::vector<Eigen::VectorXd> starts;
  if (c.refinement.proposed) {
    constexpr std::size_t likely = 5;  // the first ones proposed
    for (Eigen::VectorXd& theta : state.proposals(c, height.thin())) {
      if (static_cast<int>(starts.size()) < c.refinement.starts && far_from(c, theta, starts))
        starts.push_back(std::move(theta));
    }
    starts.push_back(lead.theta);  // always: the grid may have met a narrow optimum
    const Optimum top = successive_halving(c, starts, {value, value, value});
    starts.resize(std::min(starts.size(), likely));
    return best_of(starts, top, Objective(state, model, c, Columns::exact));
  }
  starts.push_back(lead.theta);
  if (c.role.pieces.empty()) {  // no shadow: a small misplacement still has a gain
    const Eigen::VectorXd all = lead.all.size() > 0 ? lead.all : gains_of(*lead.entry, model);
    add_starts(c, all, c.refinement.starts - 1, starts);
    return successive_halving(c, starts, {value, value, value});
  }
  const WhitenedModel soft = with_less_field(state, model, thresholds::soft_field_share),
                      half = with_less_field(state, model, thresholds::half_field_share);
  if (lead.all.size() > 0) add_starts(c, lead.all, c.refinement.starts / 2, starts);
  add_starts(c, gains_of(*lead.entry, soft), c.refinement.starts, starts);
  Objective on_soft(state, soft, c, Columns::sketched), on_half(state, half, c, Columns::sketched);
  return successive_halving(c, starts, {std::ref(on_soft), std::ref(on_half), value, value});
}

}  // namespace

OrthonormalAtoms unit_atoms(const Entry& entry, const WhitenedModel& model) {
  noise::Sheet atoms = model.whitener.sheet(*entry.atoms);
  // Columns of different rows may differ a thousandfold: one direction's are weighed by differences, which hardly
  // scatter. Of places those that concern few readings are left out.
  Eigen::VectorXf before;
  if (entry.candidate->role.pieces.empty()) {
    before = Eigen::VectorXf::Zero(atoms.cols());
    for (Index i = 0; i < atoms.rows(); ++i) before += atoms.row(i).cwiseAbs2();  // as they lie in memory
  }
  model.at.basis.take_out_of(atoms);
  return {std::move(atoms), entry.candidate->design.width, before};
}

Eigen::VectorXd gains(const Candidate& candidate, const OrthonormalAtoms& unit, const Eigen::VectorXd& residual) {
  return statistics(candidate, unit.along(residual.cast<float>())).col(0).cast<double>();
}

double gain_of(const Candidate& candidate, const WhitenedModel& model, const Eigen::MatrixXd& columns) {
  if (candidate.design.whole) return std::max(0.0, model.gain_as_it_is(columns));
  const auto added = noise::basis_of(model.at.basis.rest(model.whitener(columns)));
  const Eigen::VectorXd along = added.q.transpose() * model.at.residual;
  if (candidate.design.sign && columns.cols() == 1 && added.coefficients(along, 1)[0] * candidate.design.sign < 0)
    return 0;  // its best strength would be of the other sign
  return along.squaredNorm();
}

void by_evidence(std::vector<ScoredCandidate>& leads) {
  std::stable_sort(leads.begin(), leads.end(),
                   [](const ScoredCandidate& a, const ScoredCandidate& b) { return a.evidence > b.evidence; });
}

std::vector<ScoredCandidate> scored_candidates(
    ModelState& state, const WhitenedModel& model,
    const std::function<void(const Candidate&, const OrthonormalAtoms&)>& also) {
  std::vector<ScoredCandidate> result;
  for (const Entry& entry : state.entries()) {
    const Candidate& c = *entry.candidate;
    const OrthonormalAtoms unit = unit_atoms(entry, model);
    state.log_effective_tests(entry, unit);
    if (also) also(c, unit);
    ScoredCandidate lead{&entry, {}, {}, 0, 0, 0, false, gains(c, unit, model.at.residual)};
    if (c.design.whole && !c.refinement.any()) {
      for (Index k = 0; k < lead.all.size(); ++k)
        lead.all[k] = std::clamp(model.gain_as_it_is(entry.atom(k)), 0.0, lead.all[k]);
    }
    Index best = 0;
    lead.gain = lead.all.maxCoeff(&best);
    lead.theta = c.design.grid[static_cast<std::size_t>(best)];
    lead.columns = entry.atom(best);
    lead.evidence = state.evidence(c, lead.gain, c.design.width, false);
    lead.log_p = state.log_p(c, lead.gain, c.design.width, false);
    result.push_back(std::move(lead));
  }
  by_evidence(result);
  return result;
}

ScoredCandidate refined(const ModelState& state, const WhitenedModel& model, const ScoredCandidate& lead,
                        bool from_lead_alone) {
  const Candidate& c = lead.candidate();
  ScoredCandidate best = lead;
  if (c.refinement.any()) {
    Objective height(state, model, c, Columns::exact);
    const auto value = [&](const Eigen::VectorXd& theta) { return height(theta); };
    const bool race = !from_lead_alone && c.refinement.starts > 1;
    Optimum top{lead.theta, 0};
    if (race) {
      top = raced_to(state, model, lead);
    } else if (c.design.sketch) {
      top = local_search(c, lead.theta, c.refinement.evaluations, Objective(state, model, c, Columns::sketched));
    }
    if (!race || c.design.sketch)
      top =
          local_search(c, top.first, c.design.sketch ? c.refinement.evaluations / 2 : c.refinement.evaluations, value);
    if (top.second > value(lead.theta)) best.theta = std::move(top.first);
    best.columns = state.columns_of(c, best.theta);
  }
  best.refined = true;
  best.gain = gain_of(c, model, best.columns);
  best.evidence = state.evidence(c, best.gain, c.design.width, true);
  best.log_p = state.log_p(c, best.gain, c.design.width, true);
  return best;
}

ScoredCandidate refined_by_overlap(const ModelState& state, const WhitenedModel& model, const Entry& entry) {
  const Candidate& c = *entry.candidate;
  const WhitenedModel soft = with_less_field(state, model, thresholds::soft_field_share);
  ScoredCandidate best{&entry, {}, {}, 0, 0, 0, false, gains_of(entry, soft)};
  Index at = 0;
  best.gain = best.all.maxCoeff(&at);
  best.theta = c.design.grid[static_cast<std::size_t>(at)];
  for (int round = 0; round < 4; ++round) {  // a simplex that has shrunk begins anew
    const double before = best.gain;
    best = refined(state, soft, best, true);
    if (best.gain < before + thresholds::refine_again_gain) break;
  }
  best.gain = gain_of(c, model, best.columns);
  best.evidence = state.evidence(c, best.gain, c.design.width, true);
  best.log_p = state.log_p(c, best.gain, c.design.width, true);
  return best;
}

}  // namespace muster::inference
