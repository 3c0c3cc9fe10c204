// Which thetas of a term are likely, given the rest of a model.
#pragma once

#include "diagnosis/inference/score/conditional_fit.hpp"

namespace muster::inference {

struct LikelyThetas {
  std::vector<Eigen::VectorXd> thetas;
  std::vector<Explained> explained;
  Eigen::VectorXd weights;  // sum 1
};

// A Metropolis walk finds where they lie. From there on they are drawn from Student t distributions that fit what was
// found so far, and each weighs by its likelihood over how often it is drawn (adaptive multiple importance sampling:
// Cornuet, Marin, Mira and Robert 2012), until they are worth a hundred independent ones. `overstated`: by how
// much gains are. The term's candidate is refinable.
LikelyThetas likely_thetas(const Bench& bench, const Stand& rest, const Term& term, double overstated);

}  // namespace muster::inference
