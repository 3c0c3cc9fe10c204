#include "diagnosis/inference/select/relocate.hpp"

#include "diagnosis/inference/score/candidate_scores.hpp"
#include "diagnosis/inference/thresholds.hpp"

namespace muster::inference {
namespace {

ScoredCandidate at_term(const ModelState& state, const WhitenedModel& model, const Term& term) {
  const double gain = model.gain(term.columns);
  return {&state.entry_of(*term.candidate),
          term.theta,
          term.columns,
          gain,
          state.evidence(*term.candidate, gain, term.columns.cols(), true),
          0,
          true,
          {}};
}

ScoredCandidate from_grid(const ModelState& state, const WhitenedModel& model, const Entry& entry) {
  const Candidate& c = *entry.candidate;
  ScoredCandidate lead{&entry, {}, {}, 0, 0, 0, false, gains(c, unit_atoms(entry, model), model.at.residual)};
  Index best = 0;
  lead.gain = lead.all.maxCoeff(&best);
  lead.theta = c.design.grid[static_cast<std::size_t>(best)];
  lead.columns = entry.atom(best);
  return refined(state, model, lead, false);
}

}  // namespace

void relocate(ModelState& state, std::size_t at, bool anew) {
  for (int round = 0; round < 3; ++round) {
    Term& term = state.terms[at];
    const WhitenedModel model = state.whitened_model(state.design_without(term));
    const ScoredCandidate before = at_term(state, model, term);
    ScoredCandidate best = refined(state, model, before, true);
    for (const Entry& entry : state.entries()) {
      if (!anew || round > 0 || entry.candidate->role.pieces != term.candidate->role.pieces) continue;
      ScoredCandidate other = from_grid(state, model, entry);
      if (other.evidence > best.evidence) best = std::move(other);
    }
    if (best.evidence < before.evidence + thresholds::relocation_nats) return;
    term.candidate = best.entry->candidate;
    term.theta = best.theta;
    term.columns = best.columns;
    state.refit(4);
  }
}

void relocate_places(ModelState& state) {
  for (std::size_t k = 0; k < state.terms.size(); ++k) {
    if (!state.terms[k].smooth() && !state.terms[k].candidate->role.pieces.empty()) relocate(state, k, true);
  }
}

}  // namespace muster::inference
