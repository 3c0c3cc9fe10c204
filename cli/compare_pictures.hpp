// A picture of how runs diverge: the ways of their robots, and differences over time.
#pragma once

#include "compared_run.hpp"

namespace muster::cli {

// No panels where nothing differs.
plotting::Figure comparison_figure(const std::vector<ComparedRun>& runs);

}  // namespace muster::cli
