// Covariance of the line integrals that radio.fading's shadowing consists of.
#pragma once

#include <cstdint>

namespace muster {

// out[i]: covariance of the shadowing of links a[i] and b[i] over the variance of links that are much longer than the
// `decorrelation` distance [m]. For a loss field of correlation exp(-r / D) it is
//
//     (1 / (2 D sqrt(d_a d_b))) * integral over both links of exp(-r / D),
//
// d being their lengths (Agrawal and Patwari, IEEE Trans. Wireless Comm. 8(8), 2009). `ends`: one row a link, x y z of
// one end, then of the other, in m. Within 1e-3; 0 where the links are more than 14 D apart.
void covariance_of_line_integrals(double decorrelation, const double* ends, const uint32_t* a, const uint32_t* b,
                                  uint32_t count, double* out);

}  // namespace muster
