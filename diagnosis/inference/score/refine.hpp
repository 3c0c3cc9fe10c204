// Continuous refinement of one atom.
#pragma once

#include "diagnosis/inference/state/candidate.hpp"

namespace muster::inference {

using Value = std::function<double(const Eigen::VectorXd& theta)>;

// A theta and its value.
using Optimum = std::pair<Eigen::VectorXd, double>;

// Maximises from `start` within the candidate's bounds; entries with step 0 are held. Unimodal candidates:
// Nelder-Mead simplex with bounds (Box 1965), by NLopt. Multimodal ones: a (1+1) evolution strategy (Rechenberg's
// one-fifth rule), restarted when its steps have become short.
Optimum local_search(const Candidate& candidate, const Eigen::VectorXd& start, int evaluations, const Value& value);

// Successive halving: refines from several starts in rounds with growing budgets, each with its own objective, and
// keeps the better half after each.
Optimum successive_halving(const Candidate& candidate, const std::vector<Eigen::VectorXd>& starts,
                           const std::vector<Value>& laps);

// Preconditioned moves at theta, as columns; without any, one column for each step.
Eigen::MatrixXd moves_at(const Candidate& candidate, const Eigen::VectorXd& theta);

}  // namespace muster::inference
