// What a single reading adds to the level of its place: fading, hopping channels, outliers; as densities in dB.
#pragma once

#include <vector>

namespace muster::diagnosis {

struct ReadingLaw {
  double rician_k = 60;                  // dB; -40: Rayleigh
  int averaged = 1;                      // independent fades whose power is averaged in one reading
  double outliers = 0, half_width = 20;  // share; dB
  double channel_sd = 0;                 // dB
  int channels = 3;
};

// Variance of fading in dB^2, without channels and outliers.
double fading_variance(double rician_k, int averaged);
// The K whose fading has this variance; NaN where none has.
double rician_k_of(double variance, int averaged);

// The law's density per dB about its own mean, widened by a normal spread and by the step of the readings.
class ReadingDensity {
 public:
  ReadingDensity(const ReadingLaw& law, double spread, double step);

  // log of the density; between table entries the nearest one.
  double log_at(double db) const {
    const double place = (db - lowest) / bin;
    if (!(place >= 0 && place < static_cast<double>(log_.size()))) return log_floor;
    return log_[static_cast<std::size_t>(place)];
  }

 private:
  static constexpr double lowest = -70, bin = 0.1;  // dB
  static constexpr double log_floor = -18.4;        // a hundred-millionth a dB: no law is trusted to its last tail
  static constexpr std::size_t bins = 1400;
  std::vector<double> log_;
};

}  // namespace muster::diagnosis
