// Many worlds with one effect planted, or none: how often the search is right.
#pragma once

#include "diagnosis/search/search.hpp"
#include "tests/search/causes.hpp"

namespace muster::synthetic {

struct Tally {
  int worlds = 0;
  int found = 0;        // the planted cause is the strongest name
  int kin = 0;          // another one of the same class of places is: a wall taken for a disk
  int pieces = 0;       // one object was named more than once
  int wrong = 0;        // worlds with any name but these
  int unexplained = 0;  // worlds with an unexplained structure
  std::string misses;   // what was found instead, for the message
};

// Worlds from seed `first` on; `cause` empty: nothing is planted. lambda is the planted effect's whitened energy.
Tally planted(const std::string& cause, double lambda, uint64_t first, int worlds, Index readings, Shape shape);

// The least number of successes that a chance of `p` each leaves likely: less happens once in a thousand.
int least_successes(int trials, double p);

}  // namespace muster::synthetic
