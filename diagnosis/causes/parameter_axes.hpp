// Search range and start values of a cause's parameter, from its declaration and the span of the data.
#pragma once

#include <optional>

#include "diagnosis/causes/cause_shape.hpp"
#include "diagnosis/data/recorded_time.hpp"

namespace muster::diagnosis {

// `count` evenly spaced values from one end to the other.
std::vector<double> evenly(double from, double to, int count);
// A logarithmic axis between these bounds, clipped to the declared ones.
Axis logarithmic(const muster_param& declared, double lower, double upper, const std::vector<double>& values,
                 double step);

// Axis of a time or duration over the recorded time of the data; nothing if there is none. Angles range over a full
// turn, other numbers over their declared bounds. `alone`: the only parameter searched, so that its grid may be fine.
// `sampling` [s]: the interval between samples; no swing has a period below twice that.
std::optional<Axis> axis_over(const muster_param& declared, const RecordedTime& time, const CauseShape& shape,
                              bool alone, double sampling = 0);

}  // namespace muster::diagnosis
