// Fits a world's free parameters to measured readings: values, their uncertainty, and identifiability.
#pragma once

#include "diagnosis/calibration/identifiability.hpp"
#include "diagnosis/calibration/least_squares.hpp"
#include "diagnosis/calibration/missing_data.hpp"
#include "diagnosis/calibration/residual_covariance.hpp"
#include "diagnosis/data/dataset.hpp"
#include "diagnosis/prediction/free_parameters.hpp"
#include "diagnosis/radio/links/link_model.hpp"

namespace muster::diagnosis {

struct Fit {
  std::vector<FitParameter> parameters;
  std::vector<std::string> not_identifiable;  // one sentence each
  double residual_sd = 0;                     // dB
  double simulated_sd = 0;                    // dB: of the world's own draws about their expectation
  double fading_mean = 0;                     // dB: contribution of fading to the expectation, -2.507 under Rayleigh
  MissingData missing;
  Minimum least_squares, search;
  double disagreement = 0;  // largest difference of the two fits, in units of 1 + |value|

  Readings readings;         // with the rows used
  Eigen::VectorXd mean;      // fitted, of every row, dBm
  Eigen::VectorXd residual;  // rows as in diagnosis::residuals()
  Eigen::MatrixXd slopes;    // of the identifiable parameters
  Clusters clusters;
  std::vector<Kernels> kernels;
  double shared_sd = 0, decorrelation = 0, shared_evidence = 0, white_sd = 0;

  // Rows of the data set, for each row of `residual`.
  std::vector<std::size_t> rows_used() const;
};

// Fits, and leaves the model at the fitted parameters. Throws Error.
Fit fit(LinkModel& model, const Dataset& data, const FitOptions& options);

}  // namespace muster::diagnosis
