// What a single reading adds: fading, hopping channels, outliers; as draws and as densities in dB.
#pragma once

#include "exam/ground_truth.hpp"

namespace muster::exam {

// dB of one reading's fading, channel and outlier.
double draw_reading(const ReadingLaw& law, Random& random);

struct Moments {
  double mean = 0, variance = 0;  // dB, dB^2; of the law without outliers and channels
};
Moments fading_moments(const ReadingLaw& law);

// Rician factor in dB of single fades with the same variance as the law's averaged ones: what a world file can say.
double equivalent_rician_k(const ReadingLaw& law);

// 2 x the Kullback-Leibler divergence of readings, true against stated, quantised to 1 dB, means set equal: a fit of
// the loss at 1 m sees to that. Each reading's level is known but for a Gaussian error of `level_deviations` dB, which
// the stated law may take to be larger or smaller, all by one factor: nobody states how much shadowing varies.
double reading_lambda(const ReadingLaw& truth, const ReadingLaw& stated, const std::vector<double>& level_deviations);

}  // namespace muster::exam
