// Numbers of the data that are legal and look like another unit, another site or another world.
#pragma once

#include "diagnosis/data/dataset.hpp"
#include "diagnosis/radio/links/link_model.hpp"

namespace muster::diagnosis {

// Questions about places far outside of the plan of the world's walls (centimetres, degrees, another building), heights
// far above it, levels that no distance changes, and walls counted of a material that the world has not. Empty where
// there is nothing to doubt.
std::vector<std::string> doubts_of(const LinkModel& model, const Dataset& data);

}  // namespace muster::diagnosis
