// Tests the links of a standing network together for people who walk about in it.
#pragma once

#include "diagnosis/radio/laws/fading_tests.hpp"

namespace muster::diagnosis {

struct WalkersTest {
  std::size_t links = 0;  // tested: both ends stand, and readings follow each other within seconds
  LawTest test;           // its values: loss, share, duration
};

// People who walk about change the level of one link after the other, each for as long as they are near it: successive
// readings of a link are then off together. `residual`: dB, of each reading; NaN takes no part.
// Both directions of a link tell what its radios share, but of a pair of twins one reading counts.
//
// - What readings share with those of other links of the same radio at that moment is the radio's, and is taken off:
//   a link takes part where each of its radios has three others.
// - Null: any order of a link's readings. Readings that are off one by one, however far, follow no order.
// - Without the pair of radios whose levels change most it must hold, too: a door moves beside one link.
// - Slow changes of a link are shared as much by readings ten seconds apart: what counts is the difference.
//
// Loss, share and duration are those of a process of two states (free, blocked) with the covariance, the skewness and
// the decay that successive readings share; intervals by links drawn with replacement (Efron 1979).
WalkersTest walkers_test(const LinkReadings& readings, const Eigen::VectorXd& residual);

}  // namespace muster::diagnosis
