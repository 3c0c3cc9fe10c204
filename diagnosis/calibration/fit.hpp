// A world's free parameters from measured readings: their values, how sure they are, and what the data cannot tell.
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
  std::vector<std::string> not_identifiable;  // each in words
  double residual_sd = 0;                     // dB
  double simulated_sd = 0;                    // dB: of the world's own draws about its expectation
  double fading_mean = 0;                     // dB: what the expectation includes for fading, -2.507 under Rayleigh
  MissingData missing;
  Minimum least_squares, search;
  double disagreement = 0;  // largest difference between both, in units of 1 + |value|

  Readings readings;         // with the rows that were used
  Eigen::VectorXd mean;      // of every row at the fit, dBm
  Eigen::VectorXd residual;  // rows as in diagnosis::residuals()
  Eigen::MatrixXd slopes;    // of the identifiable parameters
  Clusters clusters;
  std::vector<Kernels> kernels;
  double shared_sd = 0, decorrelation = 0, shared_evidence = 0, white_sd = 0;

  // Rows of the data set behind the rows of `residual`.
  std::vector<std::size_t> rows_used() const;
};

// Leaves the model at the fitted parameters. Throws Error.
Fit fit(LinkModel& model, const Dataset& data, const FitOptions& options);

}  // namespace muster::diagnosis
