// Thresholds of noise that is fitted by replicates of a run.
//
// Above each constant: unit; meaning; origin; the test that fails if it is badly changed, as in
// diagnosis/inference/thresholds.hpp.
#pragma once

namespace muster::diagnosis::thresholds {

// runs; replicates, of which half give the weights; chosen; NoiseFit.Row32IntervalsCoverTheTruth
inline constexpr int noise_replicates = 64;
// share; of its bound, with which a noise begins that the world has at 0; chosen; NoiseFit.DoesNotDependOnTheStart
inline constexpr double noise_start_share = 0.01;
// share; change of each parameter below which the fit has settled; chosen; none
inline constexpr double noise_settled = 0.02;
// share; of the standard deviation of a kind of pieces, below which another of the same unit is left out; chosen;
// NoiseFit.Row32IntervalsCoverTheTruth
inline constexpr double least_noise_share = 0.3;
// share; of its kind's mean variance that each piece has in the weights beside its own; chosen;
// NoiseFit.OtherErrorsAtRestDoNotCountForAll
inline constexpr double mean_noise_share = 0.25;
// rounds; fits at most, each with replicates at the last one's values; chosen; none
inline constexpr int noise_rounds = 6;
// probability; of all doubts of one fit together, where noise is as the world has it; chosen;
// NoiseFit.Row32IntervalsCoverTheTruth
inline constexpr double noise_doubt_alpha = 0.01;

}  // namespace muster::diagnosis::thresholds
