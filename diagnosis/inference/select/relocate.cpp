#include "diagnosis/inference/select/relocate.hpp"

#include "diagnosis/inference/score/candidate_scores.hpp"

namespace muster::inference {
namespace {

Lead at_term(const Bench& bench, const Stand& stand, const Term& term) {
  const double gain = stand.gain(term.columns);
  return {&bench.entry_of(*term.candidate),
          term.theta,
          term.columns,
          gain,
          bench.evidence(*term.candidate, gain, term.columns.cols(), true),
          0,
          true,
          {}};
}

Lead from_grid(const Bench& bench, const Stand& stand, const Entry& entry) {
  const Candidate& c = *entry.candidate;
  Lead lead{&entry, {}, {}, 0, 0, 0, false, gains(c, unit_atoms(entry, stand), stand.at.residual)};
  Index best = 0;
  lead.gain = lead.all.maxCoeff(&best);
  lead.theta = c.grid[static_cast<std::size_t>(best)];
  lead.columns = entry.atom(best);
  return refined(bench, stand, lead, false);
}

}  // namespace

void settle(Bench& bench, std::size_t at, bool anew) {
  constexpr double worth = 1;  // nats
  for (int round = 0; round < 3; ++round) {
    Term& term = bench.terms[at];
    const Stand stand = bench.stand(bench.design_without(term));
    const Lead before = at_term(bench, stand, term);
    Lead best = refined(bench, stand, before, true);
    for (const Entry& entry : bench.entries()) {
      if (!anew || round > 0 || entry.candidate->pieces != term.candidate->pieces) continue;
      Lead other = from_grid(bench, stand, entry);
      if (other.evidence > best.evidence) best = std::move(other);
    }
    if (best.evidence < before.evidence + worth) return;
    term.candidate = best.entry->candidate;
    term.theta = best.theta;
    term.columns = best.columns;
    bench.refit(4);
  }
}

void settle_places(Bench& bench) {
  for (std::size_t k = 0; k < bench.terms.size(); ++k) {
    if (!bench.terms[k].smooth() && !bench.terms[k].candidate->pieces.empty()) settle(bench, k, true);
  }
}

}  // namespace muster::inference
