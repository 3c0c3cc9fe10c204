// Named causes as candidates of a search: the columns that their plugins add, over grids of rows, places, times and
// shapes.
#pragma once

#include "diagnosis/causes/cause_domain.hpp"
#include "diagnosis/inference/noise/rows.hpp"

namespace muster::diagnosis {

// The same candidate at the readings of another table, such as one that could be measured.
inference::Candidate at_readings_of(const CauseCandidate& cause, const CauseSources& sources);

// Candidates of those causes that shift the expected value. Columns that no reading depends on, or that the base model
// can take up, are left out. `rows`: of the search.
CauseSearch cause_candidates(const std::vector<Cause>& causes, const CauseDomain& domain, const CauseSources& sources,
                             const Eigen::MatrixXd& base, const noise::Rows& rows);
// False for causes that clip readings or change their scatter.
bool shifts_levels(const Cause& cause);

}  // namespace muster::diagnosis
