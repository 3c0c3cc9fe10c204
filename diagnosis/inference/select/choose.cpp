#include "diagnosis/inference/select/choose.hpp"

#include <algorithm>
#include <cmath>

namespace muster::inference {
namespace {

// Twice and four times the functions where Bayes' criterion wins more than 3 nats by it.
Lead grown(const Bench& bench, const Stand& stand, Lead lead) {
  const Candidate& c = lead.candidate();
  if (!c.wider) return lead;
  for (const int times : {2, 4}) {
    Eigen::MatrixXd columns = bench.rows().mean(c.wider(times));
    const double gain = stand.gain(columns);
    const double evidence = bench.evidence(c, gain, columns.cols(), false);
    if (evidence <= lead.evidence + 3) break;
    lead.columns = std::move(columns);
    lead.gain = gain;
    lead.evidence = evidence;
  }
  return lead;
}

const Lead* same_entry(const std::vector<Lead>& leads, const Lead& lead) {
  const auto found = std::find_if(leads.begin(), leads.end(), [&](const Lead& o) { return o.entry == lead.entry; });
  return found == leads.end() ? nullptr : &*found;
}

// A cause refined at the covariance of this round; what it gained in a second look stays its own.
Lead at_its_best(const Bench& bench, const Stand& stand, const Lead& plain, const Lead* passing) {
  if (passing && passing->refined) return *passing;
  const Lead& from = passing ? *passing : plain;
  Lead result = refined(bench, stand, from, false);
  if (!from.candidate().whole)
    result.gain = from.gain + std::max(0.0, result.gain - gain_of(from.candidate(), stand, from.columns));
  result.log_p = bench.log_p(from.candidate(), result.gain, from.candidate().width, true);
  result.evidence = bench.evidence(from.candidate(), result.gain, from.candidate().width, true);
  return result;
}

void to_front(std::vector<Lead>& pool, std::vector<Lead>::iterator chosen) {
  std::rotate(pool.begin(), chosen, chosen + 1);
}

// A smooth gives way to a cause of its own covariate that explains nearly all of it.
void prefer_names(std::vector<Lead>& pool, double share) {
  if (pool[0].candidate().kind != Kind::smooth) return;
  const auto chosen = std::find_if(pool.begin(), pool.end(), [&](const Lead& lead) {
    const auto by_chance = static_cast<double>(std::max<Index>(0, pool[0].columns.cols() - lead.columns.cols()));
    return lead.candidate().kind == Kind::named && lead.gain >= share * (pool[0].gain - by_chance) &&
           lead.candidate().stands_for.count(pool[0].candidate().own()) > 0;
  });
  if (chosen != pool.end()) to_front(pool, chosen);
}

// What a lead won, less what chance wins by as many functions and searched parameters, twice over (Akaike 1974). A grid
// that is not refined is sought along one.
double won(const Lead& lead) {
  const Candidate& c = lead.candidate();
  const Index refined = (c.step.array() != 0).count(), searched = c.grid.size() > 1 ? std::max<Index>(refined, 1) : 0;
  return lead.gain - 2 * static_cast<double>(lead.columns.cols() + searched);
}

// A function of time gives way to an observed column that does as well for its number of functions.
void prefer_observed(std::vector<Lead>& pool) {
  if (!pool[0].candidate().time_like) return;
  const auto chosen = std::find_if(pool.begin(), pool.end(), [&](const Lead& lead) {
    return lead.candidate().observed && won(lead) >= won(pool[0]);
  });
  if (chosen != pool.end()) to_front(pool, chosen);
}

// Whether two leads add the same to the readings, but for a hundredth.
bool same_effect(const Stand& stand, const Lead& a, const Lead& b) {
  const auto of_a = noise::basis_of(stand.at.basis.rest(stand.whitener(a.columns)));
  const auto of_b = noise::basis_of(stand.at.basis.rest(stand.whitener(b.columns)));
  return of_a.q.cols() == of_b.q.cols() &&
         (of_b.q.transpose() * of_a.q).squaredNorm() > 0.99 * static_cast<double>(of_a.q.cols());
}

// Of causes that the readings cannot tell apart the simplest.
void prefer_simple(std::vector<Lead>& pool, const Stand& stand) {
  if (pool[0].candidate().kind != Kind::named) return;
  for (auto lead = pool.begin() + 1; lead != pool.end(); ++lead) {
    const Candidate& c = lead->candidate();
    if (c.kind != Kind::named || c.parameters >= pool[0].candidate().parameters) continue;
    if (same_effect(stand, pool[0], *lead)) return to_front(pool, lead);
  }
}

}  // namespace

std::vector<Lead> compared(const Bench& bench, const Stand& stand, const std::vector<Lead>& passing,
                           const std::vector<Lead>& all, const std::function<bool(const Candidate&)>& usable) {
  std::vector<Lead> pool;
  double best_smooth = 1e300;
  for (const Lead& lead : passing) {
    if (lead.candidate().kind != Kind::smooth || pool.size() >= 3) continue;
    pool.push_back(grown(bench, stand, lead));
    best_smooth = pool.size() == 1 ? pool[0].evidence : std::max(best_smooth, pool.back().evidence);
  }
  int named = 0;
  for (const Lead& lead : all) {
    if (lead.candidate().kind != Kind::named || !usable(lead.candidate()) || named >= 4) continue;
    ++named;
    const Lead* const passed = same_entry(passing, lead);
    if (!passed && lead.evidence <= best_smooth - 400) continue;
    Lead best = at_its_best(bench, stand, lead, passed);
    if (best.log_p < bench.threshold()) pool.push_back(std::move(best));
  }
  if (pool.empty()) pool = passing;
  by_evidence(pool);
  prefer_names(pool, bench.options().share);
  prefer_observed(pool);
  prefer_simple(pool, stand);
  return pool;
}

}  // namespace muster::inference
