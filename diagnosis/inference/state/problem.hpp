// Input of a search: measured values, their layout, the model's own columns, candidates and smooths.
#pragma once

#include "diagnosis/inference/noise/censored.hpp"
#include "diagnosis/inference/noise/fit.hpp"
#include "diagnosis/inference/state/candidate.hpp"
#include "diagnosis/inference/state/layout.hpp"

namespace muster::inference {

struct Problem {
  std::shared_ptr<const Layout> layout;
  Eigen::VectorXd measured;  // the values that the base design is to explain
  noise::Bounds bounds;      // of measured, where only a bound is known
  Eigen::MatrixXd base;  // one row a reading: derivatives of the model's mean by its parameters, a constant among them
  std::vector<Candidate> candidates;
  std::vector<Candidate> smooths;  // generic ones, along everything that a reading has (smooths.hpp)
  noise::StatedField stated;       // the correlated part of the errors, as the model states it
  // Candidates that need the base coefficients of the model as it stands. May be empty.
  std::function<std::vector<Candidate>(const Eigen::VectorXd& base_coefficients)> depending;
};

// Constants of the method, with their units.
struct Options {
  double first_alpha = 0.003, further_alpha = 0.0015;  // over all candidates
  int nulls = 200;                                     // draws for the effective number of atoms
  int draws = 32;                                      // of the covariance, for the integrated p
  double one_group_charge = 6;                         // nats, for a place that rests on one group
  double share = 0.9;                                  // of a smooth that a name must explain to replace it
  double merge_share = 0.93;                           // of several pieces that one object must explain
  int most_terms = 6;
  uint64_t seed = 1;
  noise::Prior prior;
};

}  // namespace muster::inference
