// A place that a single standing radio sees. Its shadow shows how wide it is, and not how far off: a small thing nearby
// and a large one far away take the same links.
#pragma once

#include <optional>
#include <vector>

#include "diagnosis/causes/cause_shape.hpp"
#include "diagnosis/inference/assess/finding.hpp"
#include "diagnosis/result.hpp"

namespace muster::diagnosis {

// Middles of the finding's place over its posterior samples, in the plan, m. Empty without a place or without samples.
std::vector<Eigen::Vector2d> places_of(const CauseShape& shape, const inference::Finding& finding);

// What the only standing radio on the links of an effect leaves open. Nothing if there are two, or if the distance is
// known within a factor of 1.5. `effect`: dB of each row; `places`: equally likely ones.
std::optional<OneStation> seen_from_one_station(const RowSummary& seen, const Eigen::VectorXd& effect,
                                                const std::vector<Eigen::Vector2d>& places);

}  // namespace muster::diagnosis
