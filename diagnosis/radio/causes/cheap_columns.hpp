// Cheaper columns for candidates on links: sketches of one reading a row, columns near a place, and swaps of radios by
// the map.
#pragma once

#include "diagnosis/calibration/fit.hpp"
#include "diagnosis/radio/causes/simulated_readings.hpp"

namespace muster::diagnosis {

// The world that candidates are evaluated in, and the readings of the search.
struct LinkSearchWorld {
  std::filesystem::path world, data;
  Library::SearchPath plugins;
  LinkModel& model;  // with the readings of `data`
  const Sensitivities& base;
  const std::vector<Eigen::Index>& used;  // rows of the table behind the readings of the search
  std::shared_ptr<const LinkLayout> layout;
  const noise::Rows& rows;
};

// Parameters that were fitted while two radios bear each other's name are bent by that, and so would be the columns of
// a swap. Where the fit leaves much more than the world's own draws, swaps are evaluated at the declared parameters.
// `run`: the causes' model, in which nothing may be left of others.
CauseSearch with_swaps_by_the_map(CauseSearch causes, const LinkSearchWorld& at, const Fit& fitted, CauseModel& run);

// Where rows have many readings, a search over many places, times or shapes evaluates one of each. `sketched`: these
// readings, or null where each reading is a row or the world reads a table.
std::shared_ptr<SimulatedReadings> sketched_readings(const LinkSearchWorld& at);
CauseSearch with_sketches(CauseSearch causes, const std::shared_ptr<SimulatedReadings>& sketched);

// Places of walls and things are drawn some thousand times about one place, which few of many readings concern.
CauseSearch with_columns_near(CauseSearch causes, const LinkSearchWorld& at);

}  // namespace muster::diagnosis
