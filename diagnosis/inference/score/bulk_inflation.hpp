// Inflation of gains by what no noise model holds (genomic control: Devlin and Roeder, Biometrics 55, 1999). Beside a
// lead nearly all atoms of its kind are irrelevant, so their gains are those of the null. Where the bulk of them is
// higher, the lead's own gain is too high by the same factor.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

// Factor by which gains of candidates along the lead's covariate, on the lead's rows, exceed those of white noise:
// median over median, above the range of chance; at least 1. `model`: with the lead's columns in its design.
double bulk_inflation(const ModelState& state, const WhitenedModel& model, const Candidate& lead,
                      const Eigen::MatrixXd& columns);

}  // namespace muster::inference
