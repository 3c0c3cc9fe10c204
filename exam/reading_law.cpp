#include "exam/reading_law.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace muster::exam {
namespace {

constexpr double bin = 0.25, lowest = -60;  // dB
constexpr std::size_t bins = 400;           // up to +40 dB
using Density = std::vector<double>;

double from_db(double db) { return std::pow(10, db / 10); }

// Density of 10 log10 of Rician power with mean 1 (Rice 1945).
double rician_density(double k, double db) {
  const double g = from_db(db), x = 2 * std::sqrt(k * (1 + k) * g);
  const double exponent = -k - (1 + k) * g;
  const double bessel = x < 500 ? std::log(std::cyl_bessel_i(0.0, x)) : x - 0.5 * std::log(6.283185307179586 * x);
  return (1 + k) * g * std::log(10.0) / 10 * std::exp(exponent + bessel);
}

Density rician(double k_db) {
  Density result(bins);
  for (std::size_t i = 0; i < bins; ++i)
    result[i] = rician_density(from_db(k_db), lowest + bin * (static_cast<double>(i) + 0.5)) * bin;
  return result;
}

Moments moments(const Density& d) {
  double sum = 0, first = 0, second = 0;
  for (std::size_t i = 0; i < bins; ++i) {
    const double db = lowest + bin * (static_cast<double>(i) + 0.5);
    sum += d[i];
    first += d[i] * db;
    second += d[i] * db * db;
  }
  return {first / sum, second / sum - first * first / (sum * sum)};
}

// Adds a density shifted by some dB, interpolated between bins.
void add_moved(const Density& from, double by, double weight, Density& to) {
  const double steps = by / bin, whole = std::floor(steps), part = steps - whole;
  for (std::size_t i = 0; i < bins; ++i) {
    const auto j = static_cast<std::ptrdiff_t>(i) + static_cast<std::ptrdiff_t>(whole);
    if (j >= 0 && j < static_cast<std::ptrdiff_t>(bins))
      to[static_cast<std::size_t>(j)] += weight * (1 - part) * from[i];
    if (j >= -1 && j + 1 < static_cast<std::ptrdiff_t>(bins))
      to[static_cast<std::size_t>(j + 1)] += weight * part * from[i];
  }
}

// Density of the whole law, shifted to mean 0, quantised.
Density density(const ReadingLaw& law) {
  Density d = rician(equivalent_rician_k(law));
  if (!law.channels.empty()) {
    Density mixed(bins);
    for (const double level : law.channels) add_moved(d, level, 1 / static_cast<double>(law.channels.size()), mixed);
    d = mixed;
  }
  const double total = std::accumulate(d.begin(), d.end(), 0.0);
  Density wide(bins), result(bins), quantised(bins);
  for (int step = -80; step < 80; ++step) add_moved(d, bin * (step + 0.5), law.outliers / 160, wide);
  for (std::size_t i = 0; i < bins; ++i) d[i] = ((1 - law.outliers) * d[i] + wide[i]) / total;
  add_moved(d, -moments(d).mean, 1, result);
  for (int step = -2; step < 2; ++step) add_moved(result, bin * (step + 0.5), 0.25, quantised);
  return quantised;
}

Density smeared(const Density& d, double deviation) {
  if (deviation < bin / 2) return d;
  const int reach = static_cast<int>(std::ceil(4 * deviation / bin));
  double total = 0;
  for (int k = -reach; k <= reach; ++k) total += std::exp(-0.5 * std::pow(k * bin / deviation, 2));
  Density result(bins);
  for (int k = -reach; k <= reach; ++k)
    add_moved(d, k * bin, std::exp(-0.5 * std::pow(k * bin / deviation, 2)) / total, result);
  return result;
}

double divergence(const Density& p, const Density& q) {
  // Floor of densities, a millionth of all readings: no fading law is exact in its far tails.
  constexpr double anything = 1e-6 / static_cast<double>(bins);
  double sum = 0;
  for (std::size_t i = 0; i < bins; ++i) sum += p[i] * (std::log(p[i] + anything) - std::log(q[i] + anything));
  return std::max(0.0, sum);
}

}  // namespace

double draw_reading(const ReadingLaw& law, Random& random) {
  const double k = from_db(law.rician_k), steady = std::sqrt(k / (1 + k)), diffuse = std::sqrt(0.5 / (1 + k));
  double power = 0;
  for (int i = 0; i < law.averaged; ++i) {
    const double re = steady + diffuse * random.normal(), im = diffuse * random.normal();
    power += (re * re + im * im) / law.averaged;
  }
  double db = 10 * std::log10(std::max(power, 1e-9));
  if (!law.channels.empty()) db += random.pick(law.channels);
  if (law.outliers > 0 && random.chance(law.outliers)) db += random.uniform(-20, 20);
  return db;
}

Moments fading_moments(const ReadingLaw& law) {
  if (law.averaged == 1) return moments(rician(law.rician_k));
  Random random(1, "moments of averaged fades");  // no closed form; a fixed seed
  constexpr int draws = 20000;
  const ReadingLaw fades{law.rician_k, law.averaged, 0, {}};
  double first = 0, second = 0;
  for (int i = 0; i < draws; ++i) {
    const double db = draw_reading(fades, random);
    first += db / draws;
    second += db * db / draws;
  }
  return {first, second - first * first};
}

double equivalent_rician_k(const ReadingLaw& law) {
  if (law.averaged == 1) return law.rician_k;
  const double wanted = fading_moments(law).variance;
  double low = law.rician_k, high = 30;
  for (int i = 0; i < 12; ++i) {
    const double k = (low + high) / 2;
    (moments(rician(k)).variance > wanted ? low : high) = k;
  }
  return (low + high) / 2;
}

double reading_lambda(const ReadingLaw& truth, const ReadingLaw& stated, const std::vector<double>& level_deviations) {
  constexpr double step = 0.5;  // dB, of deviations
  std::vector<double> counts;   // number of readings by the deviation of their level
  for (const double deviation : level_deviations) {
    const auto place = static_cast<std::size_t>(std::lround(deviation / step));
    counts.resize(std::max(counts.size(), place + 1));
    ++counts[place];
  }
  const Density p = density(truth), q = density(stated);
  double least = std::numeric_limits<double>::infinity();
  for (const double stretch : {1.0, 0.6, 0.8, 0.9, 1.1, 1.25, 1.4, 1.6, 2.0}) {
    double sum = 0;
    for (std::size_t i = 0; i < counts.size() && sum < least; ++i) {
      const double deviation = step * static_cast<double>(i);
      if (counts[i] > 0) sum += counts[i] * divergence(smeared(p, deviation), smeared(q, stretch * deviation));
    }
    least = std::min(least, sum);
  }
  return 2 * least;
}

}  // namespace muster::exam
