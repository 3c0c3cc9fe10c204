// Forward selection: the best candidate that passes enters, round by round.
#pragma once

#include <set>

#include "diagnosis/inference/score/candidate_scores.hpp"

namespace muster::inference {

// One candidate's test and its outcome, for the report.
struct Trial {
  std::string id, label;
  double gain = 0, log_p = 0, marginal_log_p = 0;  // with the noise fitted beside it
  bool accepted = false;
  std::string reason;       // of the rejection
  bool of_stays = false;    // it may be how stays differ by chance
  double inflation = 1;     // of gains of its kind in these data (score/bulk_inflation.hpp)
  bool of_outlier = false;  // it rests on fewer than five readings
};

// Adds terms to the model until no candidate passes.
void forward_selection(ModelState& state, std::vector<Trial>& trials);

}  // namespace muster::inference
