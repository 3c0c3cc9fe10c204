// Where places and radios in the data and those in the world contradict one another.
#pragma once

#include "diagnosis/data/dataset.hpp"
#include "diagnosis/radio/links/link_model.hpp"

namespace muster::diagnosis {

// Throws Error where x and y are exchanged: stations or readings that fit the world only the other way round. Returns
// notes on what is odd, such as a station that was measured elsewhere.
std::vector<std::string> check_places(const LinkModel& model, const Dataset& data);

// A note on radios of the data that the world lacks, with the names that they may mean; empty if there are none.
std::vector<std::string> notes_on_radios(const LinkModel& model, const Dataset& data);

// Names in quotes, the first five of them.
std::string list_of(const std::vector<std::string>& names);

}  // namespace muster::diagnosis
