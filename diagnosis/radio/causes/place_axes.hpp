// Search ranges of lengths, heights and losses of a cause on radio links.
#pragma once

#include "diagnosis/causes/parameter_axes.hpp"
#include "diagnosis/radio/links/measurement_geometry.hpp"

namespace muster::diagnosis {

// As axis_over(), with lengths from the links and heights from the radios. Nothing if the data cannot identify it.
std::optional<Axis> axis_of(const muster_param& declared, const MeasurementGeometry& geometry, const CauseShape& shape,
                            bool alone);

}  // namespace muster::diagnosis
