// What the search is given: readings, the model's own columns, candidates, and columns to build smooths of.
#pragma once

#include "diagnosis/inference/noise/censored.hpp"
#include "diagnosis/inference/noise/fit.hpp"
#include "diagnosis/inference/noise/rows.hpp"
#include "diagnosis/inference/state/candidate.hpp"

namespace muster::inference {

// A column of the data that no model knows.
struct Covariate {
  std::string name;
  Eigen::VectorXd values;  // one a reading, none empty
  bool angle = false;      // rad
  int functions = 5;       // of the first smooth
  bool products = true;    // with distance and position too
};

struct Factor {
  std::string name;
  std::vector<int> level;  // one a reading, from 0
};

struct Problem {
  noise::Readings readings;
  Eigen::VectorXd measured;  // what the base design is to explain, dBm
  noise::Bounds bounds;      // of measured, where only a bound is known
  Eigen::MatrixXd base;  // one row a reading: derivatives of the model's mean by its parameters, a constant among them
  std::vector<Candidate> candidates;
  std::vector<Covariate> covariates;
  std::vector<Factor> factors;
  std::vector<int> run;       // of each reading, from 0; empty: nobody says
  noise::StatedField stated;  // shadowing, as the model states it
  bool places_known = true;   // false: only distances are, and places stand for them
  // Candidates that need the base coefficients of the model as it stands. May be empty.
  std::function<std::vector<Candidate>(const Eigen::VectorXd& base_coefficients)> depending;
};

// Constants of the method, with their units.
struct Options {
  double first_alpha = 0.003, further_alpha = 0.0015;  // over all candidates
  int nulls = 200;                                     // draws for the effective number of atoms
  int draws = 32;                                      // of the covariance, for the integrated p
  double one_radio_charge = 6;                         // nats, for a place that rests on one transmitter
  double share = 0.9;                                  // of a smooth that a name must explain to replace it
  double merge_share = 0.93;                           // of several pieces that one object must explain
  int most_terms = 6;
  uint64_t seed = 1;
  noise::RowLimits rows;
  noise::Prior prior;
};

}  // namespace muster::inference
