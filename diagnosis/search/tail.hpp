// Tails of the null distribution of a deviance drop.
#pragma once

namespace muster::search {

// log P(chi-square with `freedom` degrees of freedom > gain), also where the probability itself would vanish.
double log_tail(double gain, double freedom);

// By how many nats a score of z standard deviations is likelier if its distribution is skewed towards it: that of a
// gamma variable with this skewness against the normal one. Not below zero.
double skew_charge(double z, double skewness);

}  // namespace muster::search
