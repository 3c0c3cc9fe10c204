// Where places and radios in the data and those in the world contradict one another.
#pragma once

#include "diagnosis/data/dataset.hpp"
#include "diagnosis/radio/links/link_model.hpp"

namespace muster::diagnosis {

// Throws Error where x and y are exchanged: stations or readings that fit the world only the other way round. Adds to
// data.notes what is odd, such as a station that was measured elsewhere.
void check_places(const LinkModel& model, Dataset& data);

// Adds to data.notes which radios of the data are none of the world's, and whom of these that may mean.
void note_radios(const LinkModel& model, Dataset& data);

// Names in quotes, the first five of them.
std::string list_of(const std::vector<std::string>& names);

}  // namespace muster::diagnosis
