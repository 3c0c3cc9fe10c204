#include "diagnosis/inference/state/null_tail.hpp"

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

namespace muster::inference {

double log_tail(double gain, double freedom) {
  if (gain <= 0) return 0;
  const double a = freedom / 2, x = gain / 2;
  if (x < 400) return std::log(boost::math::gamma_q(a, x));
  double sum = 1, part = 1;  // Abramowitz and Stegun 6.5.32
  for (int k = 1; k <= 6; ++k) sum += part *= (a - k) / x;
  return (a - 1) * std::log(x) - x - std::lgamma(a) + std::log(sum);
}

double log_p_of_both(double log_p, double other) { return log_p + other + std::log1p(-log_p - other); }

double skew_charge(double z, double skewness) {
  if (skewness < 0.01 || z <= 0 || z > 20) return 0;
  const double shape = 4 / (skewness * skewness);
  const double skewed = boost::math::gamma_q(shape, shape + z * std::sqrt(shape));
  return std::max(0.0, std::log(std::max(skewed, 1e-300)) - log_tail(z * z, 1) + std::log(2.0));
}

}  // namespace muster::inference
