// Setup of a diagnosis: world and measured readings, the fitted world, and a candidate for each testable cause.
#pragma once

#include <optional>

#include "diagnosis/calibration/fit.hpp"
#include "diagnosis/causes/cause_candidates.hpp"
#include "diagnosis/inference/state/problem.hpp"
#include "diagnosis/pipeline/link_observations.hpp"
#include "diagnosis/pipeline/used_rows.hpp"
#include "diagnosis/prediction/sensitivities.hpp"
#include "diagnosis/radio/causes/simulated_readings.hpp"
#include "diagnosis/radio/links/world_draws.hpp"

namespace muster::diagnosis {

// What an earlier diagnosis of the same readings tells.
struct Earlier {
  // Level of every row of the table [dBm], by which blocked readings are known; empty: that of the fitted world.
  Eigen::VectorXd expected{};
  // Level below which no reading is in the table [dBm]; none: that of the world's receiver, if it has one.
  std::optional<double> end{};
};

// Each member is built from those above it.
struct DiagnosisSetup {
  // `tables`: files already read. Throws Error.
  DiagnosisSetup(const std::filesystem::path& world, const std::filesystem::path& file,
                 const Library::SearchPath& plugins,
                 const std::shared_ptr<TableCache>& tables = std::make_shared<TableCache>(),
                 const Earlier& earlier = {});
  DiagnosisSetup(const DiagnosisSetup&) = delete;
  DiagnosisSetup& operator=(const DiagnosisSetup&) = delete;

  const std::filesystem::path file;  // of the readings
  const Dataset data;
  const ReceiverChecks receiver;
  LinkModel model;
  const WorldDraws draws;
  const std::vector<Cause> causes;                 // of the plugin path
  const std::vector<std::string> notes_of_places;  // on radios whose places differ between data and world
  const Fit fitted;
  const std::optional<double> end;  // dBm; readings below it are not in the table
  const Sensitivities base;
  const UsedRows used;
  const std::vector<std::string> notes;   // all notes on the data
  const std::shared_ptr<CauseModel> run;  // evaluates the candidates
  const ObservedColumns observed;
  const std::shared_ptr<const LinkLayout> layout;
  const noise::Rows rows;                             // of the search, at first
  const std::shared_ptr<SimulatedReadings> sketched;  // one reading a row; may be null
  const CauseSearch sought;
  const inference::Problem problem;
  const inference::Options options;
};

}  // namespace muster::diagnosis
