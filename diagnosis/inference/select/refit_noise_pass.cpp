#include "diagnosis/inference/select/refit_noise_pass.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/score/marginal_p_value.hpp"

namespace muster::inference {
namespace {

bool has(const std::vector<Lead>& leads, const Lead& lead) {
  return std::any_of(leads.begin(), leads.end(),
                     [&](const Lead& other) { return other.entry == lead.entry && other.theta == lead.theta; });
}

bool looked_at_again(const Candidate& c) { return c.kind == Kind::named || c.slow; }

// Three that nearly pass, everything whose gain has many tops, of which the grid may miss the highest, and what the
// ladder brings up.
std::vector<Lead> worth_a_look(Bench& bench, const std::vector<Lead>& first,
                               const std::function<bool(const Candidate&)>& usable) {
  std::vector<Lead> result;
  for (const Lead& lead : first) {
    if (looked_at_again(lead.candidate()) && lead.log_p < std::log(0.5) && usable(lead.candidate()) &&
        result.size() < 3)
      result.push_back(lead);
  }
  for (const Lead& lead : first) {
    if (lead.candidate().starts > 1 && usable(lead.candidate()) && !has(result, lead)) result.push_back(lead);
  }
  std::vector<Lead> slow = ladder(bench, usable);
  slow.resize(std::min<std::size_t>(slow.size(), 4), slow.empty() ? Lead{} : slow[0]);
  for (const Lead& lead : slow) {
    if (!has(result, lead)) result.push_back(lead);
  }
  return result;
}

noise::Fit fit_with(const Bench& bench, const Candidate& candidate, const Eigen::MatrixXd& both) {
  noise::Fit fit = bench.fitted(both, bench.fit.covariance, 6);
  if (!candidate.slow) return fit;
  noise::Covariance weaker = bench.fit.covariance;  // a second start: shorter and weaker field
  weaker.theta += noise::Theta(std::log(0.35), std::log(0.5), 0, 0);
  const noise::Fit other = bench.fitted(both, weaker, 12);
  return other.value < fit.value - 0.3 ? other : fit;
}

// The field of before holds a part of the place and draws it aside: up to two thirds of the gain, as far as seen, and
// where it gives little back at the place that it drew it to, little (at most 2.1 times as much, and 1.2 in all).
double most_to_come(double before, double gain) {
  constexpr double times = 10, at_least = 4;
  return std::min(3 * gain, gain + at_least + times * std::max(0.0, gain - before));
}

// Once the noise is fitted beside it, with room to spare: over 800 that were looked at no gain grew to more than 1.7
// times as much.
double most_once_fitted(double gain) { return 4 + 3 * gain; }

}  // namespace

std::vector<Lead> second_look(Bench& bench, const Stand& stand, const std::vector<Lead>& first,
                              const std::function<bool(const Candidate&)>& usable) {
  std::vector<Lead> looked = worth_a_look(bench, first, usable);
  const Eigen::MatrixXd design = bench.design();
  for (Lead& lead : looked) {
    const Candidate& c = lead.candidate();
    if (c.starts > 1) lead = refined(bench, stand, lead, false);
    lead.log_p = bench.log_p(c, lead.gain, c.width, true);
    if (bench.log_p(c, most_once_fitted(lead.gain), c.width, true) > bench.threshold()) continue;
    noise::Fit fit = fit_with(bench, c, noise::hstack(design, lead.columns));
    const double gain = gain_of(c, bench.stand(design, fit.covariance), lead.columns);
    if (c.starts > 1 && bench.log_p(c, most_to_come(lead.gain, gain), c.width, true) < bench.threshold()) {
      lead = refined(bench, bench.stand(design, fit.covariance), lead, false);
      fit = bench.fitted(noise::hstack(design, lead.columns), fit.covariance, 6);
    }
    lead.gain = gain_of(c, bench.stand(design, fit.covariance), lead.columns);
    lead.evidence = bench.evidence(c, lead.gain, c.width, false);
    lead.log_p = bench.log_p(c, lead.gain, c.width, true);
  }
  by_evidence(looked);
  return looked;
}

std::vector<Lead> ladder(Bench& bench, const std::function<bool(const Candidate&)>& usable) {
  const Eigen::MatrixXd design = bench.design();
  const noise::Covariance fitted = bench.fit.covariance;
  const double value = bench.stand(design).at.value;
  std::map<std::string, Lead> best;
  for (const double shorter : {1.0, 0.75, 0.55, 0.4, 0.28}) {
    for (const double weaker : {shorter, std::sqrt(shorter), 1.0}) {
      if (shorter == 1 && weaker != shorter) continue;
      noise::Covariance covariance = fitted;
      covariance.theta += noise::Theta(std::log(weaker), std::log(shorter), 0, 0);
      const Stand stand = bench.stand(design, covariance);
      const double lost = 2 * (stand.at.value - value);
      if (lost > 60) continue;
      for (const Entry& entry : bench.entries()) {
        const Candidate& c = *entry.candidate;
        if (!c.slow || !usable(c)) continue;
        Index at = 0;
        const double gain = gains(c, unit_atoms(entry, stand), stand.at.residual).maxCoeff(&at) - lost;
        const auto found = best.find(c.id);
        if (found != best.end() && found->second.gain >= gain) continue;
        best[c.id] = {&entry,
                      c.grid[static_cast<std::size_t>(at)],
                      entry.atom(at),
                      gain,
                      bench.evidence(c, gain, c.width, false),
                      0,
                      false,
                      {}};
      }
      if (shorter == 1) break;
    }
  }
  std::vector<Lead> result;
  for (auto& [id, lead] : best) {
    if (lead.gain > 4) result.push_back(std::move(lead));
  }
  by_evidence(result);
  return result;
}

}  // namespace muster::inference
