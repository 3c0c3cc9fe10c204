// Alternative explanations of a term: candidates that fit nearly as well, and their separability from it.
#pragma once

#include "diagnosis/inference/score/candidate_scores.hpp"

namespace muster::inference {

struct Alternative {
  std::string id, label;  // of a smooth: ~ and its covariate
  Eigen::VectorXd theta;
  double evidence_gap = 0;  // nats by which the finding is ahead
  double separability = 0;  // D: whitened energy of the finding left after the alternative's best fit; NaN: unknown
  // The gap's log-likelihood part, nats, without the price of places and strengths; of inseparable causes only.
  double by_readings = 0;
};

// D of a whitened effect, given the energy that an alternative explains. Never negative, despite rounding.
double residual_energy(const Eigen::VectorXd& effect, double explained);

// True if the alternative remains possible: within 3 nats, or inseparable with a likelihood ratio below 3 nats.
// Beside a true alternative the error rate is at most 0.7 %. The log ratio is then normal about -D / 2 with variance
// D. In the worst case, D = 6, 3 is the square root of 6 standard deviations away.
bool left_open(const Alternative& alternative);

// Evidence, nats, for a cause with these columns beside a design, the noise refitted with both. Comparable between
// causes in the same place: noise fitted beside one cause would absorb what another one misses.
double evidence_beside(const ModelState& state, const Eigen::MatrixXd& design, const Candidate& candidate,
                       const Eigen::MatrixXd& columns);

// Candidates within 3 nats of the term, and inseparable causes, its own cause on other rows included. Excludes a
// smooth along the term's own observed column.
std::vector<Alternative> alternatives_of(ModelState& state, const Term& term);

}  // namespace muster::inference
