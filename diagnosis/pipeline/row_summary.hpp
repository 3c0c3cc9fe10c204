// Summarises the search's rows for reports: places, covariates, and residuals of the models.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"
#include "diagnosis/radio/links/link_model.hpp"
#include "diagnosis/radio/links/link_smooths.hpp"
#include "diagnosis/result.hpp"

namespace muster::diagnosis {

// Rows of twins as one row a direction, as a person reads them.
RowSummary row_summary(const inference::ModelState& state, const LinkLayout& layout, const LinkColumns& columns,
                       const LinkModel& model);
// Whitened residuals of rows the same way, still of unit variance.
Eigen::VectorXd white_by_stream(const noise::Rows& rows, const Eigen::VectorXd& white);

// dB that a finding adds to each row.
Eigen::VectorXd effect_of(const inference::ModelState& state, const inference::Candidate& candidate,
                          const inference::Finding& finding);

// The world's parameters with standard errors, beside the findings.
std::vector<WorldValue> world_values(const inference::ModelState& state, const std::vector<std::string>& paths,
                                     const Eigen::VectorXd& values, const LinkModel& model);

}  // namespace muster::diagnosis
