// Measurements that could be made next, from what the world and the ways that were driven allow.
#pragma once

#include "diagnosis/causes/cause_shape.hpp"
#include "diagnosis/data/dataset.hpp"
#include "diagnosis/inference/assess/search.hpp"
#include "diagnosis/prediction/sensitivities.hpp"
#include "diagnosis/radio/links/link_model.hpp"
#include "diagnosis/result.hpp"

namespace muster::diagnosis {

// The same ways in reverse, later or with all radios sending, turns on the spot, a transmitter turned or moved, places
// not yet visited. `about`: what was found, whose radio it is that moves, and near which places not yet visited matter
// most.
std::vector<PlannedReadings> planned_readings(const RowSummary& seen, const std::vector<CauseEstimate>& about);

// The one that decides most about the strongest open cause: by how much D grows over its rivals, none counted beyond
// decided. None if that is less than 1, which one reading adds that differs by its own sd.
std::optional<PlannedReadings> most_telling(const Diagnosis& found, std::vector<PlannedReadings> plans);

struct PlanSources {
  std::filesystem::path world;
  Library::SearchPath plugins;
  const LinkModel& model;  // of the data
  const Dataset& data;
};

// Adds what the plans would do for each cause and rival that the data do not decide. Throws Error.
void add_advice(inference::Search& search, Diagnosis& found, const CauseSearch& causes, const PlanSources& sources,
                const Sensitivities& base, const LinkRowLimits& limits);

}  // namespace muster::diagnosis
