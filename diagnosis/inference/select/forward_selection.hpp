// Forward selection: the best candidate that passes enters, round by round.
#pragma once

#include <set>

#include "diagnosis/inference/score/candidate_scores.hpp"

namespace muster::inference {

// What was tried and how it fared, for the report.
struct Trial {
  std::string id, label;
  double gain = 0, log_p = 0, integrated_log_p = 0;  // with the noise fitted beside it
  bool accepted = false;
  std::string reason;  // why not
};

// Adds terms to the bench until nothing passes.
void forward(Bench& bench, std::vector<Trial>& trials);

}  // namespace muster::inference
