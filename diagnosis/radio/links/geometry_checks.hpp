// Checks places and radios of the data against those of the world.
#pragma once

#include "diagnosis/data/dataset.hpp"
#include "diagnosis/radio/links/link_model.hpp"

namespace muster::diagnosis {

// Throws Error if x and y are exchanged: stations or readings that fit the world only after the exchange. Returns notes
// on oddities, such as a station measured at another place.
std::vector<std::string> check_places(const LinkModel& model, const Dataset& data);

// A note on radios of the data that the world lacks, with the nearest names; empty if there are none.
std::vector<std::string> notes_on_radios(const LinkModel& model, const Dataset& data);

// Names in quotes, the first five of them.
std::string list_of(const std::vector<std::string>& names);

}  // namespace muster::diagnosis
