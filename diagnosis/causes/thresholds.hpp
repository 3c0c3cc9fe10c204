// Thresholds of causes as candidates, for any kind of measurement.
//
// Above each constant: unit; meaning; origin; the test that fails if it is badly changed, as in
// diagnosis/inference/thresholds.hpp.
#pragma once

#include <cstddef>

namespace muster::diagnosis::thresholds {

// share; of readings that a place must concern; chosen; none
inline constexpr double least_concern = 0.01;
// share; of a column's length that the base model must leave; chosen; none
inline constexpr double least_left = 1e-6;
// cycles; of a swing, over the data; chosen; CauseShape.SwingsOfManyCyclesAreSought
inline constexpr double most_cycles = 128;
// cycles; of a swing, over the data, up to which it is sought however short the data are; chosen;
// CauseShape.SwingsOfManyCyclesAreSought
inline constexpr double fewest_cycles = 32;
// s; shortest period of a swing, unless the data are short; chosen; none
inline constexpr double shortest_period = 4;
// share; of the data before which a jump is an offset; chosen; FieldLog.AStepIsNamedNearTheEndOfALog
inline constexpr double earliest_jump = 0.02;
// share; of the data after which a jump is an offset; chosen; none
inline constexpr double latest_jump = 0.98;
// share; of the data within which what settles is a jump; chosen; none
inline constexpr double shortest_settling = 0.1;
// rows; up to which each has all start values; chosen; none
inline constexpr std::size_t few_rows = 8;
// values; of a long axis that each of more rows has; chosen; none
inline constexpr std::size_t most_values_of_many_rows = 60;
// count; start values of all axes of a cause together; chosen; none
inline constexpr std::size_t most_starts = 400;
// Hz; lowest carrier sought where the world has none; chosen; Carrier.IsSoughtWhereTheWorldHasNone
inline constexpr double lowest_carrier = 1e8;
// Hz; highest one; chosen; Carrier.IsSoughtWhereTheWorldHasNone
inline constexpr double highest_carrier = 1e10;
// ratio; of neighbouring carriers, a quarter of a turn at ten wavelengths; derived;
// Carrier.IsSoughtWhereTheWorldHasNone
inline constexpr double carrier_ratio = 1.05;

}  // namespace muster::diagnosis::thresholds
