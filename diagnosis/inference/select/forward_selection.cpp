#include "diagnosis/inference/select/forward_selection.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/score/bulk_inflation.hpp"
#include "diagnosis/inference/score/clipping_check.hpp"
#include "diagnosis/inference/score/drawn_inflation.hpp"
#include "diagnosis/inference/score/longer_fields.hpp"
#include "diagnosis/inference/score/marginal_p_value.hpp"
#include "diagnosis/inference/select/choose.hpp"
#include "diagnosis/inference/select/fit_beside.hpp"
#include "diagnosis/inference/select/gain_by_row.hpp"
#include "diagnosis/inference/select/merge_duplicates.hpp"
#include "diagnosis/inference/select/nearer_draws_pass.hpp"
#include "diagnosis/inference/select/refit_noise_pass.hpp"
#include "diagnosis/inference/select/relocate.hpp"
#include "diagnosis/inference/select/site_levels.hpp"
#include "diagnosis/inference/select/stated_noise_pass.hpp"
#include "diagnosis/inference/select/stays.hpp"
#include "diagnosis/inference/state/null_tail.hpp"
#include "diagnosis/inference/thresholds.hpp"

namespace muster::inference {
namespace {

constexpr const char* like_clipping = "cannot be told from clipping";
constexpr const char* beside_a_longer_field = "not beyond chance beside a longer field";
constexpr const char* few_readings = "rests on fewer than five readings";

struct Blocked {
  std::set<std::string> now;              // until the model changes
  std::set<std::string> for_good;         // indistinguishable from clipping
  std::set<std::string> beside_longer{};  // refused beside a longer field, and held to it from then on
  int aside = 0;                          // times that readings were set aside, after which a cause was tried again
};

// Log p under the exact covariance. Global effects that change little within longer rows are also tested on those,
// with more neighbours.
//
// Gains of global effects are wider than chi-square by the overdispersion. Such an effect is a sum over rows all over
// the plan, and no family matches the true field exactly. On 366 clean worlds of 2,000 to 20,000 readings six gains of
// smooths just above the chi-square threshold were false. At a factor of 1.1 three of them remained. On 445 others
// four gains of named causes were false; a factor of 1.2 rejects two of these.
double sure_log_p(const ModelState& state, const ScoredCandidate& lead, const noise::Fit& fit,
                  const WhitenedModel& model) {
  const Candidate& c = lead.candidate();
  double gain = model.exact_gain(state.field(), lead.columns);
  const LongRangeRows::Question question{state.y(), model.design, lead.columns, fit.covariance};
  if (c.role.pieces.empty() && state.far().kept(question, state.field()) > thresholds::kept_information) {
    gain = std::min(gain, state.far().gain_lower_bound(question));
    if (c.role.slow || c.kind == Kind::smooth) {
      const std::vector<noise::Family> families = state.likely_families(fit.covariance.family);
      gain = std::min(gain, state.far().profile_gain(question, state.fit.covariance, families));
    }
  }
  const bool over_the_plan = c.kind == Kind::smooth || (c.role.pieces.empty() && state.problem().layout->sites_known());
  if (over_the_plan) gain /= thresholds::overdispersion;
  return state.log_p(c, gain, lead.columns.cols(), true);
}

// Tests a lead for significance over the uncertain covariance, for support by one group alone, and for clipping.
Trial tried(const ModelState& state, const ScoredCandidate& lead, const noise::Fit& fit, const Eigen::MatrixXd& design,
            bool beside_longer) {
  const Candidate& c = lead.candidate();
  const WhitenedModel model = state.whitened_model(design, fit.covariance);
  Trial trial;
  trial.id = c.id;
  trial.label = c.label_of(lead.theta);
  trial.gain = gain_of(c, model, lead.columns);
  trial.log_p = state.log_p(c, trial.gain, lead.columns.cols(), true);
  trial.marginal_log_p = trial.log_p;
  const double skew = model.skew_charge(lead.columns), tests = log_tests(state, c);
  const bool noise_decides = trial.log_p > thresholds::log_p_beyond_noise;
  double& log_p = trial.marginal_log_p;  // can only rise: what costs most comes last
  if (noise_decides) log_p = marginal_log_p(state, fit, design, lead.columns, tests);
  if (c.design.whole) log_p = std::max(log_p, trial.log_p);  // not at another strength
  if (log_p <= state.threshold() && trial.log_p > thresholds::log_p_beyond_approximation)
    log_p = std::max(log_p, sure_log_p(state, lead, fit, model));
  log_p += skew;
  const auto inflate = [&](double by) {
    trial.inflation = std::max(trial.inflation, by);
    log_p = std::max(log_p, state.log_p(c, trial.gain / trial.inflation, lead.columns.cols(), true));
  };
  const Eigen::MatrixXd both = noise::hstack(design, lead.columns);
  if (log_p <= state.threshold())
    inflate(bulk_inflation(state, state.whitened_model(both, fit.covariance), c, lead.columns));
  // Of the noise beside the lead: without it the field holds the lead, too. Where a network stands, few sites decide,
  // and a place has numbers enough to take the field of the best-fitting ones with it.
  const noise::Covariance& beside = is_standing(state) ? state.fit.covariance : fit.covariance;
  for (const noise::StatedField& field : state.drawable(beside)) {
    if (log_p <= state.threshold() && resembles_draws(state, both, field))
      inflate(drawn_inflation(state, model, c, field));
  }
  if (log_p <= state.threshold() && noise_decides) {
    const double decided = state.threshold() - skew;
    log_p = std::max(log_p, skew + marginal_log_p_elsewhere(state, fit, design, lead.columns, tests, decided));
  }
  bool fails_beside_longer = false;
  if (log_p <= state.threshold() && beside_longer) {
    if (const auto gain = gain_beside_longer(state, fit, design, lead.columns))
      log_p = std::max(log_p, state.log_p(c, *gain, lead.columns.cols(), true));
    fails_beside_longer = log_p > state.threshold();
  }
  const GainByRow gains_by_row = gain_by_row(model, lead.columns);
  if (!c.role.pieces.empty() && share_of_others(state, gains_by_row.won) < thresholds::share_of_others)
    trial.marginal_log_p += state.options().one_group_charge;
  trial.of_outlier = trial.log_p <= state.threshold() && of_outlier(state, lead, model, fit.covariance, gains_by_row);
  if (fails_beside_longer)
    trial.reason = beside_a_longer_field;
  else if (c.role.level_like && state.problem().bounds.any() &&
           !separable_from_clipping(state, fit.covariance, design, lead.columns))
    trial.reason = like_clipping;
  else if (trial.marginal_log_p > state.threshold())
    trial.reason = trial.log_p > state.threshold() ? "not beyond chance"
                                                   : "not beyond chance under another noise that fits as well";
  else if (trial.of_outlier)
    trial.reason = few_readings;
  else if (c.kind == Kind::named && fits_each_site(state, lead))
    trial.reason = "has more numbers than the sites of the network leave";
  else if (is_chance_of_sites(state, c, lead.columns, design))
    trial.reason = "is not beyond how the sites of the network differ by chance";
  else if (trial.of_stays = is_chance_of_stays(state, c, lead.columns, design); trial.of_stays)
    trial.reason = chance_of_stays;
  trial.accepted = trial.reason.empty();
  return trial;
}

// Refines places and times again, with the noise fitted beside them.
void refine_again(ModelState& state, std::size_t at) {
  if (state.terms[at].smooth() || !state.terms[at].candidate->refinement.any()) return;
  for (int round = 0; round < 3; ++round) {
    Term& term = state.terms[at];
    const WhitenedModel model = state.whitened_model(state.design_without(term));
    ScoredCandidate lead{
        &state.entry_of(*term.candidate), term.theta, term.columns, model.gain(term.columns), 0, 0, false, {}};
    const ScoredCandidate better = refined(state, model, lead, true);
    if (better.gain < lead.gain + thresholds::refine_again_gain) return;
    term.theta = better.theta;
    term.columns = better.columns;
    state.refit(4);
  }
}

// Selects the covariance family again: the effect, once in the model, no longer hides the field.
void choose_family_again(ModelState& state) {
  const Eigen::MatrixXd design = state.design();
  noise::Fit best = state.fit;
  for (const noise::Fit& other : state.families) {
    if (other.covariance.family == state.fit.covariance.family) continue;
    noise::Covariance start{other.covariance.family, state.fit.covariance.theta};
    start.theta[1] += noise::log_scale_of(other.covariance.family) - noise::log_scale_of(state.fit.covariance.family);
    const noise::Fit first = state.fitted(design, start, 4);
    if (first.value > best.value + thresholds::likely_nats + thresholds::hopeless_nats) continue;
    const noise::Fit fit = state.fitted(design, first.covariance, 8);
    if (fit.value <
        best.value - (best.covariance.family == state.fit.covariance.family ? thresholds::leave_family_nats : 0))
      best = fit;
  }
  state.fit = best;
}

void take(ModelState& state, const noise::Fit& fit, const Term& term) {
  state.fit = fit;
  state.terms.push_back(term);
  if (term.gain > thresholds::family_again_gain) choose_family_again(state);
}

// Splits rows at the edges of each place, and relocates it.
void settle_at_their_edges(ModelState& state) {
  for (std::size_t k = 0; k < state.terms.size(); ++k) {
    const Term term = state.terms[k];
    if (term.smooth() || term.candidate->role.pieces.empty() || state.end_rows_at(*term.candidate, term.theta) == 0)
      continue;
    state.refit(4);
    relocate(state, k, false);
  }
}

// Sets aside the readings that alone drew a lead to its place, which may hide another place. False if there are none.
bool without_its_outliers(ModelState& state, const ScoredCandidate& lead, const noise::Fit& fit,
                          const Eigen::MatrixXd& design) {
  if (state.problem().bounds.changes()) return false;  // readings are imputed anew all the time
  const WhitenedModel model = state.whitened_model(design, fit.covariance);
  const std::vector<Index> rows = outliers_among(state, model, gain_by_row(model, lead.columns));
  if (rows.empty()) return false;
  state.set_aside(rows, model);
  state.refit();
  return true;
}

// Tests and adds a lead. False if it fails.
bool enter(ModelState& state, ScoredCandidate lead, Blocked& blocked, std::vector<Trial>& trials) {
  const bool place = !lead.candidate().role.pieces.empty();
  if (place && lead.log_p > thresholds::log_p_beyond_edges && state.end_rows_at(lead.candidate(), lead.theta) > 0)
    lead.columns = state.columns_of(lead.candidate(), lead.theta);
  const std::size_t terms = state.terms.size();
  std::optional<ModelState::Draws> drawn_without;
  if (state.problem().bounds.any()) {
    drawn_without = state.draws();
    state.draw_towards(lead.columns, lead.candidate().design.whole);
    state.refit(2);
  }
  const Eigen::MatrixXd design = state.design();
  const noise::Fit fit = fit_beside(state, lead, noise::hstack(design, lead.columns));
  // The first finding must stand beside a longer field, and so must what was refused for it before.
  const bool beside_longer = state.terms.empty() || blocked.beside_longer.count(lead.candidate().id) > 0;
  trials.push_back(tried(state, lead, fit, design, beside_longer));
  Trial& trial = trials.back();
  if (!trial.accepted) {
    if (trial.reason == like_clipping) blocked.for_good.insert(trial.id);
    if (trial.reason == beside_a_longer_field) blocked.beside_longer.insert(trial.id);
    const bool again = trial.of_outlier && trial.reason != like_clipping &&
                       blocked.aside < thresholds::most_set_aside && without_its_outliers(state, lead, fit, design);
    if (again) {
      trial.reason = few_readings + std::string(", without which the search went on");
      ++blocked.aside;
      blocked.now = blocked.for_good;
    } else {
      blocked.now.insert(trial.id);
    }
    if (drawn_without) state.put_back(std::move(*drawn_without));
    return false;
  }
  const double before = state.fit.value;
  take(state, fit,
       {lead.entry->candidate, lead.theta, lead.columns, trial.gain, lead.evidence, trial.marginal_log_p,
        trial.inflation});
  blocked.now = blocked.for_good;
  const std::string pieces = state.terms.back().candidate->role.pieces;
  if (pieces.empty()) {
    refine_again(state, state.terms.size() - 1);
    return true;
  }
  relocate_places(state);
  if (merge_pieces(state, pieces)) {
    state.refit();
    relocate_places(state);
    // What was merged away and left the model as it was would be found again.
    if (state.terms.size() <= terms && state.fit.value > before - thresholds::keep_term_nats)
      blocked.now.insert(trial.id);
  }
  settle_at_their_edges(state);
  return true;
}

// Tests near misses among places again, with rows split at their edges.
std::vector<ScoredCandidate> closer_look(ModelState& state, const std::vector<ScoredCandidate>& looked) {
  std::vector<ScoredCandidate> places;
  for (const ScoredCandidate& lead : looked) {
    if (lead.candidate().refinement.proposed && lead.log_p < state.threshold() + thresholds::near_miss_nats)
      places.push_back(lead);
  }
  Index more = 0;
  for (const ScoredCandidate& lead : places) more += state.end_rows_at(lead.candidate(), lead.theta);
  if (more == 0) return {};
  const Eigen::MatrixXd design = state.design();
  state.refit(4);
  for (ScoredCandidate& lead : places) {
    lead.columns = state.columns_of(lead.candidate(), lead.theta);
    const noise::Fit fit = fit_beside(state, lead, noise::hstack(design, lead.columns));
    lead = refined(state, state.whitened_model(design, fit.covariance), lead, true);
  }
  by_evidence(places);
  return places;
}

void enter_as_stated(ModelState& state, const ScoredCandidate& lead) {
  const Candidate& c = lead.candidate();
  const Eigen::MatrixXd design = state.design();
  const noise::Fit fit = fit_beside(state, lead, noise::hstack(design, lead.columns));
  const double gain = gain_of(c, state.whitened_model(design, fit.covariance), lead.columns);
  Term term{lead.entry->candidate,
            lead.theta,
            lead.columns,
            gain,
            state.evidence(c, gain, lead.columns.cols(), false),
            lead.log_p};
  term.inflation = lead.inflation;
  term.as_stated = true;
  take(state, fit, term);
  refine_again(state, state.terms.size() - 1);
}

bool usable(const ModelState& state, const Blocked& blocked, const Candidate& c) {
  if (blocked.now.count(c.id)) return false;
  return std::none_of(state.terms.begin(), state.terms.end(), [&](const Term& term) {
    const bool again = term.candidate->id == c.id && c.design.grid.size() == 1;
    return again || (term.smooth() && term.candidate->own() == c.own());
  });
}

// All candidates beside the present model.
struct ScoredModel {
  WhitenedModel model;
  std::vector<ScoredCandidate> all;
  RememberedRound known;
};

ScoredModel scored_model(ModelState& state) {
  if (!state.terms.empty() && state.problem().bounds.any()) {
    state.impute(4);
    state.refit(2);  // the noise is compared with that beside a lead, which is fitted to the same draws
  }
  const Eigen::MatrixXd design = state.design();
  WhitenedModel model = state.whitened_model(design);
  state.renew_depending(model.coefficients(design.cols()));
  std::vector<ScoredCandidate> all = scored_candidates(state, model);
  return {std::move(model), std::move(all), {}};
}

}  // namespace

void forward_selection(ModelState& state, std::vector<Trial>& trials) {
  Blocked blocked;
  std::size_t looked_closely = 0;  // number of terms at the last closer look, plus one
  const auto may_enter = [&](const Candidate& c) { return usable(state, blocked, c); };
  std::optional<ScoredModel> scored;  // none where the model has changed
  for (int round = 0; round < 40; ++round) {
    if (state.options().watch.stop()) return;
    state.options().watch.at("searching the residual for structure, " + std::to_string(state.terms.size()) +
                             " found so far");
    if (!scored) scored = scored_model(state);
    auto& [model, all, known] = *scored;
    if (static_cast<int>(state.terms.size()) >= state.options().most_terms) return;
    const auto passes = [&](const ScoredCandidate& lead) {
      return lead.log_p < state.threshold() && may_enter(lead.candidate());
    };
    std::vector<ScoredCandidate> passing;
    std::copy_if(all.begin(), all.end(), std::back_inserter(passing), passes);
    if (passing.empty()) {
      const std::vector<ScoredCandidate> looked = refit_noise_pass(state, model, all, may_enter, known);
      std::copy_if(looked.begin(), looked.end(), std::back_inserter(passing), passes);
      if (passing.empty() && looked_closely <= state.terms.size()) {
        looked_closely = state.terms.size() + 1;
        const std::vector<ScoredCandidate> close = closer_look(state, looked);
        const auto found = std::find_if(close.begin(), close.end(), passes);
        if (found != close.end()) {
          enter(state, *found, blocked, trials);
          scored.reset();
          continue;
        }
      }
      if (passing.empty() && state.problem().bounds.any()) {
        if (const auto nearer = nearer_draws_pass(state, looked, may_enter)) {
          enter(state, *nearer, blocked, trials);
          scored.reset();
          continue;
        }
      }
    }
    if (passing.empty()) {
      const Blocked only{blocked.for_good, blocked.for_good};
      const auto lead = stated_noise_pass(
          state, [&](const Candidate& c) { return usable(state, only, c); }, trials);
      if (!lead) return;
      enter_as_stated(state, *lead);
      blocked.now = blocked.for_good;
      scored.reset();
      continue;
    }
    const Index rows = state.rows().size();
    const int aside = blocked.aside;
    const bool entered =
        enter(state, compared(state, model, passing, all, may_enter, known.refined).front(), blocked, trials);
    // A lead that fails leaves the model as it was, unless rows were split for it or readings set aside. Censored
    // readings are imputed anew.
    const bool renewed = state.rows().size() != rows || blocked.aside != aside;
    if (entered || renewed || state.problem().bounds.any()) scored.reset();
  }
}

}  // namespace muster::inference
