// Plans further measurements, from the world's walls and the paths driven so far.
#pragma once

#include "diagnosis/causes/cause_shape.hpp"
#include "diagnosis/data/dataset.hpp"
#include "diagnosis/inference/assess/search.hpp"
#include "diagnosis/prediction/sensitivities.hpp"
#include "diagnosis/radio/links/link_model.hpp"
#include "diagnosis/result.hpp"

namespace muster::diagnosis {

// Plans: the same paths in reverse, later, or with both ends sending; turns on the spot; a station turned or moved;
// places not yet visited. `about`: findings, which determine the station and the unvisited places.
std::vector<PlannedReadings> planned_readings(const RowSummary& seen, const std::vector<CauseEstimate>& about);

// The plan with the largest growth of D over the alternatives of the strongest open cause, each D capped at `decided`.
// None if the growth is below 1, the contribution of one reading that differs by its own sd.
std::optional<PlannedReadings> most_telling(const Diagnosis& found, std::vector<PlannedReadings> plans);

struct PlanSources {
  std::filesystem::path world;
  Library::SearchPath plugins;
  const LinkModel& model;  // of the data
  const Dataset& data;
};

// Adds the predicted D of each plan for each undecided pair of cause and alternative, and the best plan. Throws Error.
void add_advice(inference::Search& search, Diagnosis& found, const CauseSearch& causes, const PlanSources& sources,
                const Sensitivities& base, const LinkRowLimits& limits);

}  // namespace muster::diagnosis
