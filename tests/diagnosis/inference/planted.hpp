// Success rates of the search over many worlds with one planted effect, or none.
#pragma once

#include <array>

#include "diagnosis/inference/assess/search.hpp"
#include "tests/diagnosis/inference/causes.hpp"

namespace muster::synthetic {

struct Tally {
  int worlds = 0;
  int found = 0;        // the planted cause is the strongest finding
  int kin = 0;          // another cause of the same class of places is: a wall taken for a disk
  int pieces = 0;       // one object was named more than once
  int wrong = 0;        // worlds with any other named cause
  int unexplained = 0;  // worlds with an unexplained effect
  std::string misses;   // wrong findings, for the message
};

enum class Field { stated, unstated };  // true if the world states size and decorrelation distance of its shadowing

// Runs worlds from seed `first` on; `cause` empty: no effect. lambda: whitened energy of the planted effect.
Tally planted(const std::string& cause, double lambda, uint64_t first, int worlds, Index readings, Shape shape,
              Field field = Field::stated);

// Rate of a cause's being named at lambda 60, measured on 60 worlds outside the tests; the goal is 0.95 for each.
// `kind` counts a place of the other shape (a wall called an obstacle) as found.
struct Rate {
  const char* cause;
  double found, kind;
};
inline constexpr std::array rates{Rate{"tx_offset", 0.72, 0.72}, Rate{"rx_offset", 0.98, 0.98},
                                  Rate{"antenna_rx", 0.97, 0.97}, Rate{"step", 0.83, 0.83},
                                  Rate{"unmapped_wall", 0.91, 0.97}};

// Least number of successes at probability `p` each: fewer happen once in a thousand.
int least_successes(int trials, double p);

}  // namespace muster::synthetic
