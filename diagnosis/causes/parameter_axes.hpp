// Search range and start values of a cause's parameter, from its declaration and from the span of the data.
#pragma once

#include <optional>

#include "diagnosis/causes/cause_shape.hpp"
#include "diagnosis/data/span.hpp"

namespace muster::diagnosis {

// `count` values from one end to the other.
std::vector<double> evenly(double from, double to, int count);
// An axis of logarithms between these bounds, cut to the declared ones.
Axis logarithmic(const muster_param& declared, double lower, double upper, const std::vector<double>& values,
                 double step);

// Angles, times and durations over the data's span of time, and any other number over its declared bounds. `alone`: no
// other parameter is sought beside it, so that its grid may be fine. Nothing if the data have no span of time.
std::optional<Axis> axis_over(const muster_param& declared, const Span& time, const CauseShape& shape, bool alone);

}  // namespace muster::diagnosis
