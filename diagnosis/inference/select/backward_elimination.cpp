#include "diagnosis/inference/select/backward_elimination.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/score/candidate_scores.hpp"
#include "diagnosis/inference/score/marginal_p_value.hpp"
#include "diagnosis/inference/select/alternatives.hpp"
#include "diagnosis/inference/select/relocate.hpp"
#include "diagnosis/inference/select/replace_smooths.hpp"
#include "diagnosis/inference/select/stays.hpp"
#include "diagnosis/inference/thresholds.hpp"

namespace muster::inference {
namespace {

// Drops the weakest term in turn, while its evidence beside the others is below one nat.
void drop_backward(ModelState& state) {
  while (state.terms.size() > 1) {
    measure_gains(state);
    const auto worst = std::min_element(state.terms.begin(), state.terms.end(),
                                        [](const Term& a, const Term& b) { return a.evidence < b.evidence; });
    if (worst->evidence >= thresholds::keep_term_nats) return;
    state.terms.erase(worst);
    state.refit();
  }
}

const Entry* named(const ModelState& state, const std::string& id) {
  for (const Entry& entry : state.entries()) {
    if (entry.candidate->id == id && entry.candidate->kind == Kind::named) return &entry;
  }
  return nullptr;
}

// True if an alternative may replace a term: a cause that is better, or inseparable from it and nearly as good. A
// smooth gives way only to a better cause of its covariate, or to one of the same effect: not to one in time, which a
// column that changes with time resembles by chance.
bool may_replace(const Term& term, const Alternative& alternative, const Candidate& other) {
  const bool better = alternative.evidence_gap <= -thresholds::clearly_nats,
             nearly = alternative.evidence_gap <= thresholds::nearly_nats;
  if (!term.smooth()) return better || (alternative.separability < thresholds::inseparable && nearly);
  const bool same = alternative.separability < thresholds::same_effect_separability && !other.role.time_like;
  return (better && other.role.replaces.count(term.candidate->own()) > 0) || (same && nearly);
}

// Replaces a cause by an alternative that has become better, or by one of fewer parameters that is as good. A drift
// that settles within seconds is a step.
void give_way_to_alternatives(ModelState& state) {
  const auto stands = [&](const Term& term) {
    return evidence_beside(state, state.design_without(term), *term.candidate, term.columns);
  };
  for (std::size_t k = 0; k < state.terms.size(); ++k) {
    double now = stands(state.terms[k]);
    for (const Alternative& alternative : alternatives_of(state, state.terms[k])) {
      const Entry* const entry = named(state, alternative.id);
      const bool there = std::any_of(state.terms.begin(), state.terms.end(), [&](const Term& term) {
        return term.candidate->id == alternative.id && term.candidate->label_of(term.theta) == alternative.label;
      });
      if (!entry || there || !may_replace(state.terms[k], alternative, *entry->candidate)) continue;
      // For two causes with the same effect only the cost of their search differs: no reason to prefer a name.
      const Term before = state.terms[k];
      const bool one = !before.smooth() && alternative.separability < thresholds::same_effect_separability &&
                       std::abs(alternative.evidence_gap) < thresholds::nearly_nats;
      const int fewer = before.candidate->role.parameters - entry->candidate->role.parameters;
      const bool plainer = fewer > 0 || (fewer == 0 && state.columns_of(*entry->candidate, alternative.theta).norm() >
                                                           thresholds::weaker_strength * before.columns.norm());
      if (one && !plainer) continue;
      const noise::Fit fit = state.fit;
      state.terms[k].candidate = entry->candidate;
      state.terms[k].theta = alternative.theta;
      state.terms[k].columns = state.columns_of(*entry->candidate, alternative.theta);
      state.refit();
      relocate(state, k, false);
      double may_lose = -thresholds::clearly_nats;
      if (before.smooth() ? alternative.separability < thresholds::same_effect_separability : one && plainer)
        may_lose = thresholds::nearly_nats;
      else if (!before.smooth() && alternative.separability < thresholds::inseparable && fewer > 0)
        may_lose = thresholds::clearly_nats;
      if (const double then = stands(state.terms[k]); then > now - may_lose) {
        now = then;
      } else {
        state.terms[k] = before;
        state.fit = fit;
      }
    }
  }
}

// The best cause that acts in time, beside the rest of the model.
std::optional<Term> best_in_time(ModelState& state, const Eigen::MatrixXd& rest) {
  const WhitenedModel model = state.whitened_model(rest);
  std::optional<Term> best;
  for (const ScoredCandidate& lead : scored_candidates(state, model)) {
    const Candidate& c = lead.candidate();
    if (c.kind != Kind::named || !c.role.time_like) continue;
    const ScoredCandidate at = refined(state, model, lead, true);
    if ((!best || at.evidence > best->evidence) && !is_chance_of_stays(state, c, at.columns, rest))
      best = Term{lead.entry->candidate, at.theta, at.columns, at.gain, at.evidence, 0};
  }
  return best;
}

// Replaces a smooth of a column that trends in time by a cause in time. It came first beside a field that had
// absorbed much of either; now each has a field of its own.
void give_way_to_time(ModelState& state) {
  for (std::size_t k = 0; k < state.terms.size(); ++k) {
    if (!state.terms[k].smooth() || !state.terms[k].candidate->role.observed) continue;
    const Term before = state.terms[k];
    const noise::Fit fit = state.fit;
    const Eigen::MatrixXd rest = state.design_without(state.terms[k]);
    const double now = evidence_beside(state, rest, *before.candidate, before.columns);
    const std::optional<Term> other = best_in_time(state, rest);
    if (!other) return;
    state.terms[k] = *other;
    state.refit();
    relocate(state, k, false);
    const double then = evidence_beside(state, rest, *other->candidate, state.terms[k].columns);
    if (then > now) continue;
    state.terms[k] = before;
    state.fit = fit;
  }
}

struct Company {
  double strongest = 0;     // gain of the strongest term
  double smooths = 0;       // joint gain of all smooths
  double stronger_kin = 0;  // gain of the strongest stronger term on the same covariate
};

// True for residual artifacts of strong terms, which are not named.
bool is_residual_artifact(const Term& term, const Company& company, bool clipped) {
  const bool named = !term.smooth(), place = !term.candidate->role.pieces.empty() || term.candidate->role.over_sites;
  if (term.gain < thresholds::artefact_share_of_kin * company.stronger_kin) return true;
  if (place && term.gain < std::min(thresholds::artefact_place_gain,
                                    thresholds::artefact_place_share_of_kin * company.stronger_kin))
    return true;
  if (named && term.gain < thresholds::artefact_share_of_smooths * company.smooths) return true;
  if (named &&
      term.gain < std::min(thresholds::artefact_gain, thresholds::artefact_share_of_strongest * company.strongest))
    return true;
  return clipped && (term.candidate->refinement.proposed || !named) &&
         term.gain < thresholds::artefact_gain_beside_clip;  // residuals of clipping fit some place by chance
}

void set_artifacts_aside(ModelState& state, std::vector<Term>& aside) {
  // Clipping counts as a strong term, though not one of the search.
  if (state.terms.size() + state.problem().bounds.any() < 2) return;
  measure_gains(state);
  Company all;
  Eigen::MatrixXd smooths(state.rows().size(), 0);
  for (const Term& term : state.terms) {
    all.strongest = std::max(all.strongest, term.gain);
    if (term.smooth()) smooths = noise::hstack(smooths, term.columns);
  }
  if (smooths.cols())
    all.smooths = state.whitened_model(state.design([](const Term& t) { return t.smooth(); })).gain(smooths);
  std::vector<Term> kept;
  for (const Term& term : state.terms) {
    Company company = all;
    for (const Term& other : state.terms) {
      if (other.candidate->own() == term.candidate->own() && other.gain > term.gain)
        company.stronger_kin = std::max(company.stronger_kin, other.gain);
    }
    (is_residual_artifact(term, company, state.problem().bounds.any()) ? aside : kept).push_back(term);
  }
  state.terms = std::move(kept);
}

// Rows that both terms concern, over those that one of them does (Jaccard 1912).
double overlap(const Term& term, const Term& other) {
  const auto concerned = [](const Term& t) { return (t.columns.array() != 0).rowwise().any().eval(); };
  const auto one = concerned(term), two = concerned(other);
  return static_cast<double>((one && two).count()) / static_cast<double>(std::max<Index>((one || two).count(), 1));
}

// Withdraws names beside a smooth of their own covariate on the same rows: each would be one more guess at the same
// structure. A withdrawn name does not count as such a smooth, or the order of the terms would decide which names
// remain.
void withdraw_names_beside_smooths(ModelState& state) {
  const auto beside_smooth = [&](const Term& term) {
    return std::any_of(state.terms.begin(), state.terms.end(), [&](const Term& other) {
      return other.candidate->kind == Kind::smooth && other.candidate->own() == term.candidate->own() &&
             overlap(term, other) > thresholds::same_rows_share;
    });
  };
  for (Term& term : state.terms) {
    if (!term.smooth()) term.as_smooth = beside_smooth(term);
  }
}

// True for terms that give one name to one row, if it is no place.
bool same_name(const Term& term, const Term& other) {
  const auto name = [](const Term& t) { return std::pair(t.candidate->id, t.candidate->label_of(t.theta)); };
  return !term.smooth() && !other.smooth() && term.candidate->role.pieces.empty() && name(other) == name(term);
}

// True if a term alone explains most of what all terms of its name do: the others are what its linear effect leaves
// over, such as that of a place beside parameters of the model that are not yet right.
bool leads_its_like(const ModelState& state, const Term& term) {
  const auto alike = [&](const Term& other) { return same_name(term, other); };
  Eigen::MatrixXd columns(state.rows().size(), 0);
  for (const Term& other : state.terms) {
    if (alike(other)) columns = noise::hstack(columns, other.columns);
  }
  const WhitenedModel model = state.whitened_model(state.design(alike));
  return gain_of(*term.candidate, model, term.columns) > thresholds::leading_share * model.gain(columns);
}

// Withdraws a cause named twice on the same row, but for one that leads: else neither is right.
void withdraw_names_given_twice(ModelState& state) {
  std::vector<bool> withdrawn;
  for (const Term& term : state.terms) {
    const bool twice = std::count_if(state.terms.begin(), state.terms.end(),
                                     [&](const Term& other) { return same_name(term, other); }) > 1;
    withdrawn.push_back(twice && !leads_its_like(state, term));
  }
  for (std::size_t k = 0; k < state.terms.size(); ++k)
    state.terms[k].as_smooth = state.terms[k].as_smooth || withdrawn[k];
}

// Withdraws a name if much structure is left along its own covariate: it is only a part of the effect.
void withdraw_names_of_parts(ModelState& state) {
  const WhitenedModel model = state.whitened_model(state.design());
  for (const Entry& entry : state.entries()) {
    const Candidate& smooth = *entry.candidate;
    const auto concerns = [&](const Term& term) {
      return !term.smooth() && !term.candidate->design.whole && term.candidate->own() == smooth.own();
    };
    if (smooth.kind != Kind::smooth || std::none_of(state.terms.begin(), state.terms.end(), concerns)) continue;
    const double left = gains(smooth, unit_atoms(entry, model), model.at.residual).maxCoeff();
    if (state.log_p(smooth, left, smooth.design.width, false) > std::log(thresholds::left_alpha)) continue;
    for (Term& term : state.terms)
      term.as_smooth = term.as_smooth || (concerns(term) && left > thresholds::left_share * term.gain);
  }
}

// Tests each name again, beside all the others.
void test_each(ModelState& state, std::vector<Term>& aside, std::vector<Trial>& trials) {
  const double threshold = std::log(state.options().further_alpha / static_cast<double>(state.entries().size()));
  for (std::size_t k = 0; k < state.terms.size() && state.terms.size() > 1;) {
    const Term term = state.terms[k];
    const Candidate& c = *term.candidate;
    const Eigen::MatrixXd rest = state.design_without(state.terms[k]);
    const WhitenedModel model = state.whitened_model(rest);
    const double gain = model.gain(term.columns);
    const double log_p = state.log_p(c, gain, term.columns.cols(), true);
    if (term.smooth() || term.as_stated || log_p < thresholds::log_p_beyond_noise) {
      ++k;
      continue;
    }
    // The fit of the whole design, with its columns reordered: the value is the same.
    const double skew = model.skew_charge(term.columns), tests = log_tests(state, c);
    double integrated = skew + marginal_log_p(state, state.fit, rest, term.columns, tests);
    if (integrated <= threshold)
      integrated = std::max(
          integrated, skew + marginal_log_p_elsewhere(state, state.fit, rest, term.columns, tests, threshold - skew));
    if (integrated <= threshold) {
      ++k;
      continue;
    }
    trials.push_back(
        {c.id, c.label_of(term.theta), gain, log_p, integrated, false, "not beyond chance beside the others"});
    aside.push_back(term);
    state.terms.erase(state.terms.begin() + static_cast<std::ptrdiff_t>(k));
    state.refit();
  }
}

}  // namespace

void measure_gains(ModelState& state) {
  for (Term& term : state.terms) {
    const WhitenedModel rest = state.whitened_model(state.design_without(term));
    term.gain = term.candidate->design.whole ? rest.gain(term.columns) : gain_of(*term.candidate, rest, term.columns);
    term.evidence = state.evidence(*term.candidate, term.gain, term.columns.cols(), false);
  }
}

std::vector<Term> backward_elimination(ModelState& state, std::vector<Trial>& trials) {
  std::vector<Term> aside;
  drop_backward(state);
  replace_smooths(state);
  give_way_to_time(state);
  give_way_to_alternatives(state);
  set_artifacts_aside(state, aside);
  withdraw_names_beside_smooths(state);
  if (!state.terms.empty()) state.refit();
  test_each(state, aside, trials);
  measure_gains(state);
  withdraw_names_given_twice(state);
  withdraw_names_of_parts(state);
  withdraw_names_beside_smooths(state);
  std::stable_sort(state.terms.begin(), state.terms.end(),
                   [](const Term& a, const Term& b) { return a.gain > b.gain; });
  return aside;
}

}  // namespace muster::inference
