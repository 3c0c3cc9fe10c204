// Start values of causes in a plan: rooms, strips between walls, places around radios, or a grid.
#pragma once

#include <optional>

#include "diagnosis/causes/start_grid.hpp"
#include "diagnosis/radio/links/link_model.hpp"
#include "diagnosis/radio/links/measurement_geometry.hpp"

namespace muster::diagnosis {

// All rows, with all places and axis values that suit the cause's shape. `stands`: true for walls and obstacles, on a
// finer grid than causes that fill a part of the plan.
std::vector<Eigen::VectorXd> starts_of(const CauseShape& shape, const MeasurementGeometry& geometry,
                                       const LinkModel& model, bool stands);

// Mapped place of a radio, by its first reading.
std::optional<Eigen::Vector2d> place_of_radio(const LinkModel& model, const std::string& name);

}  // namespace muster::diagnosis
