// Findings of a search, as plain data.
#pragma once

#include <optional>

#include "diagnosis/inference/assess/cross_validation.hpp"
#include "diagnosis/inference/select/alternatives.hpp"
#include "diagnosis/inference/select/forward_selection.hpp"
#include "diagnosis/inference/select/stays.hpp"

namespace muster::inference {

enum class Status { named = 1, suspected, unexplained };

struct Finding {
  std::string id, label;
  Status status = Status::named;
  std::vector<std::string> covariates;
  Eigen::VectorXd theta;                // place, time or shape
  Eigen::VectorXd coefficients;         // one a column
  Eigen::MatrixXd uncertainty;          // covariance of the coefficients
  std::vector<Eigen::VectorXd> thetas;  // equally likely draws of theta; none for a suspected finding
  double gain = 0;                      // deviance beside all other findings
  double evidence = 0;                  // nats
  double log_p = 0;                     // marginal over the covariance
  double reach = 0;                     // between the lowest and the highest of its effects, but for 1 % at each end
  double inflation = 1;                 // of gains of its kind in these data, by which its own was divided for log_p
  std::optional<HeldOutGain> held_out;  // without and with it; none for a suspected finding
  Eigen::VectorXd unseen_without;       // squared errors of readings at left-out places without it; none likewise
  std::vector<Elsewhere> elsewhere;     // the same for each grouping, if it concerns several groups
  std::vector<Alternative> alternatives;
};

// A candidate at its best beside the final model.
struct Check {
  std::string id, label;
  Kind kind = Kind::named;
  double gain = 0, log_p = 0;  // of so much by chance anywhere on its grid
  std::string refused{};       // why it was not taken when it was tried last; empty: it never was
};

struct Result {
  std::vector<Finding> findings;  // the strongest first, suspected ones last
  std::vector<Trial> trials;
  noise::Fit noise;
  std::vector<noise::Fit> families;  // of the base model
  Eigen::VectorXd base_coefficients;
  Eigen::VectorXd mean;                 // of the extended model, one a row
  std::optional<Unseen> unseen;         // of the base model and the extended one
  std::optional<HeldOutGain> held_out;  // summary of those
  std::vector<Elsewhere> elsewhere;     // of each grouping of several groups
  std::vector<Stair> stairs;  // the base model, then with each accepted finding in turn; empty: too few blocks
  std::vector<Check> checks;
  std::optional<StayScatter> stays;  // where something in time was not named for how they scatter
  Index aside = 0;                   // readings that were set aside while structure was sought
};

}  // namespace muster::inference
