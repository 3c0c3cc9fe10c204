#include "diagnosis/inference/select/replace_smooths.hpp"

#include <algorithm>
#include <optional>

#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/score/candidate_scores.hpp"
#include "diagnosis/inference/score/marginal_p_value.hpp"
#include "diagnosis/inference/thresholds.hpp"

namespace muster::inference {
namespace {

struct Replacement {
  ModelState& state;
  std::string covariate;
  Eigen::MatrixXd rest;  // design without the covariate's terms
  double group_gain;     // of those terms
  Index group_width;     // their number of functions

  Eigen::MatrixXd with(const std::vector<Term>& found, const Term* without = nullptr) const {
    Eigen::MatrixXd result = rest;
    for (const Term& term : found) {
      if (&term != without) result = noise::hstack(result, term.columns);
    }
    return result;
  }

  // The cause with most evidence beside those already found; the second one must share a covariate.
  std::optional<Term> best(const std::vector<Term>& found) const {
    const WhitenedModel model = state.whitened_model(with(found));
    std::optional<Term> result;
    for (const ScoredCandidate& lead : scored_candidates(state, model)) {
      const Candidate& c = lead.candidate();
      if (c.kind != Kind::named || !fits(lead, found)) continue;
      const bool promising = lead.gain > thresholds::replacement_share * group_gain && c.role.pieces.empty();
      const ScoredCandidate at = promising ? refined(state, model, lead, true) : lead;
      const double evidence = state.evidence(c, at.gain, c.design.width, false);
      if (!result || evidence > result->evidence)
        result = Term{lead.entry->candidate, at.theta, at.columns, at.gain, evidence, 0};
    }
    return result;
  }

  // True for the same cause on another row too.
  bool fits(const ScoredCandidate& lead, const std::vector<Term>& found) const {
    if (found.empty()) return true;
    const Candidate &c = lead.candidate(), &first = *found[0].candidate;
    if (c.id == first.id) return c.label_of(lead.theta) != first.label_of(found[0].theta);
    return c.own() == covariate || c.own() == first.own();
  }

  // Refines two causes that share an effect in turn, each beside the other.
  void refine_in_turn(std::vector<Term>& found) const {
    for (int round = 0; round < 2; ++round) {
      for (Term& term : found) {
        if (!term.candidate->role.pieces.empty() || !term.candidate->refinement.any()) continue;
        const WhitenedModel model = state.whitened_model(with(found, &term));
        ScoredCandidate lead{
            &state.entry_of(*term.candidate), term.theta, term.columns, model.gain(term.columns), 0, 0, false, {}};
        lead = refined(state, model, lead, true);
        term.theta = lead.theta;
        term.columns = lead.columns;
      }
    }
  }

  // The replacing causes; empty if the smooth remains.
  std::vector<Term> found() const {
    std::vector<Term> result;
    for (int number = 1; number <= 2; ++number) {
      std::optional<Term> next = best(result);
      if (!next || next->evidence < thresholds::replacement_nats) return {};
      if (number == 1 && next->candidate->role.replaces.count(covariate) == 0) return {};
      result.push_back(std::move(*next));
      if (number == 2) refine_in_turn(result);
      const Eigen::MatrixXd all = with(result).rightCols(with(result).cols() - rest.cols());
      // Each further function of the smooths gains one by chance.
      const auto by_chance = static_cast<double>(std::max<Index>(0, group_width - all.cols()));
      if (state.whitened_model(rest).gain(all) >= state.options().share * (group_gain - by_chance)) return result;
    }
    return {};
  }
};

}  // namespace

void replace_smooths(ModelState& state) {
  std::vector<std::string> covariates;
  for (const Term& term : state.terms) {
    if (term.smooth() && std::find(covariates.begin(), covariates.end(), term.candidate->own()) == covariates.end())
      covariates.push_back(term.candidate->own());
  }
  for (const std::string& covariate : covariates) {
    const auto in_group = [&](const Term& term) { return term.candidate->own() == covariate; };
    const bool has_names = std::any_of(state.entries().begin(), state.entries().end(), [&](const Entry& entry) {
      return entry.candidate->role.replaces.count(covariate) > 0;
    });
    if (!has_names) continue;
    Eigen::MatrixXd group(state.rows().size(), 0);
    for (const Term& term : state.terms) {
      if (in_group(term)) group = noise::hstack(group, term.columns);
    }
    const Eigen::MatrixXd rest = state.design(in_group);
    const Replacement replacement{state, covariate, rest, state.whitened_model(rest).gain(group), group.cols()};
    const std::vector<Term> found = replacement.found();
    // Names beside the smooth on the same covariate are removed in either case: they were guesses at the same
    // structure.
    std::erase_if(state.terms, [&](const Term& term) { return in_group(term) && (!term.smooth() || !found.empty()); });
    state.terms.insert(state.terms.end(), found.begin(), found.end());
    state.refit();
  }
}

}  // namespace muster::inference
