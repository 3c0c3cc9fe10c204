// Inflation of gains in the model's own draws. A covariance has the first two moments of what a model draws: a field of
// a few waves, or none but rounding, has more structure than that. Where the model draws its errors itself, and the
// data are like its draws, gains are calibrated on these.
#pragma once

#include <functional>

#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

// Factor by which the candidate's highest gain over its grid in draws of the model exceeds that in white noise: mean
// over mean; at least 1, and 1 where the model draws nothing. `field`: that of the draws.
double drawn_inflation(const ModelState& state, const WhitenedModel& model, const Candidate& candidate,
                       const noise::StatedField& field);

// True unless a statistic of the rows is beyond the range of its values in draws by more than that range (a parametric
// bootstrap: Davison and Hinkley, Bootstrap Methods and their Application, 1997, 4.4). False without draws.
bool within_draws(const ModelState& state, const noise::StatedField& field, double of_data,
                  const std::function<double(const Eigen::VectorXd&)>& statistic);

// True unless the rows, fitted by `design`, are farther from the correlation that the model states than its own draws
// are: by the likelihood ratio of the fitted family, or else the exponential one, to the stated one. Of other data the
// inflation in draws says nothing, and would hide what is there. False where the model states no correlation, or draws
// nothing. True where nothing blurs the field: no covariance has the structure of a few waves then, whatever effects
// are in the data, too.
bool resembles_draws(const ModelState& state, const Eigen::MatrixXd& design, const noise::StatedField& field);

}  // namespace muster::inference
