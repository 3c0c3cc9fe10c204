// Whether single readings scatter alike at all levels, as under a law of fading, or as a receiver makes them.
#pragma once

#include <Eigen/Core>

#include "diagnosis/radio/laws/kriging.hpp"

namespace muster::diagnosis {

struct ScatterByLevel {
  double log_p = 0;             // of Spearman's rank correlation between difference and level, two-sided
  double weak = 0, strong = 0;  // dB, standard deviation of a reading in the lower and the upper third of levels
};

// From adjacent readings, whose differences are free of the field. `level`: dBm, expected of each kriged reading.
ScatterByLevel scatter_by_level(const CloseReadings& close, const Eigen::VectorXd& level);

}  // namespace muster::diagnosis
