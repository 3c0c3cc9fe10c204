// How heavy an effect weighs, and how strong it must be to weigh what is wanted.
#pragma once

#include "exam/case.hpp"

namespace muster::exam {

struct ReceivedShift {
  Eigen::VectorXd shift;      // dB, expected where something is reported, times the chance of that
  double missing_lambda = 0;  // from which readings are missing, against random loss
};

// What a receiver's stage does on average to readings whose mean is the base model plus `before`.
ReceivedShift received_shift(const Site& site, const Effect& effect, double strength, const Data& data,
                             const Eigen::VectorXd& before);

// The readings that say their level: heard, and not at a code that the receiver reports for other levels too.
std::vector<char> telling(const Case& made, const Data& data);

// Draws the effects of the case's order, each as strong as it must be; sets the noise's true laws.
void hide(Case& made, const std::vector<char>& use);

// Sets each effect's final lambda, beside the others, and the oracle's held-out errors.
void weigh(Case& made);

}  // namespace muster::exam
