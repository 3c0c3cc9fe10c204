// Builds search candidates from named causes: their plugins' columns over grids of rows, places, times and shapes.
#pragma once

#include "diagnosis/causes/cause_domain.hpp"
#include "diagnosis/inference/noise/rows.hpp"

namespace muster::diagnosis {

// The same candidate at the readings of another table, such as a planned one.
inference::Candidate at_readings_of(const CauseCandidate& cause, const CauseSources& sources);

// Candidates of the causes that shift the expected level. Left out: columns that concern too few readings or lie in the
// span of the base model's columns. `rows`: of the search.
CauseSearch cause_candidates(const std::vector<Cause>& causes, const CauseDomain& domain, const CauseSources& sources,
                             const Eigen::MatrixXd& base, const noise::Rows& rows);
// False for causes that clip readings, change their scatter, or are judged in worlds of their own.
bool shifts_levels(const Cause& cause);

}  // namespace muster::diagnosis
