// Checks of measured readings that need no model.
#pragma once

#include "diagnosis/data/dataset.hpp"

namespace muster::diagnosis {

// Throws Error at the first impossible reading; adds oddities to data.notes.
void check_readings(Dataset& data);

}  // namespace muster::diagnosis
