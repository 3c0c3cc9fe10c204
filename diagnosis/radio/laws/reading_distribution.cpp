#include "diagnosis/radio/laws/reading_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>

namespace muster::diagnosis {
namespace {

constexpr double pi = 3.141592653589793;

// Density of 10 log10 of the mean power of n fades, each of mean 1: a noncentral chi-square with 2 n degrees of
// freedom.
double fading_density(double k_db, int n, double db) {
  const double k = std::max(std::pow(10, k_db / 10), 1e-4), g = std::pow(10, db / 10), count = n;
  const double x = 2 * count * std::sqrt(k * (1 + k) * g);
  const double order = count - 1;
  const double bessel = x < 300 ? std::log(std::max(std::cyl_bessel_i(order, x), 1e-300))
                                : x - 0.5 * std::log(2 * pi * x) - (4 * order * order - 1) / (8 * x);
  const double log_density =
      std::log(count * (1 + k)) + order / 2 * std::log((1 + k) * g / k) - count * (k + (1 + k) * g) + bessel;
  return std::exp(log_density) * g * std::log(10.0) / 10;
}

std::vector<double> fading_table(double k_db, int n, double lowest, double bin, std::size_t bins) {
  std::vector<double> table(bins, 0);
  const auto at = [&](std::size_t i) { return lowest + bin * (static_cast<double>(i) + 0.5); };
  if (k_db >= 40) {  // steady: all at 0 dB
    table[static_cast<std::size_t>(-lowest / bin)] = 1 / bin;
    return table;
  }
  for (std::size_t i = 0; i < bins; ++i) {
    if (at(i) < 25) table[i] = fading_density(k_db, n, at(i));
  }
  return table;
}

double mean_of(const std::vector<double>& table, double lowest, double bin, double* variance = nullptr) {
  double sum = 0, first = 0, second = 0;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double db = lowest + bin * (static_cast<double>(i) + 0.5);
    sum += table[i];
    first += table[i] * db;
    second += table[i] * db * db;
  }
  if (variance) *variance = second / sum - first * first / (sum * sum);
  return first / sum;
}

// Averages the table over the kernel's offsets, in table steps.
std::vector<double> mixed(const std::vector<double>& table, const std::vector<double>& places,
                          const std::vector<double>& weights) {
  std::vector<double> result(table.size(), 0);
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto by = static_cast<std::ptrdiff_t>(std::lround(places[k]));
    for (std::size_t i = 0; i < table.size(); ++i) {
      const std::ptrdiff_t to = static_cast<std::ptrdiff_t>(i) + by;
      if (to >= 0 && to < static_cast<std::ptrdiff_t>(table.size()))
        result[static_cast<std::size_t>(to)] += weights[k] * table[i];
    }
  }
  return result;
}

std::vector<double> with_channels(const std::vector<double>& table, const ReadingDistribution& law, double bin) {
  if (law.channel_sd <= 0) return table;
  const double count = law.channels, spacing = law.channel_sd * std::sqrt(12 / (count * count - 1));
  std::vector<double> places, weights(static_cast<std::size_t>(law.channels), 1 / count);
  for (int c = 0; c < law.channels; ++c) places.push_back(spacing * (c - (count - 1) / 2) / bin);
  return mixed(table, places, weights);
}

std::vector<double> with_outliers(const std::vector<double>& table, const ReadingDistribution& law, double bin) {
  if (law.outliers <= 0) return table;
  constexpr int parts = 41;
  std::vector<double> places{0}, weights{1 - law.outliers};
  for (int k = 0; k < parts; ++k) {
    places.push_back(law.half_width * (2.0 * k / (parts - 1) - 1) / bin);
    weights.push_back(law.outliers / parts);
  }
  return mixed(table, places, weights);
}

// Convolves the table with kernel values at whole bins about the middle one.
std::vector<double> smeared(const std::vector<double>& table, const std::vector<double>& kernel) {
  const std::size_t reach = kernel.size() / 2;
  std::vector<double> result(table.size(), 0);
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (table[i] == 0) continue;
    const std::size_t from = i < reach ? reach - i : 0, to = std::min(kernel.size(), table.size() + reach - i);
    for (std::size_t k = from; k < to; ++k) result[i + k - reach] += table[i] * kernel[k];
  }
  return result;
}

std::vector<double> normal_kernel(double variance, double bin) {
  const auto reach = static_cast<std::ptrdiff_t>(4.5 * std::sqrt(variance) / bin) + 1;
  std::vector<double> kernel;
  double sum = 0;
  for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
    const double z = static_cast<double>(k) * bin;
    kernel.push_back(std::exp(-z * z / (2 * variance)));
    sum += kernel.back();
  }
  for (double& v : kernel) v /= sum;
  return kernel;
}

// Uniform distribution over a step.
std::vector<double> box_kernel(double step, double bin) {
  const auto reach = static_cast<std::ptrdiff_t>(std::ceil(step / 2 / bin + 0.5));
  std::vector<double> kernel;
  for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
    const double left = (static_cast<double>(k) - 0.5) * bin, right = left + bin;
    kernel.push_back(std::max(0.0, std::min(right, step / 2) - std::max(left, -step / 2)) / step);
  }
  return kernel;
}

// Variance of fading with an integer K in dB; computed once for each n.
double tabled_variance(int k_db, int averaged) {
  static std::mutex lock;
  static std::map<std::pair<int, int>, double> known;
  const std::lock_guard guard(lock);
  const auto [place, missing] = known.try_emplace({k_db, averaged}, 0);
  if (missing) mean_of(fading_table(k_db, averaged, -60, 0.25, 360), -60, 0.25, &place->second);
  return place->second;
}

constexpr int lowest_k = -40, highest_k = 36;  // dB

}  // namespace

double fading_variance(double rician_k, int averaged) {
  const double k = std::clamp(rician_k, static_cast<double>(lowest_k), static_cast<double>(highest_k));
  const int below = std::min(static_cast<int>(std::floor(k)), highest_k - 1);
  const double low = std::log(tabled_variance(below, averaged)), high = std::log(tabled_variance(below + 1, averaged));
  return std::exp(low + (k - below) * (high - low));
}

double rician_k_of(double variance, int averaged) {
  double low = lowest_k, high = highest_k;
  if (!(variance <= fading_variance(low, averaged) && variance >= fading_variance(high, averaged)))
    return std::numeric_limits<double>::quiet_NaN();
  for (int round = 0; round < 30; ++round) {
    const double middle = (low + high) / 2;
    (fading_variance(middle, averaged) > variance ? low : high) = middle;
  }
  return (low + high) / 2;
}

ReadingDensities::ReadingDensities(const ReadingDistribution& law, double step, double lowest, double highest)
    : lowest_(lowest), top_(std::max(1.0, std::ceil((highest - lowest) / log_factor))) {
  constexpr int finer = 2;  // bins of the law itself, before smoothing
  constexpr double fine = bin / finer;
  const double start = first_db - bin / 2;
  std::vector<double> law_table = fading_table(law.rician_k, law.averaged, start, fine, bins * finer);
  law_table = with_outliers(with_channels(law_table, law, fine), law, fine);
  const double mean = mean_of(law_table, start, fine);
  if (step > 0) law_table = smeared(law_table, box_kernel(step, fine));
  double total = 0;
  for (const double v : law_table) total += v * bin / finer;
  std::vector<double> level(bins, 0);
  for (std::size_t i = 0; i < law_table.size(); ++i) {  // shifted by its mean, split between two bins
    const double place = (start + fine * (static_cast<double>(i) + 0.5) - mean - first_db) / bin;
    if (!(place >= 0 && place < bins - 1)) continue;
    const auto b = static_cast<std::size_t>(place);
    const double along = place - static_cast<double>(b), mass = law_table[i] / finer / total;
    level[b] += (1 - along) * mass;
    level[b + 1] += along * mass;
  }
  double variance = 0;
  for (std::size_t l = 0; l <= static_cast<std::size_t>(top_); ++l) {
    const double next = std::exp(lowest + log_factor * static_cast<double>(l));
    level = smeared(level, normal_kernel(next - variance, bin));
    variance = next;
    table_.insert(table_.end(), level.begin(), level.end());
  }
}

}  // namespace muster::diagnosis
