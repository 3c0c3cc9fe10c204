// Readings of a radio that was set to several powers while it was measured, as the receiver gave them.
#pragma once

#include "diagnosis/data/dataset.hpp"

namespace muster::diagnosis {

// Refers readings to the middle of the powers in their column power[dBm] where levels rise with it decibel by decibel,
// at equal distances on one link, and notes it. Levels that do not follow it had been referred to a nominal power
// before, as docs/reference/table_format.md asks. A power that is the same in all readings of each link tells nothing.
void refer_to_one_power(Dataset& data);

}  // namespace muster::diagnosis
