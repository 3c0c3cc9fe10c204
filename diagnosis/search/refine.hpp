// Continuous refinement of one atom: Nelder and Mead's simplex inside bounds (Box 1965), by NLopt.
#pragma once

#include "diagnosis/search/candidate.hpp"

namespace muster::search {

// The theta with the largest value that a search from `start` meets, and the value. Entries with step 0 stay.
std::pair<Eigen::VectorXd, double> climbed(const Candidate& candidate, const Eigen::VectorXd& start, int evaluations,
                                           const std::function<double(const Eigen::VectorXd&)>& value);

}  // namespace muster::search
