// Twins: the two directions of a link, measured at one moment. Whatever is reciprocal is the same in both: shadowing,
// multipath, the body of whoever stands in between. Treated as two readings, each fade would count twice.
#pragma once

#include "diagnosis/radio/links/link_rows.hpp"

namespace muster::diagnosis {

// Sets `twin` and `twin_variance` where the scatter of twins is shared: half their difference varies less from one
// moment to the next than their mean does. `residual`: dB, one a reading; not finite where nothing was heard. `step`:
// dB, between the levels that are recorded; 0: all are.
void find_twins(LinkReadings& readings, const Eigen::VectorXd& residual, double step = 0);

}  // namespace muster::diagnosis
