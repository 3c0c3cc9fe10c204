// Where the places in the data and those in the world contradict one another.
#pragma once

#include "diagnosis/dataset.hpp"
#include "diagnosis/model.hpp"

namespace muster::diagnosis {

// Throws Error where x and y are exchanged: stations or readings that fit the world only the other way round. Adds to
// data.notes what is odd, such as a station that was measured elsewhere.
void check_places(const LinkModel& model, Dataset& data);

}  // namespace muster::diagnosis
