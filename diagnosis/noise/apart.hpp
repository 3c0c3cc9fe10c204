// How far apart two rows lie for the field.
#pragma once

#include "diagnosis/noise/rows.hpp"

namespace muster::noise {

constexpr double own_share = mean_of_three / 2;  // of its stretch: half the mean distance of a row's three readings

struct Apart {
  double place, both;  // m: between places, and between both ends
};

// Their middles: a smooth field changes by hardly more along a row than its middle tells.
Apart middles_apart(const Sites& sites, Index one, Index other);

// The mean distance of their readings, less half of what each has within: of a field with correlation exp(-h), means
// over the rows are correlated by exp of minus this, up to a factor for each row. It is of negative type, as distances
// are, so that this is a correlation whatever way the rows run (Schoenberg 1938).
Apart readings_apart(const Sites& sites, Index one, Index other);

}  // namespace muster::noise
