#include "diagnosis/search/tail.hpp"

#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

namespace muster::search {

double log_tail(double gain, double freedom) {
  if (gain <= 0) return 0;
  const double a = freedom / 2, x = gain / 2;
  if (x < 400) return std::log(boost::math::gamma_q(a, x));
  double sum = 1, part = 1;  // Abramowitz and Stegun 6.5.32
  for (int k = 1; k <= 6; ++k) sum += part *= (a - k) / x;
  return (a - 1) * std::log(x) - x - std::lgamma(a) + std::log(sum);
}

}  // namespace muster::search
