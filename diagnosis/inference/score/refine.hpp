// Continuous refinement of one atom.
#pragma once

#include "diagnosis/inference/state/candidate.hpp"

namespace muster::inference {

using Value = std::function<double(const Eigen::VectorXd& theta)>;

// A theta and its value.
using Top = std::pair<Eigen::VectorXd, double>;

// The largest value that a search from `start` meets, inside the candidate's bounds; entries with step 0 stay. Where
// there is one top, Nelder and Mead's simplex (Box 1965), by NLopt; where there are many, random strides that grow
// with success and shrink without (Rechenberg's rule of one in five), and begin anew when they have become short.
Top climbed(const Candidate& candidate, const Eigen::VectorXd& start, int evaluations, const Value& value);

// From several starts, a race in laps, each with a value of its own and more evaluations than the one before; after
// each the better half goes on.
Top raced(const Candidate& candidate, const std::vector<Eigen::VectorXd>& starts, const std::vector<Value>& laps);

// The candidate's moves at theta: its own, or one column a step.
Eigen::MatrixXd moves_at(const Candidate& candidate, const Eigen::VectorXd& theta);

}  // namespace muster::inference
