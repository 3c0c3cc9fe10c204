#include "diagnosis/inference/select/refit_noise_pass.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/score/marginal_p_value.hpp"
#include "diagnosis/inference/thresholds.hpp"

namespace muster::inference {
namespace {

bool has(const std::vector<ScoredCandidate>& leads, const ScoredCandidate& lead) {
  return std::any_of(leads.begin(), leads.end(), [&](const ScoredCandidate& other) {
    return other.entry == lead.entry && other.theta == lead.theta;
  });
}

bool looked_at_again(const Candidate& c) { return c.kind == Kind::named || c.role.slow; }

// True if the grid may miss the highest gain.
bool hides_its_best(const Candidate& c) { return c.refinement.starts > 1 || c.refinement.edged; }

// Three near misses, every candidate whose best the grid may miss, and the best of the ladder.
std::vector<ScoredCandidate> worth_a_look(ModelState& state, const std::vector<ScoredCandidate>& first,
                                          const std::function<bool(const Candidate&)>& usable, RememberedRound& known) {
  std::vector<ScoredCandidate> result;
  for (const ScoredCandidate& lead : first) {
    if (looked_at_again(lead.candidate()) && lead.log_p < std::log(thresholds::near_miss_p) &&
        usable(lead.candidate()) && result.size() < thresholds::most_near_misses)
      result.push_back(lead);
  }
  for (const ScoredCandidate& lead : first) {
    if (hides_its_best(lead.candidate()) && usable(lead.candidate()) && !has(result, lead)) result.push_back(lead);
  }
  if (!known.ladder) known.ladder = ladder(state, usable);
  std::vector<ScoredCandidate> slow = *known.ladder;
  std::erase_if(slow, [&](const ScoredCandidate& lead) { return !usable(lead.candidate()); });
  slow.resize(std::min(slow.size(), thresholds::most_slow_leads), slow.empty() ? ScoredCandidate{} : slow[0]);
  for (const ScoredCandidate& lead : slow) {
    if (!has(result, lead)) result.push_back(lead);
  }
  return result;
}

noise::Fit fit_with(const ModelState& state, const Candidate& candidate, const Eigen::MatrixXd& both) {
  noise::Fit fit = state.fitted(both, state.fit.covariance, 6);
  if (!candidate.role.slow) return fit;
  noise::Covariance weaker = state.fit.covariance;  // a second start: shorter and weaker field
  weaker.theta += noise::Theta(std::log(0.35), std::log(0.5), 0, 0);
  const noise::Fit other = state.fitted(both, weaker, 12);
  return other.value < fit.value - thresholds::second_start_nats ? other : fit;
}

// Upper bound of the gain after relocation. The earlier field holds a part of the place and biases its position: up
// to two thirds of the gain, as far as observed. Where the refit at the biased position recovers little, so does
// relocation (at most 2.1 times as much, and 1.2 in all).
double most_to_come(double before, double gain) {
  return std::min(thresholds::relocation_factor * gain,
                  gain + thresholds::relocation_at_least + thresholds::relocation_times * std::max(0.0, gain - before));
}

// Upper bound of the gain with the noise refitted: over 800 observed, none grew to more than 1.7 times as much.
double most_once_fitted(double gain) { return thresholds::refit_at_least + thresholds::refit_factor * gain; }

// Refines a cause whose best the grid may miss, and scores it with the noise fitted beside it. What has edges is found
// by its overlap where the noise fits better beside that.
ScoredCandidate looked_at(const ModelState& state, const WhitenedModel& model, const Eigen::MatrixXd& design,
                          ScoredCandidate lead, RememberedLeads& known) {
  const Candidate& c = lead.candidate();
  if (hides_its_best(c))
    lead = known.worked_out(lead, [&](const ScoredCandidate& from) { return refined(state, model, from, false); });
  lead.log_p = state.log_p(c, lead.gain, c.design.width, true);
  if (!c.refinement.edged && state.log_p(c, most_once_fitted(lead.gain), c.design.width, true) > state.threshold())
    return lead;
  noise::Fit fit = fit_with(state, c, noise::hstack(design, lead.columns));
  if (c.refinement.edged) {
    ScoredCandidate other = refined_by_overlap(state, model, *lead.entry);
    const noise::Fit beside = fit_with(state, c, noise::hstack(design, other.columns));
    if (beside.value < fit.value) {
      lead = std::move(other);
      fit = beside;
    }
  }
  const double gain = gain_of(c, state.whitened_model(design, fit.covariance), lead.columns);
  if (hides_its_best(c) && state.log_p(c, most_to_come(lead.gain, gain), c.design.width, true) < state.threshold()) {
    lead = refined(state, state.whitened_model(design, fit.covariance), lead, false);
    fit = state.fitted(noise::hstack(design, lead.columns), fit.covariance, 6);
  }
  lead.gain = gain_of(c, state.whitened_model(design, fit.covariance), lead.columns);
  lead.evidence = state.evidence(c, lead.gain, c.design.width, false);
  lead.log_p = state.log_p(c, lead.gain, c.design.width, true);
  return lead;
}

}  // namespace

std::vector<ScoredCandidate> refit_noise_pass(ModelState& state, const WhitenedModel& model,
                                              const std::vector<ScoredCandidate>& first,
                                              const std::function<bool(const Candidate&)>& usable,
                                              RememberedRound& known) {
  std::vector<ScoredCandidate> looked = worth_a_look(state, first, usable, known);
  const Eigen::MatrixXd design = state.design();
  for (ScoredCandidate& lead : looked) {
    lead = known.refitted.worked_out(
        lead, [&](const ScoredCandidate& from) { return looked_at(state, model, design, from, known.refined); });
  }
  by_evidence(looked);
  return looked;
}

std::vector<ScoredCandidate> ladder(ModelState& state, const std::function<bool(const Candidate&)>& usable) {
  const Eigen::MatrixXd design = state.design();
  const noise::Covariance fitted = state.fit.covariance;
  const double value = state.whitened_model(design).at.value;
  std::map<std::string, ScoredCandidate> best;
  for (const double shorter : {1.0, 0.75, 0.55, 0.4, 0.28}) {
    for (const double weaker : {shorter, std::sqrt(shorter), 1.0}) {
      if (shorter == 1 && weaker != shorter) continue;
      noise::Covariance covariance = fitted;
      covariance.theta += noise::Theta(std::log(weaker), std::log(shorter), 0, 0);
      const WhitenedModel model = state.whitened_model(design, covariance);
      const double lost = 2 * (model.at.value - value);
      if (lost > thresholds::ladder_loss) continue;
      for (const Entry& entry : state.entries()) {
        const Candidate& c = *entry.candidate;
        if (!c.role.slow || !usable(c)) continue;
        Index at = 0;
        const double gain = gains(c, unit_atoms(entry, model), model.at.residual).maxCoeff(&at) - lost;
        const auto found = best.find(c.id);
        if (found != best.end() && found->second.gain >= gain) continue;
        best[c.id] = {&entry,
                      c.design.grid[static_cast<std::size_t>(at)],
                      entry.atom(at),
                      gain,
                      state.evidence(c, gain, c.design.width, false),
                      0,
                      false,
                      {}};
      }
      if (shorter == 1) break;
    }
  }
  std::vector<ScoredCandidate> result;
  for (auto& [id, lead] : best) {
    if (lead.gain > thresholds::ladder_gain) result.push_back(std::move(lead));
  }
  by_evidence(result);
  return result;
}

}  // namespace muster::inference
