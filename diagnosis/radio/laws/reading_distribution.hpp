// Distribution of a single reading about the level of its place: fading, hopping channels, outliers. Densities in dB.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace muster::diagnosis {

struct ReadingDistribution {
  double rician_k = 60;                  // dB; -40: Rayleigh
  int averaged = 1;                      // independent fades whose power is averaged in one reading
  double outliers = 0, half_width = 20;  // share; dB
  double channel_sd = 0;                 // dB
  int channels = 3;
};

// Variance of fading in dB^2, without channels and outliers.
double fading_variance(double rician_k, int averaged);
// The K with this variance of fading; NaN if there is none.
double rician_k_of(double variance, int averaged);

// The law's densities per dB about its own mean, convolved with the readings' step and with normal spreads.
class ReadingDensities {
 public:
  // For spreads with log variances in this range.
  ReadingDensities(const ReadingDistribution& law, double step, double lowest, double highest);

  double log_at(double db, double log_variance) const {
    const double place = (db - first_db) / bin;
    if (!(place >= 0 && place < bins - 1)) return log_anything;
    const auto b = static_cast<std::size_t>(place);
    const double along = place - static_cast<double>(b);
    const double level = std::min(std::max((log_variance - lowest_) / log_factor, 0.0), top_);
    const auto l = std::min(static_cast<std::size_t>(level), static_cast<std::size_t>(top_) - 1);
    const double part = std::expm1((level - static_cast<double>(l)) * log_factor) / std::expm1(log_factor);
    const double* const low = table_.data() + l * bins + b;
    const double* const high = low + bins;
    const double at_low = low[0] + along * (low[1] - low[0]), at_high = high[0] + along * (high[1] - high[0]);
    return std::log(at_low + part * (at_high - at_low) + anything);
  }

 private:
  static constexpr double first_db = -65, bin = 0.2, log_factor = 0.4;
  static constexpr std::size_t bins = 601;
  // Floor of all densities: no law is exact in its far tails.
  static constexpr double anything = 1e-8, log_anything = -18.42;  // per dB
  double lowest_, top_;  // log variance of the first level; number of levels after it
  std::vector<double> table_;
};

}  // namespace muster::diagnosis
