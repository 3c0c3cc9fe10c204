// Tails of the null distribution of a deviance drop.
#pragma once

namespace muster::inference {

// log P(chi-square with `freedom` degrees of freedom > gain), valid also where the probability itself underflows.
double log_tail(double gain, double freedom);

// Fisher's combination of two independent tests.
double log_p_of_both(double log_p, double other);

// Log ratio, nats, of a score's density at z standard deviations: a gamma variable with this skewness against the
// normal one. Not below zero.
double skew_charge(double z, double skewness);

}  // namespace muster::inference
