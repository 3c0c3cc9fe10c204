// A smooth that one or two named causes of its covariate explain gives way to them.
#pragma once

#include "diagnosis/search/bench.hpp"

namespace muster::search {

void replace_smooths(Bench& bench);

}  // namespace muster::search
