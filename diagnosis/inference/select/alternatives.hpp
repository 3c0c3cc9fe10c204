// What else could be meant: candidates that explain as much, and how well the data tell them apart.
#pragma once

#include "diagnosis/inference/score/candidate_scores.hpp"

namespace muster::inference {

constexpr double inseparable = 12, decided = 25;  // D below which two causes are not told apart, from which they are

struct Rival {
  std::string id, label;  // of a smooth: ~ and what it is along
  Eigen::VectorXd theta;
  double evidence_gap = 0;  // nats that the finding is ahead
  double separability = 0;  // D: whitened energy of the finding left after the rival's best fit
  // Nats of the gap that are the readings' own, not the price of places and strengths; of causes that are not told
  // apart.
  double by_readings = 0;
};

// D of a whitened effect of which a rival explains so much; rounding must not make it negative.
double left_of(const Eigen::VectorXd& effect, double explained);

// Whether the readings leave open that it is the rival: it is within 3 nats, or not told apart, and they do not speak
// for the finding by 3 nats themselves. Beside a true rival they would in at most 0.7 %: their logarithm is normal
// about -D / 2 with variance D then, which is furthest from 3 by the square root of 6, at D = 6.
bool left_open(const Rival& rival);

// What speaks for a cause with these columns beside a design, the noise being fitted beside both: nats, to be compared
// with another in its place. Noise that was fitted beside one of them takes up what the other misses.
double standing(const Bench& bench, const Eigen::MatrixXd& design, const Candidate& candidate,
                const Eigen::MatrixXd& columns);

// Candidates within 3 nats of the term, and causes that are not told from it, its own of other rows among them. A
// smooth along the very column that the term is about is none.
std::vector<Rival> rivals_of(Bench& bench, const Term& term);

}  // namespace muster::inference
