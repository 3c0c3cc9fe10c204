// Identifiability of parameters, from the singular values of the design matrix (derivatives of the mean).
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace muster::diagnosis {

// A null direction: parameters that can move together without changing any reading.
struct Blindness {
  std::vector<int> parameters;  // indices of those that move
  Eigen::VectorXd direction;    // one a parameter, in its own unit, the largest 1
};

// All null directions. `slopes`: one row a reading. `box_width`: of the bounds of each parameter.
std::vector<Blindness> blindnesses(const Eigen::MatrixXd& slopes, const Eigen::VectorXd& box_width);

// "radio.multiwall/l0 by 1 dB together with radio.multiwall/tx_power by 1 dBm changes no reading"
std::string in_words(const Blindness& blindness, const std::vector<std::string>& names,
                     const std::vector<std::string>& units);

}  // namespace muster::diagnosis
