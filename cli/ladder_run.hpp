// A world run on each rung of the fidelity ladder, and what came of its mission there.
#pragma once

#include "run_options.hpp"

namespace muster::cli {

struct LadderWords : RunOptions {
  std::string world;
  std::vector<std::string> metrics;
  std::string measured;  // a log of poses: the last body's
};

// Prints a table, or JSON; with --out also ladder.csv and ladder.svg. Throws Error.
Exit run_ladder(LadderWords words);

}  // namespace muster::cli
