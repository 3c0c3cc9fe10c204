// Readings of a data set as a search takes them: ends, levels, bounds, and the further columns of the data.
#pragma once

#include "diagnosis/calibration/fit.hpp"
#include "diagnosis/inference/noise/censored.hpp"
#include "diagnosis/radio/links/link_smooths.hpp"
#include "diagnosis/radio/links/receiver_checks.hpp"

namespace muster::diagnosis {

// Levels in dBm, and where only a bound is known of them: clipped or lost readings.
struct ObservedLevels {
  Eigen::VectorXd measured;
  noise::Bounds bounds;
};

// Columns of the data beyond those of a link, on the readings of the search.
struct ObservedColumns {
  LinkColumns columns;
  std::vector<int> run;               // of each reading, from 0; empty where the data name none
  std::vector<std::string> untested;  // columns that cannot be used, with the reason
};

// `used`: rows of the table; `expected`: dBm, of every row of the table.
LinkReadings observed_readings(const Dataset& data, const LinkModel& model, const std::vector<Eigen::Index>& used,
                               const Eigen::VectorXd& expected);
ObservedLevels observed_levels(const Dataset& data, const ReceiverChecks& receiver, const Readings& fitted,
                               const std::vector<Eigen::Index>& used);
// A number of few values is a setting, that of a run a name: each value is a level of a factor.
ObservedColumns observed_columns(const Dataset& data, const std::vector<Eigen::Index>& used);

}  // namespace muster::diagnosis
