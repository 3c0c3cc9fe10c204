// What a search looked at, for reports: rows with their places, and what the models leave of them.
#pragma once

#include "diagnosis/model.hpp"
#include "diagnosis/result.hpp"
#include "diagnosis/search/bench.hpp"

namespace muster::diagnosis {

SeenRows seen_rows(const search::Bench& bench, const LinkModel& model);

// dB that a finding adds to each row.
Eigen::VectorXd effect_of(const search::Bench& bench, const search::Candidate& candidate,
                          const search::Finding& finding);

// The world's parameters with their spread beside the findings.
std::vector<WorldValue> world_values(const search::Bench& bench, const std::vector<std::string>& paths,
                                     const Eigen::VectorXd& values, const LinkModel& model);

}  // namespace muster::diagnosis
