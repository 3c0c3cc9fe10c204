// Readings that nobody took: a world asked what it would expect there, and what causes would add.
#pragma once

#include "diagnosis/causes/cause_candidates.hpp"
#include "diagnosis/prediction/sensitivities.hpp"
#include "diagnosis/radio/links/link_model.hpp"
#include "diagnosis/radio/links/link_rows.hpp"
#include "text/temporary_folder.hpp"

namespace muster::diagnosis {

class SimulatedReadings {
 public:
  // `radios`: names, by the numbers in tx and rx. The world's parameters are those at which `base` was taken. Throws
  // Error.
  SimulatedReadings(const LinkReadings& readings, const std::vector<std::string>& radios,
                    const std::filesystem::path& world, const Library::SearchPath& plugins, const Sensitivities& base);
  SimulatedReadings(const SimulatedReadings&) = delete;
  SimulatedReadings& operator=(const SimulatedReadings&) = delete;

  LinkModel& model() { return *model_; }
  // The same candidate with its columns here, one row a reading.
  inference::Candidate at(const CauseCandidate& cause) const;

 private:
  TemporaryFolder folder_;  // of the table
  std::unique_ptr<LinkModel> model_;
  std::shared_ptr<CauseModel> run_;
  std::vector<Eigen::Index> all_;
};

// Whether the world has an instance that reads a table of the measured readings: it says nothing of any other.
bool holds_a_table_reader(const LinkModel& model);

}  // namespace muster::diagnosis
