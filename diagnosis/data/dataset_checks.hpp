// What is wrong with measured readings by themselves, before any model is asked.
#pragma once

#include "diagnosis/data/dataset.hpp"

namespace muster::diagnosis {

// Throws Error at the first reading that cannot be; adds to data.notes what is only odd.
void check_readings(Dataset& data);

}  // namespace muster::diagnosis
