// Tests each link for intermittent blockage (people crossing) at unknown times.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"
#include "diagnosis/radio/laws/fading_tests.hpp"

namespace muster::diagnosis {

// One a reading: true for readings that take part in the test.
using RowMask = Eigen::Array<bool, Eigen::Dynamic, 1>;

struct Blockage {
  int radio = -1, other = -1;  // indices into the set `radio`
  std::size_t links = 0;       // scanned: those with at least 40 rows that take part
  LawTest test;                // its values: loss, share, duration
  bool is_slight = false;      // one or two passages, or a few nats: dips that a field may have
};

// The likeliest link, loss, share and duration. Each link is scanned with dips of several widths and losses: the
// likelihood ratio of blockages at unknown times, averaged over both, against none.
//
// The null is the same scan of shuffled whitened residuals: shuffles keep the skewness of errors and break up bursts.
// It is also compared with the scan of the sign-flipped residual without the blockages. People only lower levels; a
// misfit of the field raises them as often. Rows with an excluded reading take no part: near a clip levels are
// truncated on one side, which resembles bursts.
Blockage blockage_test(const inference::ModelState& state, const LinkReadings& readings, const RowMask& asked);

}  // namespace muster::diagnosis
