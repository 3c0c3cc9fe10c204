// Cheaper or unbiased columns for candidates on links: sketches of one reading a row, local columns near a place, and
// swaps of radios at the map's parameters.
#pragma once

#include "diagnosis/calibration/fit.hpp"
#include "diagnosis/radio/causes/simulated_readings.hpp"

namespace muster::diagnosis {

// World for evaluating candidates, and the readings of the search.
struct LinkSearchWorld {
  std::filesystem::path world, data;
  Library::SearchPath plugins;
  LinkModel& model;  // with the readings of `data`
  const Sensitivities& base;
  const std::vector<Eigen::Index>& used;  // rows of the table behind the readings of the search
  std::shared_ptr<const LinkLayout> layout;
  const noise::Rows& rows;
};

// Evaluates swaps of radios at the declared parameters if the residual far exceeds the simulated scatter. Exchanged
// names of radios bias the fitted parameters and, with them, the columns of swaps. `run`: the model of the causes,
// which is cleared.
CauseSearch with_swaps_by_the_map(CauseSearch causes, const LinkSearchWorld& at, const Fit& fitted, CauseModel& run);

// Readings for sketches of searches over many places, times or shapes: the middle one of each row. Null if rows have
// few readings or the world reads a table.
std::shared_ptr<SimulatedReadings> sketched_readings(const LinkSearchWorld& at);
CauseSearch with_sketches(CauseSearch causes, const std::shared_ptr<SimulatedReadings>& sketched,
                          const noise::Rows& rows);

// Adds local columns to walls and obstacles. Their posterior has thousands of samples near one place, which affects
// only few readings.
CauseSearch with_columns_near(CauseSearch causes, const LinkSearchWorld& at);

}  // namespace muster::diagnosis
