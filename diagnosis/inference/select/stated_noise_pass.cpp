#include "diagnosis/inference/select/stated_noise_pass.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/score/drawn_inflation.hpp"
#include "diagnosis/inference/score/marginal_p_value.hpp"
#include "diagnosis/inference/select/stays.hpp"
#include "diagnosis/inference/state/null_tail.hpp"
#include "diagnosis/inference/thresholds.hpp"

namespace muster::inference {
namespace {

// Fits of each family with the stated size and distance held, the best one first. `y`: the rows, or a draw of them.
std::vector<noise::Fit> fitted_as_stated(const ModelState& state, const Eigen::VectorXd& y,
                                         const Eigen::MatrixXd& design) {
  std::vector<noise::Fit> fits;
  const noise::Family fitted = state.fit.covariance.family;
  const bool fixed = noise::fixed_share(fitted) > 0;
  for (const noise::Family family : fixed ? std::vector{fitted} : state.field().families()) {
    const auto start = as_stated(state.stated(), family, state.fit.covariance.theta, state.within());
    fits.push_back(noise::fit(state.field(), y, design, state.options().prior, start, 6, noise::unstated));
  }
  std::sort(fits.begin(), fits.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
  return fits;
}

// Nats by which the stated field, with the lead in the model, is behind the best one, by the readings alone: the prior
// of a field that nobody states would charge it for its distance.
double nats_behind(const ModelState& state, const Eigen::VectorXd& y, const Eigen::MatrixXd& both,
                   const noise::Fit& stated) {
  const noise::Prior& prior = state.options().prior;
  const auto by_readings = [&](const noise::Fit& fit) { return fit.value - prior_nats(fit.covariance, prior); };
  const auto value_from = [&](const noise::Covariance& start) {
    return by_readings(noise::fit(state.field(), y, both, prior, start, 6));
  };
  return by_readings(stated) - std::min(value_from(state.fit.covariance), value_from(stated.covariance));
}

// Where nothing blurs the readings, a few waves are smoother than their covariance says, and the likelihood, which
// looks at neighbours, prefers another one by far; the levels of whole stations scatter as stated all the same.
bool is_unblurred(const ModelState& state) {
  return state.field().correlated().stated && state.fit.covariance.reading_variance() < thresholds::unblurred_variance;
}

// True if draws of the model, whose field is the stated one, are as far behind. Costs many fits.
bool draws_are_behind(const ModelState& state, const Eigen::MatrixXd& both, double behind) {
  return within_draws(state, state.stated(), behind, [&](const Eigen::VectorXd& y) {
    return nats_behind(state, y, both, fitted_as_stated(state, y, both)[0]);
  });
}

// True if the stated field, with the lead in the model, fits as well as the best one: it lies in the joint 99 % region
// of its two parameters. Or if it fits as it does in draws, and the lead is beyond chance with its gain divided by what
// draws have of it.
bool stands_as_stated(const ModelState& state, const Eigen::MatrixXd& design, const Eigen::MatrixXd& both,
                      const noise::Fit& stated, double threshold, ScoredCandidate& lead) {
  const double behind = nats_behind(state, state.y(), both, stated);
  if (behind <= thresholds::stated_field_nats) return true;
  if (!is_unblurred(state)) return false;
  const Candidate& c = lead.candidate();
  const WhitenedModel model = state.whitened_model(design, stated.covariance);
  lead.inflation = drawn_inflation(state, model, c, state.stated());
  lead.gain /= lead.inflation;
  lead.log_p = std::max(lead.log_p, state.log_p(c, lead.gain, c.design.width, false) + model.skew_charge(lead.columns));
  return lead.log_p < threshold && draws_are_behind(state, both, behind);
}

// Significant slow candidates, the likeliest first.
std::vector<ScoredCandidate> beyond_chance(ModelState& state, const WhitenedModel& model, double threshold,
                                           const std::function<bool(const Candidate&)>& usable) {
  std::vector<ScoredCandidate> result;
  for (const Entry& entry : state.entries()) {
    const Candidate& c = *entry.candidate;
    if (!(c.role.slow || c.kind == Kind::smooth) || !usable(c)) continue;
    Index at = 0;
    const double gain = gains(c, unit_atoms(entry, model), model.at.residual).maxCoeff(&at);
    const double log_p = state.log_p(c, gain, c.design.width, false);
    if (log_p >= threshold) continue;
    const Eigen::VectorXd& theta = c.design.grid[static_cast<std::size_t>(at)];
    result.push_back(
        {&entry, theta, entry.atom(at), gain, state.evidence(c, gain, c.design.width, false), log_p, false, {}});
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const ScoredCandidate& a, const ScoredCandidate& b) { return a.log_p < b.log_p; });
  return result;
}

// Least gain over all families, on the search's rows and on longer ones: few near neighbours overstate slow effects,
// and the family is unknown. A less likely family is credited with twice its excess.
void weigh_beside(const ModelState& state, const Eigen::MatrixXd& design, const std::vector<noise::Fit>& fits,
                  ScoredCandidate& lead) {
  const Candidate& c = lead.candidate();
  lead.log_p = -std::numeric_limits<double>::infinity();
  for (const noise::Fit& fit : fits) {
    const double unlikely = std::max(0.0, fit.value - fits[0].value - thresholds::likely_nats);
    if (unlikely > thresholds::hopeless_nats) continue;
    const WhitenedModel model = state.whitened_model(design, fit.covariance);
    const double far = state.far().exact_gain({state.y(), design, lead.columns, fit.covariance});
    const double gain = std::min(gain_of(c, model, lead.columns), far) / thresholds::overdispersion + 2 * unlikely;
    lead.gain = std::min(lead.gain, gain);
    lead.log_p = std::max(lead.log_p, state.log_p(c, gain, c.design.width, false) + model.skew_charge(lead.columns));
  }
}

}  // namespace

std::optional<ScoredCandidate> stated_noise_pass(ModelState& state, const std::function<bool(const Candidate&)>& usable,
                                                 std::vector<Trial>& trials) {
  if (state.stated().shadowing <= 0 || state.problem().bounds.any()) return {};
  const double threshold = state.threshold() - std::log(2.0);  // a second test
  const Eigen::MatrixXd design = state.design();
  const WhitenedModel alone = state.whitened_model(design, fitted_as_stated(state, state.y(), design)[0].covariance);
  std::vector<ScoredCandidate> leads = beyond_chance(state, alone, threshold, usable);
  for (std::size_t k = 0; k < std::min(leads.size(), thresholds::most_stated_leads); ++k) {
    const Eigen::MatrixXd both = noise::hstack(design, leads[k].columns);
    const std::vector<noise::Fit> fits = fitted_as_stated(state, state.y(), both);
    weigh_beside(state, design, fits, leads[k]);
    if (leads[k].log_p >= threshold || !stands_as_stated(state, design, both, fits[0], threshold, leads[k])) continue;
    const Candidate& c = leads[k].candidate();
    if (!is_chance_of_stays(state, c, leads[k].columns, design)) return leads[k];
    trials.push_back({c.id, c.label_of(leads[k].theta), leads[k].gain, leads[k].log_p, leads[k].log_p, false,
                      chance_of_stays, true});
  }
  return {};
}

}  // namespace muster::inference
