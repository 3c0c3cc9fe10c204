#include "diagnosis/inference/select/merge_duplicates.hpp"

#include <algorithm>

#include "diagnosis/inference/score/candidate_scores.hpp"
#include "diagnosis/inference/score/refine.hpp"

namespace muster::inference {
namespace {

// The best single object of one candidate: from the pieces that it found, from thetas that span several, from its grid.
Lead single(const Bench& bench, const Stand& stand, const Entry& entry, const std::vector<Piece>& found) {
  const Candidate& c = *entry.candidate;
  std::vector<Eigen::VectorXd> starts;
  for (const Piece& piece : found) {
    if (piece.id == c.id) starts.push_back(piece.theta);
  }
  if (c.spanning) {
    for (Eigen::VectorXd& theta : c.spanning(found)) starts.push_back(std::move(theta));
  }
  Lead lead{&entry, {}, {}, 0, 0, 0, false, gains(c, unit_atoms(entry, stand), stand.at.residual)};
  Index at = 0;
  lead.gain = lead.all.maxCoeff(&at);
  lead.theta = c.grid[static_cast<std::size_t>(at)];
  lead.columns = entry.atom(at);
  Lead best = refined(bench, stand, lead, false);
  for (const Eigen::VectorXd& theta : starts) {
    lead.theta = theta;
    lead.columns = bench.columns_of(c, theta);
    const Lead other = refined(bench, stand, lead, true);
    if (other.gain > best.gain) best = other;
  }
  return best;
}

}  // namespace

bool merge_pieces(Bench& bench, const std::string& pieces) {
  const auto of_class = [&](const Term& term) { return term.candidate->pieces == pieces; };
  std::vector<Piece> found;
  Eigen::MatrixXd columns(bench.rows().size(), 0);
  for (const Term& term : bench.terms) {
    if (!of_class(term)) continue;
    found.push_back({term.candidate->id, term.theta});
    columns.conservativeResize(Eigen::NoChange, columns.cols() + term.columns.cols());
    columns.rightCols(term.columns.cols()) = term.columns;
  }
  if (found.size() < 2) return false;
  const Stand stand = bench.stand(bench.design(of_class));
  const double all = stand.gain(columns);
  const Entry* chosen = nullptr;
  Lead best{};
  for (const Entry& entry : bench.entries()) {
    if (entry.candidate->pieces != pieces) continue;
    Lead lead = single(bench, stand, entry, found);
    if (chosen && lead.gain <= best.gain) continue;
    chosen = &entry;
    best = std::move(lead);
  }
  if (!chosen || best.gain < bench.options().merge_share * all) return false;
  std::erase_if(bench.terms, of_class);
  bench.terms.push_back({chosen->candidate, best.theta, best.columns, best.gain, best.evidence, best.log_p});
  return true;
}

}  // namespace muster::inference
