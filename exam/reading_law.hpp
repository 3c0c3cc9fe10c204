// Law of a single reading about its level: fading, hopping channels, outliers. Draws, and densities in dB.
#pragma once

#include "exam/ground_truth.hpp"

namespace muster::exam {

// Draws fading, channel and outlier of one reading, dB.
double draw_reading(const ReadingLaw& law, Random& random);

struct Moments {
  double mean = 0, variance = 0;  // dB, dB^2; of the law without outliers and channels
};
Moments fading_moments(const ReadingLaw& law);

// Rician factor in dB of single fades with the variance of the law's averaged ones, for the world file.
double equivalent_rician_k(const ReadingLaw& law);

// 2 x the Kullback-Leibler divergence of readings quantised to 1 dB, true against stated. Means are equal, as after a
// fit of the loss at 1 m. Each reading's level has a Gaussian error of `level_deviations` dB. The stated law may
// scale all of these by one factor, since the size of shadowing is unknown.
double reading_lambda(const ReadingLaw& truth, const ReadingLaw& stated, const std::vector<double>& level_deviations);

}  // namespace muster::exam
