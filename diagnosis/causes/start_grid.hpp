// Where a search for a cause begins.
#pragma once

#include <optional>

#include "diagnosis/causes/cause_shape.hpp"
#include "diagnosis/radio/links/measurement_geometry.hpp"

namespace muster::diagnosis {

// Thetas to begin with: all rows, with all places and values of axes that suit the cause's shape. Walls and things
// (`stands`) lie closer together than what fills a part of the plan.
std::vector<Eigen::VectorXd> starts_of(const CauseShape& shape, const Survey& survey, const LinkModel& model,
                                       bool stands);

// Where the map has a radio, by its first reading.
std::optional<Eigen::Vector2d> place_of_radio(const LinkModel& model, const std::string& name);

}  // namespace muster::diagnosis
