// Thresholds of causes as candidates, for any kind of measurement.
//
// Above each constant: unit; meaning; origin; the test that fails if it is badly changed, as in
// diagnosis/inference/thresholds.hpp.
#pragma once

namespace muster::diagnosis::thresholds {

// share; of readings that a place must concern; chosen; none
inline constexpr double least_concern = 0.01;
// share; of a column's length that the base model must leave; chosen; none
inline constexpr double least_left = 1e-6;
// cycles; of a swing, over the data; chosen; CauseShape.SwingsOfManyCyclesAreSought
inline constexpr double most_cycles = 128;
// s; shortest period of a swing, unless the data are short; chosen; none
inline constexpr double shortest_period = 4;
// share; of the data before which a jump is an offset; chosen; none
inline constexpr double earliest_jump = 0.08;
// share; of the data after which a jump is an offset; chosen; none
inline constexpr double latest_jump = 0.92;
// share; of the data within which what settles is a jump; chosen; none
inline constexpr double shortest_settling = 0.1;

}  // namespace muster::diagnosis::thresholds
