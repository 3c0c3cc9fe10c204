#include "interval.hpp"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

namespace muster::sweep {

double t_quantile(double probability, double degrees) {
  return boost::math::quantile(boost::math::students_t(degrees), probability);
}

Interval interval_of(const std::vector<double>& values) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  Interval result{0, none, none, none, none};
  double sum = 0;
  for (const double value : values) {
    if (!std::isnan(value)) sum += value, ++result.count;
  }
  if (result.count == 0) return result;
  const auto n = static_cast<double>(result.count);
  result.mean = sum / n;
  if (result.count == 1) return result;
  double squares = 0;
  for (const double value : values) {
    if (!std::isnan(value)) squares += (value - result.mean) * (value - result.mean);
  }
  result.deviation = std::sqrt(squares / (n - 1));
  const double half = t_quantile(0.5 + coverage / 2, n - 1) * result.deviation / std::sqrt(n);
  result.low = result.mean - half;
  result.high = result.mean + half;
  return result;
}

Interval paired_interval(const std::vector<double>& values, const std::vector<double>& first) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < values.size() && i < first.size(); ++i) differences.push_back(values[i] - first[i]);
  return interval_of(differences);
}

}  // namespace muster::sweep
