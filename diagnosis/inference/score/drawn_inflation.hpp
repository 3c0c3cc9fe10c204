// Inflation of gains in the model's own draws. A covariance has the first two moments of what a model draws: a field of
// a few waves, or none but rounding, has more structure than that. Where the model draws its errors itself, and the
// data are like its draws, gains are calibrated on these.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

// Factor by which the candidate's highest gain over its grid in draws of the model exceeds that in white noise: mean
// over mean; at least 1, and 1 where the model draws nothing. `field`: that of the draws.
double drawn_inflation(const ModelState& state, const Eigen::MatrixXd& design, const noise::Covariance& covariance,
                       const Candidate& candidate, const noise::StatedField& field);
// The same with each draw under the likeliest of several sizes and distances of its field: those of the data are
// fitted, too.
double refitted_inflation(const ModelState& state, const Eigen::MatrixXd& design, const noise::Covariance& covariance,
                          const Candidate& candidate, const noise::StatedField& field);

// Columns of a candidate beside a design, with the noise fitted to both.
struct ColumnsBeside {
  const Candidate& candidate;
  const Eigen::MatrixXd& columns;
  const Eigen::MatrixXd& design;
  const noise::Fit& fit;
};

struct HeldAgainstDraws {
  double log_p, inflation;
};

// The gain of the columns over its inflation in draws with this field. Where that is beyond the threshold, the draws'
// fields are fitted as that of the data was; and a fit that took a cause for some of the field makes draws of the whole
// field seem inflated by more than the gain is: where the field that is drawn stands beside the cause, both are asked
// for under its covariance.
HeldAgainstDraws held_against_draws(const ModelState& state, const ColumnsBeside& lead,
                                    const noise::StatedField& field);

// True unless the rows, fitted by `design`, are farther from the correlation that the model states than its own draws
// are: by the likelihood ratio of the fitted family, or else the exponential one, to the stated one, beyond the range
// of its values in draws by as much as that range (a parametric bootstrap: Davison and Hinkley, Bootstrap Methods and
// their Application, 1997, 4.4). Of other data the inflation in draws says nothing, and would hide what is there. False
// where the model states no correlation, or draws nothing. True where nothing blurs the field: no covariance has the
// structure of a few waves then, whatever effects are in the data, too.
bool resembles_draws(const ModelState& state, const Eigen::MatrixXd& design, const noise::StatedField& field);

}  // namespace muster::inference
