// Converts a data set to the search's inputs: ends, levels, bounds, and further columns of the data.
#pragma once

#include "diagnosis/calibration/fit.hpp"
#include "diagnosis/inference/noise/censored.hpp"
#include "diagnosis/radio/links/link_smooths.hpp"
#include "diagnosis/radio/links/receiver_checks.hpp"

namespace muster::diagnosis {

// Levels in dBm, with bounds for clipped and lost readings.
struct ObservedLevels {
  Eigen::VectorXd measured;
  noise::Bounds bounds;
};

// Columns of the data beyond those of a link, on the readings of the search.
struct ObservedColumns {
  LinkColumns columns;
  std::vector<int> run;               // of each reading, from 0; empty if the data name none
  std::vector<std::string> untested;  // columns that cannot be used, with the reason
};

// `used`: rows of the table; `expected`: dBm, of every row of the table.
LinkReadings observed_readings(const Dataset& data, const LinkModel& model, const std::vector<Eigen::Index>& used,
                               const Eigen::VectorXd& expected);
ObservedLevels observed_levels(const Dataset& data, const ReceiverChecks& receiver, const Readings& fitted,
                               const std::vector<Eigen::Index>& used);
// The column `run`, and numbers of few distinct values (settings), become factors.
ObservedColumns observed_columns(const Dataset& data, const std::vector<Eigen::Index>& used);
// Of each reading which of the settings it was made with, numbers and words of few distinct values together, from 0;
// empty if there are none. Readings of different settings are no repeats of one another.
std::vector<int> settings_of(const ObservedColumns& observed);

}  // namespace muster::diagnosis
