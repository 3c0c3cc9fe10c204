// Whether shadowing has the size and the decorrelation distance that the world says.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"
#include "diagnosis/radio/laws/fading_tests.hpp"
#include "diagnosis/radio/links/link_model.hpp"

namespace muster::diagnosis {

noise::StatedField stated_field(const LinkModel& model);

// The likelihood of the field that rows say against that of a field with the stated size and distance, asked of single
// readings, which know how it begins to fall, and of rows, which know how far it reaches: the smaller of both gains
// counts. The family of correlations, which no world states, is the likeliest in each. `law`: of a reading.
LawTest field_test(ReadingField& field, double step, const ReadingLaw& law, const noise::StatedField& stated,
                   const inference::Bench& bench);

// Covariance of rows of which each has a residual: for a draw of the world's own shadowing.
noise::Covariance fitted_to(const inference::Bench& bench, const Eigen::VectorXd& row_means);

}  // namespace muster::diagnosis
