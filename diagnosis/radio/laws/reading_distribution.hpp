// Distribution of a single reading about the level of its place: fading, hopping channels, outliers. Densities in dB.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "diagnosis/radio/laws/reading_law.hpp"

namespace muster::diagnosis {

// A declared law at values of its parameters.
struct LawPart {
  std::shared_ptr<const ReadingLaw> law;
  std::vector<double> params;
};

struct ReadingDistribution {
  LawPart base{};      // the law that replaces others; null: steady
  uint32_t draws = 1;  // independent draws of the base whose power is averaged in one reading
  std::vector<LawPart> added{};
  double noise = 0;  // dB, standard deviation of normal noise beside the laws
};

// Variance in dB^2 of one reading with its rounding; `step`: dB between codes.
double variance_of(const ReadingDistribution& law, double step);
// The same of its base alone.
double base_variance(const ReadingDistribution& law);

// The law's densities per dB about its own mean, convolved with the readings' step and with normal spreads.
class ReadingDensities {
 public:
  // For spreads with log variances in this range.
  ReadingDensities(const ReadingDistribution& law, double step, double lowest, double highest);

  double log_at(double db, double log_variance) const { return std::log(at(db, log_variance, std::exp(log_variance))); }
  // The density; the variance is asked for, too, for a logarithm takes longer than all else here.
  double at(double db, double log_variance, double variance) const {
    const double place = (db - first_db) / bin;
    if (!(place >= 0 && place < bins - 1)) return anything;
    const auto b = static_cast<std::size_t>(place);
    const double along = place - static_cast<double>(b);
    const double level = std::min(std::max((log_variance - lowest_) / log_factor, 0.0), top_);
    const auto l = std::min(static_cast<std::size_t>(level), variances_.size() - 2);
    const double part = std::min(std::max((variance - variances_[l]) / (variances_[l + 1] - variances_[l]), 0.0), 1.0);
    const double* const low = table_.data() + l * bins + b;
    const double* const high = low + bins;
    const double at_low = low[0] + along * (low[1] - low[0]), at_high = high[0] + along * (high[1] - high[0]);
    return at_low + part * (at_high - at_low) + anything;
  }

 private:
  static constexpr double first_db = -65, bin = 0.2, log_factor = 0.4;
  static constexpr std::size_t bins = 601;
  // Floor of all densities: no law is exact in its far tails.
  static constexpr double anything = 1e-8;  // per dB
  double lowest_, top_;                     // log variance of the first level; number of levels after it
  std::vector<double> variances_, table_;   // of the levels
};

// By how many dB two readings of one place differ.
class ReadingsApart {
 public:
  // `seen`: dB, by which pairs do. The field lies between them, too: as much of it, normal, as makes half of the pairs
  // differ by as much as half of those seen do. None seen: no field.
  ReadingsApart(const ReadingDistribution& law, double step, const Eigen::VectorXd& seen);

  // Probability that two differ by more than this, dB.
  double beyond(double db) const;

 private:
  static constexpr double bin = 0.25;

  void sum_up(const std::vector<double>& apart);

  std::vector<double> beyond_;  // by bin: half a bin, one and a half ...
};

}  // namespace muster::diagnosis
