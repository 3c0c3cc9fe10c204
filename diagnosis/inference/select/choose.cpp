#include "diagnosis/inference/select/choose.hpp"

#include <algorithm>
#include <cmath>

namespace muster::inference {
namespace {

// Twice and four times the functions where Bayes' criterion wins more than 3 nats by it.
ScoredCandidate grown(const ModelState& state, const WhitenedModel& model, ScoredCandidate lead) {
  const Candidate& c = lead.candidate();
  if (!c.design.wider) return lead;
  for (const int times : {2, 4}) {
    Eigen::MatrixXd columns = state.rows().mean(c.design.wider(times));
    const double gain = model.gain(columns);
    const double evidence = state.evidence(c, gain, columns.cols(), false);
    if (evidence <= lead.evidence + 3) break;
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

// A cause refined at the covariance of this round; what it gained in a second look stays its own.
ScoredCandidate at_its_best(const ModelState& state, const WhitenedModel& model, const ScoredCandidate& plain,
                            const ScoredCandidate* passing) {
  if (passing && passing->refined) return *passing;
  const ScoredCandidate& from = passing ? *passing : plain;
  ScoredCandidate result = refined(state, model, from, false);
  if (!from.candidate().design.whole)
    result.gain = from.gain + std::max(0.0, result.gain - gain_of(from.candidate(), model, from.columns));
  result.log_p = state.log_p(from.candidate(), result.gain, from.candidate().design.width, true);
  result.evidence = state.evidence(from.candidate(), result.gain, from.candidate().design.width, true);
  return result;
}

void to_front(std::vector<ScoredCandidate>& pool, std::vector<ScoredCandidate>::iterator chosen) {
  std::rotate(pool.begin(), chosen, chosen + 1);
}

// A smooth gives way to a cause of its own covariate that explains nearly all of it.
void prefer_names(std::vector<ScoredCandidate>& pool, double share) {
  if (pool[0].candidate().kind != Kind::smooth) return;
  const auto chosen = std::find_if(pool.begin(), pool.end(), [&](const ScoredCandidate& lead) {
    const auto by_chance = static_cast<double>(std::max<Index>(0, pool[0].columns.cols() - lead.columns.cols()));
    return lead.candidate().kind == Kind::named && lead.gain >= share * (pool[0].gain - by_chance) &&
           lead.candidate().role.stands_for.count(pool[0].candidate().own()) > 0;
  });
  if (chosen != pool.end()) to_front(pool, chosen);
}

// What a lead won, less what chance wins by as many functions and searched parameters, twice over (Akaike 1974). A grid
// that is not refined is sought along one.
double won(const ScoredCandidate& lead) {
  const Candidate& c = lead.candidate();
  const Index refined = (c.refinement.step.array() != 0).count(),
              searched = c.design.grid.size() > 1 ? std::max<Index>(refined, 1) : 0;
  return lead.gain - 2 * static_cast<double>(lead.columns.cols() + searched);
}

// A function of time gives way to an observed column that does as well for its number of functions.
void prefer_observed(std::vector<ScoredCandidate>& pool) {
  if (!pool[0].candidate().role.time_like) return;
  const auto chosen = std::find_if(pool.begin(), pool.end(), [&](const ScoredCandidate& lead) {
    return lead.candidate().role.observed && won(lead) >= won(pool[0]);
  });
  if (chosen != pool.end()) to_front(pool, chosen);
}

// Whether two leads add the same to the readings, but for a hundredth.
bool same_effect(const WhitenedModel& model, const ScoredCandidate& a, const ScoredCandidate& b) {
  const auto of_a = noise::basis_of(model.at.basis.rest(model.whitener(a.columns)));
  const auto of_b = noise::basis_of(model.at.basis.rest(model.whitener(b.columns)));
  return of_a.q.cols() == of_b.q.cols() &&
         (of_b.q.transpose() * of_a.q).squaredNorm() > 0.99 * static_cast<double>(of_a.q.cols());
}

// Of causes that the readings cannot tell apart the simplest.
void prefer_simple(std::vector<ScoredCandidate>& pool, const WhitenedModel& model) {
  if (pool[0].candidate().kind != Kind::named) return;
  for (auto lead = pool.begin() + 1; lead != pool.end(); ++lead) {
    const Candidate& c = lead->candidate();
    if (c.kind != Kind::named || c.role.parameters >= pool[0].candidate().role.parameters) continue;
    if (same_effect(model, pool[0], *lead)) return to_front(pool, lead);
  }
}

}  // namespace

std::vector<ScoredCandidate> compared(const ModelState& state, const WhitenedModel& model,
                                      const std::vector<ScoredCandidate>& passing,
                                      const std::vector<ScoredCandidate>& all,
                                      const std::function<bool(const Candidate&)>& usable) {
  std::vector<ScoredCandidate> pool;
  double best_smooth = 1e300;
  for (const ScoredCandidate& lead : passing) {
    if (lead.candidate().kind != Kind::smooth || pool.size() >= 3) continue;
    pool.push_back(grown(state, model, lead));
    best_smooth = pool.size() == 1 ? pool[0].evidence : std::max(best_smooth, pool.back().evidence);
  }
  int named = 0;
  for (const ScoredCandidate& lead : all) {
    if (lead.candidate().kind != Kind::named || !usable(lead.candidate()) || named >= 4) continue;
    ++named;
    const ScoredCandidate* const passed = same_entry(passing, lead);
    if (!passed && lead.evidence <= best_smooth - 400) continue;
    ScoredCandidate best = at_its_best(state, model, lead, passed);
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
