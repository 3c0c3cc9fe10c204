// How well a term's place, time or shape and its coefficients are known, together.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

struct Spread {
  // As likely as one another given the data, the coefficients integrated out. One where nothing is sought.
  std::vector<Eigen::VectorXd> thetas;
  // Covariance of the coefficients over those, over what the noise may be, under the covariance itself
  // (noise/exact.hpp), and not below what the scatter of the residuals from place to place says (Huber 1967): a shape
  // that fits only roughly shows there.
  Eigen::MatrixXd coefficients;
};

Spread spread_of(const Bench& bench, const Term& term);

// Of the thetas that are as likely as one another and explain nearly as much as the term's, the one whose effect on the
// readings is nearest to the mean of all their effects: it errs least on readings that nobody has seen.
Eigen::VectorXd middle_of(const Bench& bench, const Term& term, const Spread& spread);

}  // namespace muster::inference
