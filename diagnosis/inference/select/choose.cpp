#include "diagnosis/inference/select/choose.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/inference/thresholds.hpp"

namespace muster::inference {
namespace {

// Doubles and quadruples a smooth's functions, if the Bayes information criterion improves by more than 3 nats.
ScoredCandidate grown(const ModelState& state, const WhitenedModel& model, ScoredCandidate lead) {
  const Candidate& c = lead.candidate();
  for (const Eigen::VectorXd& theta : c.design.wider) {
    Eigen::MatrixXd columns = state.columns_of(c, theta);
    const double gain = model.gain(columns);
    const double evidence = state.evidence(c, gain, columns.cols(), false);
    if (evidence <= lead.evidence + thresholds::grow_nats) break;
    lead.theta = theta;
    lead.columns = std::move(columns);
    lead.gain = gain;
    lead.evidence = evidence;
  }
  return lead;
}

const ScoredCandidate* same_entry(const std::vector<ScoredCandidate>& leads, const ScoredCandidate& lead) {
  const auto found =
      std::find_if(leads.begin(), leads.end(), [&](const ScoredCandidate& o) { return o.entry == lead.entry; });
  return found == leads.end() ? nullptr : &*found;
}

// Refines a cause at the covariance of this round; a gain from the refit-noise pass is kept.
ScoredCandidate at_its_best(const ModelState& state, const WhitenedModel& model, const ScoredCandidate& plain,
                            const ScoredCandidate* passing, RememberedLeads& known) {
  if (passing && passing->refined) return *passing;
  const ScoredCandidate& from = passing ? *passing : plain;
  ScoredCandidate result =
      known.worked_out(from, [&](const ScoredCandidate& lead) { return refined(state, model, lead, false); });
  if (!from.candidate().design.whole)
    result.gain = from.gain + std::max(0.0, result.gain - gain_of(from.candidate(), model, from.columns));
  result.log_p = state.log_p(from.candidate(), result.gain, from.candidate().design.width, true);
  result.evidence = state.evidence(from.candidate(), result.gain, from.candidate().design.width, true);
  return result;
}

void to_front(std::vector<ScoredCandidate>& pool, std::vector<ScoredCandidate>::iterator chosen) {
  std::rotate(pool.begin(), chosen, chosen + 1);
}

// Prefers to a smooth a cause of its covariate that explains nearly all of it; to one of an observed column, such as a
// battery that falls all the while, a cause in time that does as well: it has a name.
void prefer_names(std::vector<ScoredCandidate>& pool, double share) {
  if (pool[0].candidate().kind != Kind::smooth) return;
  const auto chosen = std::find_if(pool.begin(), pool.end(), [&](const ScoredCandidate& lead) {
    if (lead.candidate().kind != Kind::named) return false;
    const auto by_chance = static_cast<double>(std::max<Index>(0, pool[0].columns.cols() - lead.columns.cols()));
    const bool as_well = pool[0].candidate().role.observed && lead.candidate().role.time_like &&
                         lead.evidence > pool[0].evidence - thresholds::unnamed_nats;
    return as_well || (lead.gain >= share * (pool[0].gain - by_chance) &&
                       lead.candidate().role.replaces.count(pool[0].candidate().own()) > 0);
  });
  if (chosen != pool.end()) to_front(pool, chosen);
}

// Gain less twice the number of functions and searched parameters (Akaike 1974). An unrefined grid counts as one
// parameter.
double won(const ScoredCandidate& lead) {
  const Candidate& c = lead.candidate();
  const Index refined = (c.refinement.step.array() != 0).count(),
              searched = c.design.grid.size() > 1 ? std::max<Index>(refined, 1) : 0;
  return lead.gain - 2 * static_cast<double>(lead.columns.cols() + searched);
}

// Prefers to a function of time an observed column that does as well for its number of functions; to a cause in time
// one that does better beyond what prefers names.
void prefer_observed(std::vector<ScoredCandidate>& pool) {
  const Candidate& first = pool[0].candidate();
  if (!first.role.time_like) return;
  const auto chosen = std::find_if(pool.begin(), pool.end(), [&](const ScoredCandidate& lead) {
    if (!lead.candidate().role.observed) return false;
    return won(lead) >= won(pool[0]) &&
           (first.kind != Kind::named || lead.evidence >= pool[0].evidence + thresholds::unnamed_nats);
  });
  if (chosen != pool.end()) to_front(pool, chosen);
}

// True if two candidates have the same effect on the readings, within a hundredth.
bool same_effect(const WhitenedModel& model, const ScoredCandidate& a, const ScoredCandidate& b) {
  const auto of_a = noise::basis_of(model.at.basis.rest(model.whitener(a.columns)));
  const auto of_b = noise::basis_of(model.at.basis.rest(model.whitener(b.columns)));
  return of_a.q.cols() == of_b.q.cols() &&
         (of_b.q.transpose() * of_a.q).squaredNorm() > thresholds::same_effect * static_cast<double>(of_a.q.cols());
}

// Prefers the simplest of causes with the same effect; of those with as many parameters that of the least strength.
void prefer_simple(std::vector<ScoredCandidate>& pool, const WhitenedModel& model) {
  if (pool[0].candidate().kind != Kind::named) return;
  const auto simpler = [&](const ScoredCandidate& lead) {
    const int parameters = lead.candidate().role.parameters, now = pool[0].candidate().role.parameters;
    if (parameters != now) return parameters < now;
    return lead.columns.cols() == 1 && pool[0].columns.cols() == 1 &&
           lead.columns.norm() > thresholds::weaker_strength * pool[0].columns.norm();
  };
  for (auto lead = pool.begin() + 1; lead != pool.end(); ++lead) {
    if (lead->candidate().kind == Kind::named && simpler(*lead) && same_effect(model, pool[0], *lead))
      return to_front(pool, lead);
  }
}

}  // namespace

std::vector<ScoredCandidate> compared(const ModelState& state, const WhitenedModel& model,
                                      const std::vector<ScoredCandidate>& passing,
                                      const std::vector<ScoredCandidate>& all,
                                      const std::function<bool(const Candidate&)>& usable, RememberedLeads& known) {
  std::vector<ScoredCandidate> pool;
  double best_smooth = 1e300;
  for (const ScoredCandidate& lead : passing) {
    if (lead.candidate().kind != Kind::smooth || pool.size() >= thresholds::most_smooths) continue;
    pool.push_back(grown(state, model, lead));
    best_smooth = pool.size() == 1 ? pool[0].evidence : std::max(best_smooth, pool.back().evidence);
  }
  int named = 0;
  for (const ScoredCandidate& lead : all) {
    if (lead.candidate().kind != Kind::named || !usable(lead.candidate()) || named >= thresholds::most_named) continue;
    ++named;
    const ScoredCandidate* const passed = same_entry(passing, lead);
    if (!passed && lead.evidence <= best_smooth - thresholds::hopeless_name_nats) continue;
    ScoredCandidate best = at_its_best(state, model, lead, passed, known);
    if (best.log_p < state.threshold()) pool.push_back(std::move(best));
  }
  if (pool.empty()) pool = passing;
  by_evidence(pool);
  prefer_names(pool, state.options().share);
  prefer_observed(pool);
  prefer_simple(pool, model);
  return pool;
}

}  // namespace muster::inference
