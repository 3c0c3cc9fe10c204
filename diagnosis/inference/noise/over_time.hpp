// Errors that are correlated over time instead of over places: what stands still for days sees people, doors and air
// that change, at each site by themselves. The rows of a site are then one series; what all of them share is the
// share fixed at the site (recurring_sites.hpp), and the rest decorrelates from moment to moment.
#pragma once

#include <optional>

#include "diagnosis/inference/noise/recurring_sites.hpp"

namespace muster::noise {

// Seconds of one unit of the decorrelation distance over time, such that its prior lies between the step and the
// length of a series: of its mean step, and of its median one where pauses or bursts make that another. None unless
// nearly all rows recur at sites, each often enough for a correlation over time to be seen. `times`: of the rows, s.
std::vector<double> time_units(const RecurringSites& recurring, const Sites& sites, const std::vector<double>& times);

// The sites with the series and moments of their rows.
Sites over_time(Sites sites, const std::vector<double>& times, double unit);

// Sites whose places are their moments, and whose groups are their series; none where errors are over places.
std::optional<Sites> moments_of(const Sites& sites);

}  // namespace muster::noise
