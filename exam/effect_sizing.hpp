// Computes the lambda of an effect, and the strength that gives it a requested lambda.
#pragma once

#include "exam/case.hpp"

namespace muster::exam {

struct ReceivedShift {
  Eigen::VectorXd shift;      // dB, expected given a reading, times the probability of one
  double missing_lambda = 0;  // lambda of the pattern of missing readings, against random loss
};

// Mean effect of a receiver's stage on readings with the mean of the base model plus `before`.
ReceivedShift received_shift(const GroundTruth& site, const Effect& effect, double strength, const Data& data,
                             const Eigen::VectorXd& before);

// Marks readings that determine their level: received, and not at a code that the receiver reports for other levels
// too.
std::vector<char> informative_rows(const Case& made, const Data& data);

// Draws the effects of the case's order at the strengths of their requested lambdas; sets the noise's true laws.
void hide(Case& made, const std::vector<char>& use);

// Computes each effect's final lambda, beside the others, and the oracle's held-out errors.
void weigh(Case& made);

}  // namespace muster::exam
