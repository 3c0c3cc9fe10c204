// Round numbers along an axis.
#pragma once

#include <string>
#include <vector>

#include "scale.hpp"

namespace muster::plotting {

struct Tick {
  double value = 0;
  std::string label;
};

// Round values inside `range`: multiples of 1, 2 or 5 (2.5 where nothing else fits) times a power of ten. There are 4
// to `at_most` of them for at_most >= 8; fewer than 4 where at_most is smaller.
std::vector<Tick> ticks_within(Range range, int at_most = 9);

// The same on a logarithmic axis, range.low > 0: decades, or 1-2-5 within them, or round values for a narrow range.
std::vector<Tick> log_ticks_within(Range range, int at_most = 9);

// An axis range that contains `data` and ends on ticks, or close beyond the data where the next tick is far. A single
// value gets room on both sides.
Range axis_range(Range data);
Range log_axis_range(Range data);

// Length of a scale bar: the largest of 1, 2 and 5 times a power of ten that is at most `limit` > 0.
Tick round_length(double limit);

// Formats a number for readers: true minus sign, thin spaces between thousands, powers of ten instead of many zeros.
std::string number_label(double value, int decimals);

}  // namespace muster::plotting
