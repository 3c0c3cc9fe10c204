#include "diagnosis/inference/select/forward_selection.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/score/clipping_check.hpp"
#include "diagnosis/inference/score/marginal_p_value.hpp"
#include "diagnosis/inference/select/choose.hpp"
#include "diagnosis/inference/select/merge_duplicates.hpp"
#include "diagnosis/inference/select/refit_noise_pass.hpp"
#include "diagnosis/inference/select/relocate.hpp"
#include "diagnosis/inference/select/stated_noise_pass.hpp"
#include "diagnosis/inference/state/null_tail.hpp"

namespace muster::inference {
namespace {

constexpr const char* like_clipping = "cannot be told from clipping";

struct Blocked {
  std::set<std::string> now;       // until the model changes
  std::set<std::string> for_good;  // cannot be told from clipping
};

// The share of the gain that comes from anchors other than the strongest one. `won`: the gain of each row.
double share_of_others(const Bench& bench, const Eigen::VectorXd& won) {
  std::map<int, double> by_anchor;
  for (Index i = 0; i < won.size(); ++i) by_anchor[bench.field().sites().radio[static_cast<std::size_t>(i)]] += won[i];
  double most = 0;
  for (const auto& [anchor, sum] : by_anchor) most = std::max(most, sum);
  return 1 - most / won.sum();
}

// Whether half of the gain comes from fewer than five readings.
bool from_few(const Bench& bench, const Eigen::VectorXd& won) {
  constexpr double few = 5;
  std::vector<Index> rows(static_cast<std::size_t>(won.size()));
  std::iota(rows.begin(), rows.end(), 0);
  std::sort(rows.begin(), rows.end(), [&](Index a, Index b) { return won[a] > won[b]; });
  double sum = 0, readings = 0;
  for (const Index row : rows) {
    if (sum >= won.sum() / 2) break;
    sum += won[row];
    readings += bench.rows().count()[row];
  }
  return readings < few;
}

// The gain of columns where it is won, and the share of it that stays with all beyond four standard errors cut off.
struct Winnings {
  Eigen::VectorXd won;
  double tame_share;
};

Winnings winnings_of(const Stand& stand, const Eigen::MatrixXd& columns) {
  constexpr double usual = 4;
  const auto added = noise::basis_of(stand.at.basis.rest(stand.whitener(columns)));
  const Eigen::VectorXd &r = stand.at.residual, tame = r.cwiseMax(-usual).cwiseMin(usual);
  const Eigen::VectorXd along = added.q.transpose() * r, left = r - added.q * along;
  return {r.array().square() - left.array().square(), (added.q.transpose() * tame).squaredNorm() / along.squaredNorm()};
}

// Whether it is an outlier for which a place was found: a gain of few readings, of which most is gone once they are
// tame, or so much that the rest is within chance.
bool of_outlier(const Bench& bench, const Candidate& c, const Winnings& winnings) {
  if (!from_few(bench, winnings.won)) return false;
  const double left = winnings.tame_share * winnings.won.sum();
  return winnings.tame_share < 0.5 || bench.log_p(c, left, c.width, true) > bench.threshold();
}

// The noise with the lead's columns inside; after a large effect also from scratch, since the old fit may be stuck.
noise::Fit fit_with(const Bench& bench, const Lead& lead, const Eigen::MatrixXd& both) {
  const bool large = lead.columns.cols() > 2 || lead.gain > 60;
  noise::Fit fit = bench.fitted(both, bench.fit.covariance, large ? 14 : 6);
  if (lead.gain <= 200) return fit;
  const auto start = noise::default_start(bench.y(), both, fit.covariance.family);
  const noise::Fit fresh = bench.fitted(both, start, 20);
  return fresh.value < fit.value ? fresh : fit;
}

// What the covariance itself says by these rows; of what is no place and changes little within longer ones, by those on
// more neighbours too.
double sure_log_p(const Bench& bench, const Lead& lead, const noise::Fit& fit, const Stand& stand) {
  const Candidate& c = lead.candidate();
  constexpr double enough = 0.6;
  double gain = stand.exact_gain(bench.field(), lead.columns);
  const FarRows::Question question{bench.y(), stand.design, lead.columns, fit.covariance};
  if (c.pieces.empty() && bench.far().kept(question, bench.field()) > enough) {
    gain = std::min(gain, bench.far().sure_gain(question));
    if (c.slow || c.kind == Kind::smooth) {
      const std::vector<noise::Family> families = bench.likely_families(fit.covariance.family);
      gain = std::min(gain, bench.far().profile_gain(question, bench.fit.covariance, families));
    }
  }
  const bool over_the_plan = c.kind == Kind::smooth || (c.pieces.empty() && bench.problem().places_known);
  if (over_the_plan) gain /= overdispersion;
  return bench.log_p(c, gain, lead.columns.cols(), true);
}

// The name must survive what is not known of the covariance, the lone transmitter and the clip.
Trial tried(const Bench& bench, const Lead& lead, const noise::Fit& fit, const Eigen::MatrixXd& design) {
  const Candidate& c = lead.candidate();
  const Stand stand = bench.stand(design, fit.covariance);
  Trial trial{c.id, c.label_of(lead.theta), gain_of(c, stand, lead.columns), 0, 0, false, ""};
  trial.log_p = bench.log_p(c, trial.gain, lead.columns.cols(), true);
  trial.integrated_log_p = trial.log_p;
  if (trial.log_p > -40)
    trial.integrated_log_p = integrated_log_p(bench, fit, design, lead.columns, log_tests(bench, c));
  if (c.whole) trial.integrated_log_p = std::max(trial.integrated_log_p, trial.log_p);  // not by a multiple of itself
  constexpr double beyond_doubt = -100;  // no approximation overstates so much
  if (trial.integrated_log_p <= bench.threshold() && trial.log_p > beyond_doubt)
    trial.integrated_log_p = std::max(trial.integrated_log_p, sure_log_p(bench, lead, fit, stand));
  trial.integrated_log_p += stand.skew_charge(lead.columns);
  const Winnings winnings = winnings_of(stand, lead.columns);
  if (!c.pieces.empty() && share_of_others(bench, winnings.won) < 0.08)
    trial.integrated_log_p += bench.options().one_radio_charge;
  if (c.level_like && bench.problem().bounds.any() &&
      !stands_clear_of_clip(bench, fit.covariance, design, lead.columns))
    trial.reason = like_clipping;
  else if (trial.integrated_log_p > bench.threshold())
    trial.reason = "not beyond chance";
  else if (of_outlier(bench, c, winnings))
    trial.reason = "rests on fewer than five readings";
  trial.accepted = trial.reason.empty();
  return trial;
}

// Places and times again, now that the noise is fitted beside them.
void refine_again(Bench& bench, std::size_t at) {
  if (bench.terms[at].smooth() || !bench.terms[at].candidate->refinable()) return;
  for (int round = 0; round < 3; ++round) {
    Term& term = bench.terms[at];
    const Stand stand = bench.stand(bench.design_without(term));
    Lead lead{&bench.entry_of(*term.candidate), term.theta, term.columns, stand.gain(term.columns), 0, 0, false, {}};
    const Lead better = refined(bench, stand, lead, true);
    if (better.gain < lead.gain + 2) return;
    term.theta = better.theta;
    term.columns = better.columns;
    bench.refit(4);
  }
}

// What an effect hides of the field shows once the effect is in the model: the family is chosen again.
void choose_family_again(Bench& bench) {
  constexpr double advantage = 2;  // nats to leave a family
  const Eigen::MatrixXd design = bench.design();
  noise::Fit best = bench.fit;
  for (const noise::Fit& other : bench.families) {
    if (other.covariance.family == bench.fit.covariance.family) continue;
    noise::Covariance start{other.covariance.family, bench.fit.covariance.theta};
    start.theta[1] += noise::log_scale_of(other.covariance.family) - noise::log_scale_of(bench.fit.covariance.family);
    const noise::Fit fit = bench.fitted(design, start, 12);
    if (fit.value < best.value - (best.covariance.family == bench.fit.covariance.family ? advantage : 0)) best = fit;
  }
  bench.fit = best;
}

void take(Bench& bench, const noise::Fit& fit, const Term& term) {
  bench.fit = fit;
  bench.terms.push_back(term);
  if (term.gain > 30) choose_family_again(bench);
}

// Rows of several readings end at the edges of each place, and it settles there.
void settle_at_their_edges(Bench& bench) {
  for (std::size_t k = 0; k < bench.terms.size(); ++k) {
    const Term term = bench.terms[k];
    if (term.smooth() || term.candidate->pieces.empty() || bench.end_rows_at(*term.candidate, term.theta) == 0)
      continue;
    bench.refit(4);
    settle(bench, k, false);
  }
}

// False if the lead fails.
bool enter(Bench& bench, Lead lead, Blocked& blocked, std::vector<Trial>& trials) {
  constexpr double beyond_doubt = -40;  // rows may end once it has settled
  const bool place = !lead.candidate().pieces.empty();
  if (place && lead.log_p > beyond_doubt && bench.end_rows_at(lead.candidate(), lead.theta) > 0)
    lead.columns = bench.columns_of(lead.candidate(), lead.theta);
  const Eigen::MatrixXd design = bench.design();
  const noise::Fit fit = fit_with(bench, lead, noise::hstack(design, lead.columns));
  trials.push_back(tried(bench, lead, fit, design));
  const Trial& trial = trials.back();
  if (!trial.accepted) {
    blocked.now.insert(trial.id);
    if (trial.reason == like_clipping) blocked.for_good.insert(trial.id);
    return false;
  }
  take(bench, fit,
       {lead.entry->candidate, lead.theta, lead.columns, trial.gain, lead.evidence, trial.integrated_log_p});
  blocked.now = blocked.for_good;
  const std::string pieces = bench.terms.back().candidate->pieces;
  if (pieces.empty()) {
    refine_again(bench, bench.terms.size() - 1);
    return true;
  }
  settle_places(bench);
  if (merge_pieces(bench, pieces)) {
    bench.refit();
    settle_places(bench);
  }
  settle_at_their_edges(bench);
  return true;
}

// Places that nearly pass, once rows end at their edges: that may be all they lack.
std::vector<Lead> closer_look(Bench& bench, const std::vector<Lead>& looked) {
  constexpr double lacks = 7;  // nats
  std::vector<Lead> places;
  for (const Lead& lead : looked) {
    if (lead.candidate().proposed && lead.log_p < bench.threshold() + lacks) places.push_back(lead);
  }
  Index more = 0;
  for (const Lead& lead : places) more += bench.end_rows_at(lead.candidate(), lead.theta);
  if (more == 0) return {};
  const Eigen::MatrixXd design = bench.design();
  bench.refit(4);
  for (Lead& lead : places) {
    lead.columns = bench.columns_of(lead.candidate(), lead.theta);
    const noise::Fit fit = fit_with(bench, lead, noise::hstack(design, lead.columns));
    lead = refined(bench, bench.stand(design, fit.covariance), lead, true);
  }
  by_evidence(places);
  return places;
}

void enter_as_stated(Bench& bench, const Lead& lead) {
  const Candidate& c = lead.candidate();
  const Eigen::MatrixXd design = bench.design();
  const noise::Fit fit = fit_with(bench, lead, noise::hstack(design, lead.columns));
  const double gain = gain_of(c, bench.stand(design, fit.covariance), lead.columns);
  Term term{lead.entry->candidate,
            lead.theta,
            lead.columns,
            gain,
            bench.evidence(c, gain, lead.columns.cols(), false),
            lead.log_p};
  term.as_stated = true;
  take(bench, fit, term);
  refine_again(bench, bench.terms.size() - 1);
}

bool usable(const Bench& bench, const Blocked& blocked, const Candidate& c) {
  if (blocked.now.count(c.id)) return false;
  return std::none_of(bench.terms.begin(), bench.terms.end(), [&](const Term& term) {
    const bool again = term.candidate->id == c.id && c.grid.size() == 1;
    return again || (term.smooth() && term.candidate->own() == c.own());
  });
}

}  // namespace

void forward(Bench& bench, std::vector<Trial>& trials) {
  Blocked blocked;
  std::size_t looked_closely = 0;  // with so many terms, and one
  const auto may_enter = [&](const Candidate& c) { return usable(bench, blocked, c); };
  for (int round = 0; round < 40; ++round) {
    if (!bench.terms.empty() && bench.problem().bounds.any()) bench.impute(4);
    const Eigen::MatrixXd design = bench.design();
    const Stand stand = bench.stand(design);
    bench.renew_depending(stand.coefficients(design.cols()));
    const std::vector<Lead> all = leads(bench, stand);
    if (static_cast<int>(bench.terms.size()) >= bench.options().most_terms) return;
    const auto passes = [&](const Lead& lead) { return lead.log_p < bench.threshold() && may_enter(lead.candidate()); };
    std::vector<Lead> passing;
    std::copy_if(all.begin(), all.end(), std::back_inserter(passing), passes);
    if (passing.empty()) {
      const std::vector<Lead> looked = second_look(bench, stand, all, may_enter);
      std::copy_if(looked.begin(), looked.end(), std::back_inserter(passing), passes);
      if (passing.empty() && looked_closely <= bench.terms.size()) {
        looked_closely = bench.terms.size() + 1;
        const std::vector<Lead> close = closer_look(bench, looked);
        const auto found = std::find_if(close.begin(), close.end(), passes);
        if (found != close.end()) {
          enter(bench, *found, blocked, trials);
          continue;
        }
      }
    }
    if (passing.empty()) {
      const Blocked only{blocked.for_good, blocked.for_good};
      const auto lead = stated_look(bench, [&](const Candidate& c) { return usable(bench, only, c); });
      if (!lead) return;
      enter_as_stated(bench, *lead);
      blocked.now = blocked.for_good;
      continue;
    }
    enter(bench, compared(bench, stand, passing, all, may_enter).front(), blocked, trials);
  }
}

}  // namespace muster::inference
