// Predicts readings that were not taken: a world's expected levels there, and the columns of causes.
#pragma once

#include "diagnosis/causes/cause_candidates.hpp"
#include "diagnosis/prediction/sensitivities.hpp"
#include "diagnosis/radio/links/link_model.hpp"
#include "diagnosis/radio/links/link_rows.hpp"
#include "text/temporary_folder.hpp"

namespace muster::diagnosis {

class SimulatedReadings {
 public:
  // `radios`: names, by the indices in tx and rx. The world has the parameters of `base`. `libraries`: loaded already.
  // Throws Error.
  SimulatedReadings(const LinkReadings& readings, const std::vector<std::string>& radios,
                    const std::filesystem::path& world, const Library::SearchPath& plugins, const Sensitivities& base,
                    const std::vector<std::shared_ptr<Library>>& libraries = {});
  SimulatedReadings(const SimulatedReadings&) = delete;
  SimulatedReadings& operator=(const SimulatedReadings&) = delete;

  // Derivatives of the expected levels by the world's own parameters, one row a reading.
  Eigen::MatrixXd slopes(const Sensitivities& base);
  // The same candidate with columns at these readings, one row each.
  inference::Candidate at(const CauseCandidate& cause) const;

 private:
  TemporaryFolder folder_;  // of the table
  std::unique_ptr<LinkModel> model_;
  std::shared_ptr<CauseModel> run_;
  std::vector<Eigen::Index> all_;
};

// True if a cause in the world reads a table: it has no values at readings that were not taken.
bool holds_a_table_reader(const LinkModel& model);

}  // namespace muster::diagnosis
