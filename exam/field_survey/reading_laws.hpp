// How single readings scatter: heavy tails and intermittent blockage, and what knowing of them is worth.
#pragma once

#include "exam/field_survey/survey_case.hpp"

namespace muster::exam::survey {

// One reading's error beside its cell, dB.
double draw_error(const Scatter& scatter, Draws& draws);

// Loss of each row by people who cross its link at unknown times, dB.
std::vector<double> blockage(const Campaign& campaign, const Scene& truth, Draws& draws);

// 2 x the log-likelihood ratio of an effect on the law of readings, given their means: of `outliers` the
// Kullback-Leibler divergence from the Gaussian of the same variance, readings of a place together, whose level is not
// known; of `people` a hidden Markov chain of two states against one Gaussian with the mean and variance of the
// readings, averaged over simulated campaigns.
double law_lambda(const Campaign& campaign, const Scene& truth, const std::string& effect,
                  const std::vector<char>& used);

// 2 x the log-likelihood ratio of the pattern of missing readings against random loss, where the effect causes it and
// the table shows it.
double missing_lambda(const Scene& truth, const std::string& effect, const Made& made);

}  // namespace muster::exam::survey
