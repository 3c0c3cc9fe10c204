// The world's parameters and the found causes' strengths together, as the simulator executes them: the search takes the
// mean as linear about the first fit, which losses of walls and places of radios are not.
#pragma once

#include "diagnosis/causes/cause_model.hpp"
#include "diagnosis/inference/state/model_state.hpp"
#include "diagnosis/result.hpp"

namespace muster::diagnosis {

struct JointRefit {
  MeasuredWorld& model;                // has an instance of each named cause meanwhile
  ParameterGuard& moved;               // the world's parameters stay at the refit until it ends
  const std::vector<Cause>& causes;    // of the plugin path
  std::filesystem::path data;          // what a cause that reads a table reads
  const inference::ModelState& state;  // after the search: its noise, rows and smooths
  const std::vector<Eigen::Index>& used;
  Eigen::VectorXd measured;  // dBm, row means
};

// Moves the values of `found` and returns what the extended world expects of every reading, dBm.
Eigen::VectorXd refit_jointly(const JointRefit& fit, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                              const std::vector<std::string>& paths, Diagnosis& found);

}  // namespace muster::diagnosis
