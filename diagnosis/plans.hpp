// Measurements that could be made next, from what the world and the ways that were driven allow.
#pragma once

#include "diagnosis/base_columns.hpp"
#include "diagnosis/diagnose.hpp"

namespace muster::diagnosis {

struct PlannedReadings {
  std::string say;
  noise::Readings readings;
};

// The same ways in reverse or later, turns on the spot, a transmitter moved, places not yet visited. `about`: what was
// found, near which places not yet visited matter most.
std::vector<PlannedReadings> planned_readings(const SeenRows& seen, const std::vector<FoundCause>& about);

struct PlanSources {
  std::filesystem::path world;
  Library::SearchPath plugins;
  const LinkModel& model;  // of the data
  const Dataset& data;
};

// What the plans would do for each cause and rival that the data do not decide. Throws Error.
std::vector<Advice> advice_for(search::Search& search, const Diagnosis& found, const CauseSearch& causes,
                               const PlanSources& sources, const BaseColumns& base);

}  // namespace muster::diagnosis
