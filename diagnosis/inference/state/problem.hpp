// Input of a search: measured values, their layout, the model's own columns, candidates and smooths.
#pragma once

#include "diagnosis/inference/noise/censored.hpp"
#include "diagnosis/inference/noise/fit.hpp"
#include "diagnosis/inference/state/candidate.hpp"
#include "diagnosis/inference/state/layout.hpp"

namespace muster::inference {

struct Problem {
  std::shared_ptr<const Layout> layout;
  Eigen::VectorXd measured;  // response of the base design
  noise::Bounds bounds;      // of measured: censored readings
  Eigen::MatrixXd base;  // one row a reading: derivatives of the model's mean by its parameters, a constant among them
  std::vector<Candidate> candidates;
  std::vector<Candidate> smooths;  // generic ones, along every column of a reading (smooths.hpp)
  noise::StatedField stated;       // correlated part of the errors, as the model states it
  // Candidates that depend on the base coefficients of the current model. May be empty.
  std::function<std::vector<Candidate>(const Eigen::VectorXd& base_coefficients)> depending;
};

// Constants of the method.
struct Options {
  double first_alpha = 0.003, further_alpha = 0.0015;  // significance over all candidates
  int nulls = 200;                                     // draws for the effective number of tests
  int draws = 32;                                      // of the covariance, for the marginal p-value
  double one_group_charge = 6;                         // nats, for a place supported by one group only
  double share = 0.9;                                  // of a smooth that a named cause must explain to replace it
  double merge_share = 0.93;                           // of several pieces that one object must explain to replace them
  int most_terms = 6;
  uint64_t seed = 1;
  noise::Prior prior;
};

}  // namespace muster::inference
