#include "diagnosis/inference/select/nearer_draws_pass.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/select/fit_beside.hpp"
#include "diagnosis/inference/thresholds.hpp"

namespace muster::inference {

std::optional<ScoredCandidate> nearer_draws_pass(ModelState& state, std::vector<ScoredCandidate> looked,
                                                 const std::function<bool(const Candidate&)>& usable) {
  std::erase_if(looked, [&](const ScoredCandidate& lead) {
    return lead.log_p > std::log(thresholds::near_miss_p) || !usable(lead.candidate());
  });
  if (looked.size() > thresholds::most_near_misses)
    looked.erase(looked.begin() + thresholds::most_near_misses, looked.end());
  const Eigen::MatrixXd design = state.design();
  const ModelState::Draws drawn_without = state.draws();
  for (ScoredCandidate& lead : looked) {
    lead.columns = state.columns_of(lead.candidate(), lead.theta);  // rows may have been split for another
    state.draw_towards(lead.columns, lead.candidate().design.whole);
    const noise::Fit fit = fit_beside(state, lead, noise::hstack(design, lead.columns));
    const Candidate& c = lead.candidate();
    lead.gain = gain_of(c, state.whitened_model(design, fit.covariance), lead.columns);
    lead.evidence = state.evidence(c, lead.gain, lead.columns.cols(), false);
    lead.log_p = state.log_p(c, lead.gain, lead.columns.cols(), true);
    state.put_back(drawn_without);
  }
  std::erase_if(looked, [&](const ScoredCandidate& lead) { return lead.log_p >= state.threshold(); });
  by_evidence(looked);
  std::stable_partition(looked.begin(), looked.end(),
                        [](const ScoredCandidate& lead) { return lead.candidate().kind == Kind::named; });
  return looked.empty() ? std::nullopt : std::optional(std::move(looked.front()));
}

}  // namespace muster::inference
