// Sample statistics with their standard errors.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace muster {

struct Moments {
  double mean = 0, variance = 0;
  double mean_error = 0;  // standard error, for independent samples
};

inline Moments moments(const std::vector<double>& samples) {
  Moments result;
  for (const double x : samples) result.mean += x / static_cast<double>(samples.size());
  for (const double x : samples) {
    result.variance += (x - result.mean) * (x - result.mean) / static_cast<double>(samples.size() - 1);
  }
  result.mean_error = std::sqrt(result.variance / static_cast<double>(samples.size()));
  return result;
}

inline double to_db(double gain) { return 10 * std::log10(gain); }

// Kolmogorov's distance to a distribution function, times the root of the sample size: above 1.95 once in a thousand.
template <class Distribution>
double kolmogorov(std::vector<double> samples, const Distribution& below) {
  std::sort(samples.begin(), samples.end());
  const double n = static_cast<double>(samples.size());
  double worst = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double expected = below(samples[i]);
    worst = std::max(
        {worst, std::abs(expected - static_cast<double>(i) / n), std::abs(expected - static_cast<double>(i + 1) / n)});
  }
  return worst * std::sqrt(n);
}

}  // namespace muster
