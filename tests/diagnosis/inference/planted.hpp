// Many worlds with one effect planted, or none: how often the search is right.
#pragma once

#include <array>

#include "diagnosis/inference/assess/search.hpp"
#include "tests/diagnosis/inference/causes.hpp"

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

enum class Field { stated, unstated };  // whether the world says how large its shadowing is, and how far it reaches

// Worlds from seed `first` on; `cause` empty: nothing is planted. lambda is the planted effect's whitened energy.
Tally planted(const std::string& cause, double lambda, uint64_t first, int worlds, Index readings, Shape shape,
              Field field = Field::stated);

// How often a cause is named at lambda 60, measured on 60 worlds that no test uses; the goal is 0.95 for each. `kind`
// counts a place of the other shape (a wall called an obstacle) as found.
struct Rate {
  const char* cause;
  double found, kind;
};
inline constexpr std::array rates{Rate{"tx_offset", 0.72, 0.72}, Rate{"rx_offset", 0.98, 0.98},
                                  Rate{"antenna_rx", 0.97, 0.97}, Rate{"step", 0.83, 0.83},
                                  Rate{"unmapped_wall", 0.91, 0.97}};

// The least number of successes that a chance of `p` each leaves likely: less happens once in a thousand.
int least_successes(int trials, double p);

}  // namespace muster::synthetic
