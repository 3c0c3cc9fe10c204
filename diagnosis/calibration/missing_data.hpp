// Tests if readings are missing below a floor (censored) or at random.
#pragma once

#include <optional>

#include "diagnosis/calibration/censored_likelihood.hpp"

namespace muster::diagnosis {

struct MissingData {
  std::size_t count = 0;
  bool censored = false;       // most are lost below the floor
  bool cut_off = false;        // levels end abruptly at the floor, where many weaker ones are expected
  double floor = 0;            // dBm; of the fitted mixture
  double share_at_random = 0;  // of all readings, independent of level
  double by_floor = 0;         // share of the missing ones explained by the floor
  double evidence = 0;         // twice the log-likelihood ratio of the mixture against random loss
  double beyond_stated = 0;    // the same against the floor that the world states, at most `evidence`
  double none_below = 1;       // probability of so few received readings below the floor without one
  struct Bin {
    double level;  // mean predicted level, dBm
    double rows, missing;
  };
  std::vector<Bin> bins{};  // ten bins of equal count by predicted level, the weakest first

  // True if losses rise towards low levels without a floor: received readings are then a biased sample.
  bool rises() const;
};

// `mean` and `sigma`: of a fit to the received readings. `stated`: level below which the world lets nothing through,
// dBm.
MissingData missing_data(const Eigen::VectorXd& rssi, const Eigen::VectorXd& mean, double sigma,
                         std::optional<double> stated = {});

}  // namespace muster::diagnosis
