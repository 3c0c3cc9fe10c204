#include "diagnosis/inference/select/merge_duplicates.hpp"

#include <algorithm>

#include "diagnosis/inference/score/candidate_scores.hpp"
#include "diagnosis/inference/score/refine.hpp"

namespace muster::inference {
namespace {

// The best single object of one candidate: from its own pieces, from thetas that span several, or from its grid.
ScoredCandidate single(const ModelState& state, const WhitenedModel& model, const Entry& entry,
                       const std::vector<Piece>& found) {
  const Candidate& c = *entry.candidate;
  std::vector<Eigen::VectorXd> starts;
  for (const Piece& piece : found) {
    if (piece.id == c.id) starts.push_back(piece.theta);
  }
  if (c.role.spanning) {
    for (Eigen::VectorXd& theta : c.role.spanning(found)) starts.push_back(std::move(theta));
  }
  ScoredCandidate lead{&entry, {}, {}, 0, 0, 0, false, gains(c, unit_atoms(entry, model), model.at.residual)};
  Index at = 0;
  lead.gain = lead.all.maxCoeff(&at);
  lead.theta = c.design.grid[static_cast<std::size_t>(at)];
  lead.columns = entry.atom(at);
  ScoredCandidate best = refined(state, model, lead, false);
  for (const Eigen::VectorXd& theta : starts) {
    lead.theta = theta;
    lead.columns = state.columns_of(c, theta);
    const ScoredCandidate other = refined(state, model, lead, true);
    if (other.gain > best.gain) best = other;
  }
  return best;
}

}  // namespace

bool merge_pieces(ModelState& state, const std::string& pieces) {
  const auto of_class = [&](const Term& term) { return term.candidate->role.pieces == pieces; };
  std::vector<Piece> found;
  Eigen::MatrixXd columns(state.rows().size(), 0);
  for (const Term& term : state.terms) {
    if (!of_class(term)) continue;
    found.push_back({term.candidate->id, term.theta});
    columns.conservativeResize(Eigen::NoChange, columns.cols() + term.columns.cols());
    columns.rightCols(term.columns.cols()) = term.columns;
  }
  if (found.size() < 2) return false;
  const WhitenedModel model = state.whitened_model(state.design(of_class));
  const double all = model.gain(columns);
  const Entry* chosen = nullptr;
  ScoredCandidate best{};
  for (const Entry& entry : state.entries()) {
    if (entry.candidate->role.pieces != pieces) continue;
    ScoredCandidate lead = single(state, model, entry, found);
    if (chosen && lead.gain <= best.gain) continue;
    chosen = &entry;
    best = std::move(lead);
  }
  if (!chosen || best.gain < state.options().merge_share * all) return false;
  std::erase_if(state.terms, of_class);
  state.terms.push_back({chosen->candidate, best.theta, best.columns, best.gain, best.evidence, best.log_p});
  return true;
}

}  // namespace muster::inference
