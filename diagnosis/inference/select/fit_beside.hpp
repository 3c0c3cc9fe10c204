#pragma once

#include "diagnosis/inference/score/candidate_scores.hpp"

namespace muster::inference {

// The noise with the lead's columns inside (`both`: the design with them); after a large effect also from scratch,
// since the old fit may be a local optimum.
noise::Fit fit_beside(const ModelState& state, const ScoredCandidate& lead, const Eigen::MatrixXd& both);

}  // namespace muster::inference
