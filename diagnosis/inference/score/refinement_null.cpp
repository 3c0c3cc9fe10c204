#include "diagnosis/inference/score/refinement_null.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "muster/random.hpp"

namespace muster::inference {
namespace {

const Entry& entry_named(const ModelState& state, const std::string& id) {
  for (const Entry& entry : state.entries()) {
    if (entry.candidate->id == id) return entry;
  }
  throw std::invalid_argument(id + ": no such candidate");
}

}  // namespace

double refinement_null(ModelState& state, const std::string& candidate, int draws) {
  const Entry& entry = entry_named(state, candidate);
  const Candidate& c = *entry.candidate;
  WhitenedModel model = state.whitened_model(state.design());
  const OrthonormalAtoms unit = unit_atoms(entry, model);
  state.log_effective_tests(entry, unit);
  const Stream stream(combined(key_of("refined nulls"), state.options().seed));
  std::vector<double> log_p;
  for (int k = 0; k < draws; ++k) {
    Eigen::VectorXd z(state.rows().size());
    for (Index i = 0; i < z.size(); ++i) z[i] = stream.normal(static_cast<uint64_t>(i), static_cast<uint64_t>(k));
    model.at.residual = model.at.basis.rest(z);
    ScoredCandidate lead{&entry, {}, {}, 0, 0, 0, false, gains(c, unit, model.at.residual)};
    Index best = 0;
    lead.gain = lead.all.maxCoeff(&best);
    lead.theta = c.design.grid[static_cast<std::size_t>(best)];
    lead.columns = entry.atom(best);
    log_p.push_back(refined(state, model, lead, false).log_p - c.refinement.charge);
  }
  std::sort(log_p.begin(), log_p.end());
  // The k-th smallest of n uniform p-values is near k / (n + 1). Only the lower half matters for decisions.
  std::vector<double> short_by;
  for (std::size_t k = 0; k < (log_p.size() + 1) / 2; ++k)
    short_by.push_back(std::log(static_cast<double>(k + 1) / static_cast<double>(log_p.size() + 1)) - log_p[k]);
  std::sort(short_by.begin(), short_by.end());
  return short_by[short_by.size() / 2];
}

}  // namespace muster::inference
