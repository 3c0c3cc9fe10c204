// Distribution of a single reading about the level of its place: fading, hopping channels, outliers. Densities in dB.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <compare>
#include <memory>
#include <vector>

#include "diagnosis/radio/laws/reading_law.hpp"

namespace muster::diagnosis {

// A declared law at values of its parameters.
struct LawPart {
  std::shared_ptr<const ReadingLaw> law;
  std::vector<double> params;

  friend auto operator<=>(const LawPart&, const LawPart&) = default;
};

struct ReadingDistribution {
  LawPart base{};      // the law that replaces others; null: steady
  uint32_t draws = 1;  // independent draws of the base whose power is averaged in one reading
  std::vector<LawPart> added{};
  double noise = 0;  // dB, standard deviation of normal noise beside the laws

  friend auto operator<=>(const ReadingDistribution&, const ReadingDistribution&) = default;
};

// Variance in dB^2 of one reading with its rounding; `step`: dB between codes.
double variance_of(const ReadingDistribution& law, double step);
// The same of its base alone.
double base_variance(const ReadingDistribution& law);

// The law's densities per dB about its own mean, convolved with the readings' step and with normal spreads. What a law
// yields at a spread depends on nothing that was asked before.
class ReadingDensities {
 public:
  ReadingDensities(const ReadingDistribution& law, double step);

  // To be called before densities of spreads up to this log variance are asked for; of wider ones they are those there.
  void reach(double log_variance);

  double log_at(double db, double log_variance) const { return std::log(at(db, log_variance, std::exp(log_variance))); }
  // The density; the variance is asked for, too, for a logarithm takes longer than all else here.
  double at(double db, double log_variance, double variance) const {
    const double place = (db - first_db) / bin;
    if (!(place >= 0 && place < bins - 1)) return anything;
    const auto b = static_cast<std::size_t>(place);
    const double along = place - static_cast<double>(b);
    const auto l = std::min(static_cast<std::size_t>(std::max((log_variance - lowest) / log_factor + 1, 0.0)),
                            variances_.size() - 2);
    const double part = std::min(std::max((variance - variances_[l]) / (variances_[l + 1] - variances_[l]), 0.0), 1.0);
    const double* const low = table_.data() + l * bins + b;
    const double* const high = low + bins;
    const double at_low = low[0] + along * (low[1] - low[0]), at_high = high[0] + along * (high[1] - high[0]);
    return at_low + part * (at_high - at_low) + anything;
  }

 private:
  static constexpr double first_db = -65, bin = 0.2;
  static constexpr std::size_t bins = 601;
  // Log variances of the levels after that without a spread: from a tenth of a bin to half of all bins.
  static constexpr double lowest = -8, highest = 8, log_factor = 0.4;
  // Floor of all densities: no law is exact in its far tails.
  static constexpr double anything = 1e-8;  // per dB

  void add_level();

  std::vector<double> variances_, table_;  // of the levels
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
