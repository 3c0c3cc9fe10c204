#include "diagnosis/inference/select/stated_noise_pass.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/score/marginal_p_value.hpp"
#include "diagnosis/inference/state/null_tail.hpp"

namespace muster::inference {
namespace {

// With the stated size and distance, each family, the best one first.
std::vector<noise::Fit> fitted_as_stated(const Bench& bench, const Eigen::MatrixXd& design) {
  std::vector<noise::Fit> fits;
  for (const noise::Family family : noise::families) {
    const auto start = as_stated(bench.problem().stated, family, bench.fit.covariance.theta, bench.within());
    fits.push_back(noise::fit(bench.field(), bench.y(), design, bench.options().prior, start, 6, noise::unstated));
  }
  std::sort(fits.begin(), fits.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
  return fits;
}

// Whether the stated field, with the lead in the model, is as likely as the best one: both its numbers together are
// within what 99 % of fits err by.
bool stands_as_stated(const Bench& bench, const Eigen::MatrixXd& both, const noise::Fit& stated) {
  constexpr double within = 4.6;  // nats
  const double near_fit = bench.fitted(both, bench.fit.covariance, 6).value;
  const double near_stated = bench.fitted(both, stated.covariance, 6).value;
  return stated.value <= std::min(near_fit, near_stated) + within;
}

// The likeliest first.
std::vector<Lead> beyond_chance(Bench& bench, const Stand& stand, double threshold,
                                const std::function<bool(const Candidate&)>& usable) {
  std::vector<Lead> result;
  for (const Entry& entry : bench.entries()) {
    const Candidate& c = *entry.candidate;
    if (!(c.slow || c.kind == Kind::smooth) || !usable(c)) continue;
    Index at = 0;
    const double gain = gains(c, unit_atoms(entry, stand), stand.at.residual).maxCoeff(&at);
    const double log_p = bench.log_p(c, gain, c.width, false);
    if (log_p >= threshold) continue;
    const Eigen::VectorXd& theta = c.grid[static_cast<std::size_t>(at)];
    result.push_back({&entry, theta, entry.atom(at), gain, bench.evidence(c, gain, c.width, false), log_p, false, {}});
  }
  std::stable_sort(result.begin(), result.end(), [](const Lead& a, const Lead& b) { return a.log_p < b.log_p; });
  return result;
}

// Few near neighbours overstate what is slow, and which family it is nobody says: the least that any allows. One that
// is less likely than the likeliest has to say so much less.
void weigh_beside(const Bench& bench, const Eigen::MatrixXd& design, const std::vector<noise::Fit>& fits, Lead& lead) {
  const Candidate& c = lead.candidate();
  lead.log_p = -std::numeric_limits<double>::infinity();
  for (const noise::Fit& fit : fits) {
    const double unlikely = std::max(0.0, fit.value - fits[0].value - likely_nats);
    if (unlikely > hopeless_nats) continue;
    const Stand stand = bench.stand(design, fit.covariance);
    const double far = bench.far().exact_gain({bench.y(), design, lead.columns, fit.covariance});
    const double gain = std::min(gain_of(c, stand, lead.columns), far) / overdispersion + 2 * unlikely;
    lead.gain = std::min(lead.gain, gain);
    lead.log_p = std::max(lead.log_p, bench.log_p(c, gain, c.width, false) + stand.skew_charge(lead.columns));
  }
}

}  // namespace

std::optional<Lead> stated_look(Bench& bench, const std::function<bool(const Candidate&)>& usable) {
  if (bench.problem().stated.shadowing <= 0 || bench.problem().bounds.any()) return {};
  constexpr std::size_t looked_at = 3;
  const double threshold = bench.threshold() - std::log(2.0);  // a second chance
  const Eigen::MatrixXd design = bench.design();
  const Stand alone = bench.stand(design, fitted_as_stated(bench, design)[0].covariance);
  std::vector<Lead> leads = beyond_chance(bench, alone, threshold, usable);
  for (std::size_t k = 0; k < std::min(leads.size(), looked_at); ++k) {
    const Eigen::MatrixXd both = noise::hstack(design, leads[k].columns);
    const std::vector<noise::Fit> fits = fitted_as_stated(bench, both);
    weigh_beside(bench, design, fits, leads[k]);
    if (leads[k].log_p < threshold && stands_as_stated(bench, both, fits[0])) return leads[k];
  }
  return {};
}

}  // namespace muster::inference
