// Which parameters the data determine, from the singular values of the mean's derivatives.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace muster::diagnosis {

// A way in which parameters can move together without any reading changing.
struct Blindness {
  std::vector<int> parameters;  // numbers of those that move
  Eigen::VectorXd direction;    // one a parameter, in its own unit, the largest 1
};

// Where nothing is blind, none. Rows of `slopes` are readings.
std::vector<Blindness> blindnesses(const Eigen::MatrixXd& slopes, const Eigen::VectorXd& box_width);

// "radio.multiwall/l0 by 1 dB together with radio.multiwall/tx_power by 1 dBm changes no reading"
std::string in_words(const Blindness& blindness, const std::vector<std::string>& names,
                     const std::vector<std::string>& units);

}  // namespace muster::diagnosis
