// Refits the world's parameters and the found causes' strengths jointly by the simulator (damped Gauss-Newton). The
// search linearises the mean about the first fit; losses of walls and places of radios are nonlinear.
#pragma once

#include "diagnosis/causes/cause_model.hpp"
#include "diagnosis/inference/state/model_state.hpp"
#include "diagnosis/result.hpp"

namespace muster::diagnosis {

struct JointRefit {
  MeasuredWorld& model;                // holds an instance of each named cause during the refit
  ParameterGuard& moved;               // keeps the world's parameters at the refit until its end
  const std::vector<Cause>& causes;    // of the plugin path
  std::filesystem::path data;          // table for causes that read one
  const inference::ModelState& state;  // after the search: its noise, rows and smooths
  const std::vector<Eigen::Index>& used;
  Eigen::VectorXd measured;  // dBm, row means
};

// Updates the values of `found`. Returns the extended world's expected level of every reading, dBm.
Eigen::VectorXd refit_jointly(const JointRefit& fit, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                              const std::vector<std::string>& paths, Diagnosis& found);

}  // namespace muster::diagnosis
