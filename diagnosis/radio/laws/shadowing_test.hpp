// Tests the world's stated size and decorrelation distance of shadowing.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"
#include "diagnosis/radio/laws/fading_tests.hpp"

namespace muster::diagnosis {

// Likelihood-ratio test of the field fitted to rows against one with the stated size and distance. Single readings
// determine the correlation at short range, rows the long range: the smaller of both gains counts. The world states
// no family of correlations; each likelihood uses its best one. `law`: of a reading. The
// values of the test are size and distance.
LawTest field_test(KrigedReadings& field, double step, const ReadingDistribution& law, const noise::StatedField& stated,
                   const inference::ModelState& state);

// Covariance fitted to row means, here of a draw of the world's own shadowing.
noise::Covariance fitted_to(const inference::ModelState& state, const Eigen::VectorXd& row_means);

}  // namespace muster::diagnosis
