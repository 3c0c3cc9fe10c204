// Bursts of loss on one link: somebody crosses the line between two radios, again and again, at times that nobody
// knows.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"
#include "diagnosis/radio/laws/fading_tests.hpp"

namespace muster::diagnosis {

// One a reading: whether it says anything of passages.
using Asked = Eigen::Array<bool, Eigen::Dynamic, 1>;

struct Blockage {
  int radio = -1, other = -1;  // numbers of the set `radio`
  std::size_t links = 0;       // that were scanned: those with 40 rows that are asked
  LawTest test;
};

// The likeliest link, loss, share and duration. Each link is scanned with dips of some widths and losses: the
// likelihood ratio of passages at unknown times, averaged over both, against nobody. Its p-value comes from the same
// scan of what the model leaves, shuffled in whitened space: that keeps how skewed errors are, and breaks bursts up;
// and from the scan of the mirror image of what the passages leave: people lower levels, a misfit of the field raises
// them as often. Rows with a reading that is not asked take no part: near a clip levels are cut off on one side, which
// looks like bursts.
Blockage blockage_test(const inference::ModelState& state, const LinkReadings& readings, const Asked& asked);

}  // namespace muster::diagnosis
