// Tails of the null distribution of a deviance drop.
#pragma once

namespace muster::search {

// log P(chi-square with `freedom` degrees of freedom > gain), also where the probability itself would vanish.
double log_tail(double gain, double freedom);

}  // namespace muster::search
