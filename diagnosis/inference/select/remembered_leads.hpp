// Leads as they were worked out beside one model. A lead that fails leaves the model as it was, and the next round asks
// for all the others again.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "diagnosis/inference/score/candidate_scores.hpp"

namespace muster::inference {

class RememberedLeads {
 public:
  // What `work` makes of the lead; done once.
  template <class Work>
  ScoredCandidate worked_out(const ScoredCandidate& lead, const Work& work) {
    for (const auto& [from, to] : known_) {
      if (same(from, lead)) return to;
    }
    return known_.emplace_back(lead, work(lead)).second;
  }

 private:
  static bool same(const ScoredCandidate& a, const ScoredCandidate& b) {
    return a.entry == b.entry && a.theta == b.theta && a.gain == b.gain && a.log_p == b.log_p &&
           a.evidence == b.evidence && a.refined == b.refined && a.all.size() == b.all.size();
  }

  std::vector<std::pair<ScoredCandidate, ScoredCandidate>> known_;
};

// All of one model.
struct RememberedRound {
  RememberedLeads refined, refitted;                   // at the model's covariance; with one of their own
  std::optional<std::vector<ScoredCandidate>> ladder;  // of the candidates that were usable first
};

}  // namespace muster::inference
