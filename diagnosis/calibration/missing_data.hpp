// Why readings are missing: because the level fell below a floor (they are censored), or at random?
#pragma once

#include "diagnosis/calibration/censored_likelihood.hpp"

namespace muster::diagnosis {

struct Missing {
  std::size_t count = 0;
  bool censored = false;       // most of them, by the floor
  bool cut_off = false;        // levels end at the floor at once, where many would be weaker
  double floor = 0;            // dBm; of the fitted mixture
  double share_at_random = 0;  // of all readings, at every level
  double by_floor = 0;         // share of the missing ones that the floor explains
  double evidence = 0;         // twice the log-likelihood ratio of the mixture against chance alone
  double none_below = 1;       // the chance that so few were heard below the floor, were there none
  struct Bin {
    double level;  // mean predicted level, dBm
    double rows, missing;
  };
  std::vector<Bin> bins{};  // ten, of equal numbers of readings, by predicted level, the weakest first

  // Neither chance nor a floor, but more is missing where less is expected: what was heard are the stronger ones.
  bool rises() const;
};

// `mean` and `sigma` are a fit's to what was heard.
Missing why_missing(const Eigen::VectorXd& rssi, const Eigen::VectorXd& mean, double sigma);

}  // namespace muster::diagnosis
