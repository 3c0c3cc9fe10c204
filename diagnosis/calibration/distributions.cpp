#include "diagnosis/calibration/distributions.hpp"

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/gamma.hpp>

namespace muster::diagnosis {

double fisher_tail(double numerator_freedom, double denominator_freedom, double x) {
  return boost::math::cdf(boost::math::complement(boost::math::fisher_f(numerator_freedom, denominator_freedom), x));
}

double student_tail(double freedom, double x) {
  return boost::math::cdf(boost::math::complement(boost::math::students_t(freedom), x));
}

// A chi-square is twice a gamma value of half its freedom.
double chi_square_tail(double freedom, double x) { return boost::math::gamma_q(freedom / 2, x / 2); }

double chi_square_quantile(double freedom, double probability) {
  return 2 * boost::math::gamma_p_inv(freedom / 2, probability);
}

// As many arrivals come in a time of `mean` where the waiting time for the last, of a gamma distribution, is shorter.
double poisson_tail(double mean, int count) { return boost::math::gamma_p(count, mean); }

}  // namespace muster::diagnosis
