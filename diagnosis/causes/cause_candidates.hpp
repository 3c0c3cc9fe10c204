// Named causes as candidates of the search: over which rows, places, times and shapes each is sought, and how what was
// found reads as attributes of its plugin.
#pragma once

#include "diagnosis/causes/cause_shape.hpp"
#include "diagnosis/inference/noise/rows.hpp"
#include "diagnosis/radio/links/measurement_geometry.hpp"

namespace muster::diagnosis {

// The same candidate at the readings of another table, such as one that could be measured; of `sources` their run and
// rows are asked.
inference::Candidate at_readings_of(const CauseCandidate& cause, const CauseSources& sources);

// Of those causes that shift the expected level. Columns that no reading depends on, or that the base model can take
// up, are left out. `rows`: of the search.
CauseSearch cause_candidates(const std::vector<Cause>& causes, const Survey& survey, const CauseSources& sources,
                             const Eigen::MatrixXd& base, const noise::Rows& rows);
// Whether it shifts the expected level; what does not clips readings or changes how they scatter.
bool shifts_levels(const Cause& cause);

}  // namespace muster::diagnosis
