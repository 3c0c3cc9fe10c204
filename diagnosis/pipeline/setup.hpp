// Setup of a diagnosis: a world and its measured readings, the world fitted, and every cause that the data can test as
// a candidate.
#pragma once

#include "diagnosis/calibration/fit.hpp"
#include "diagnosis/causes/cause_candidates.hpp"
#include "diagnosis/inference/state/problem.hpp"
#include "diagnosis/pipeline/link_observations.hpp"
#include "diagnosis/prediction/sensitivities.hpp"
#include "diagnosis/radio/causes/simulated_readings.hpp"

namespace muster::diagnosis {

// Rows of the table that are searched, and notes on those that are left out.
struct UsedRows {
  std::vector<Eigen::Index> rows;
  std::vector<std::string> notes;
};

// Each member is built from those above it, and stays as it is.
struct DiagnosisSetup {
  // `tables`: files that were read already. Throws Error.
  DiagnosisSetup(const std::filesystem::path& world, const std::filesystem::path& file,
                 const Library::SearchPath& plugins,
                 const std::shared_ptr<TableCache>& tables = std::make_shared<TableCache>());
  DiagnosisSetup(const DiagnosisSetup&) = delete;
  DiagnosisSetup& operator=(const DiagnosisSetup&) = delete;

  const std::filesystem::path file;  // of the readings
  const Dataset data;
  const ReceiverChecks receiver;
  LinkModel model;
  const std::vector<Cause> causes;                 // of the plugin path
  const std::vector<std::string> notes_of_places;  // on radios that the data have elsewhere than the world
  const Fit fitted;
  const Sensitivities base;
  const UsedRows used;
  const std::vector<std::string> notes;   // on the data, beside the world
  const std::shared_ptr<CauseModel> run;  // evaluates the candidates
  const ObservedColumns observed;
  const std::shared_ptr<const LinkLayout> layout;
  const noise::Rows rows;                             // of the search, at first
  const std::shared_ptr<SimulatedReadings> sketched;  // one reading a row; none where each is a row
  const CauseSearch sought;
  const inference::Problem problem;
  const inference::Options options;
};

}  // namespace muster::diagnosis
