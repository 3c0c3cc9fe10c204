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

// As many arrivals come in a time of `mean` where the waiting time for the last, of a gamma distribution, is shorter.
double poisson_tail(double mean, int count) { return boost::math::gamma_p(count, mean); }

}  // namespace muster::diagnosis
