// What a sample says of the mean behind it: Student's interval.
#pragma once

#include <vector>

namespace muster::sweep {

constexpr double coverage = 0.95;  // of an interval

// The number below which Student's t of so many degrees of freedom lies with that probability.
double t_quantile(double probability, double degrees);

// Bounds and deviation are NaN where the sample is too small for them, the mean where there is none.
struct Interval {
  std::size_t count = 0;
  double mean, deviation, low, high;
};

// NaN among the values is a run without one, and left out.
Interval interval_of(const std::vector<double>& values);

// Of the differences `values` less `first`, pair by pair; a pair that lacks one is left out. Under common random
// numbers they vary less than the values do.
Interval paired_interval(const std::vector<double>& values, const std::vector<double>& first);

}  // namespace muster::sweep
