// Samples the posterior of a term's parameters, other terms fixed.
#pragma once

#include "diagnosis/inference/score/conditional_fit.hpp"

namespace muster::inference {

struct LikelyThetas {
  std::vector<Eigen::VectorXd> thetas;
  std::vector<ConditionalGain> explained;
  Eigen::VectorXd weights;  // sum 1
};

// A Metropolis walk locates the posterior. Then adaptive multiple importance sampling (Cornuet, Marin, Mira and
// Robert 2012): draws from Student t distributions fitted to earlier draws. It ends at an effective sample size of a
// hundred. `overstated`: factor by which gains are too large. The term's candidate must be refinable.
LikelyThetas sample_posterior(const ModelState& state, const WhitenedModel& rest, const Term& term, double overstated);

}  // namespace muster::inference
